//! One realisation: what is counted in its windows.

use super::super::ensembles::{Running, count};
use super::super::{Error, Progress};
use super::{Case, Run, chain};
use crate::params::RestitutionParams;
use impact_chain::Scenario;
use impact_numerics::random::NormalPairs;

pub(super) fn realisation(
    parameters: &RestitutionParams,
    case: &Case,
    index: u64,
    progress: &Progress,
) -> Result<Option<Run>, Error> {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(&chain(parameters, case.restitution), case.sigma, &mut normals);
    let Some(mut motion) = Running::new(&scenario, "restitution", progress)? else {
        return Ok(None);
    };
    let mut run = Run::default();
    for &end in &case.ends {
        let before = motion.engine.counters();
        let mut hit = vec![false; scenario.gaps()];
        if !motion.go(end, |impact| hit[impact.gap] = true)? {
            return Ok(None);
        }
        let counters = motion.engine.counters();
        run.impacts.push(counters.impacts - before.impacts);
        run.phases = counters.contact_phases - before.contact_phases;
        run.distinct = count(&hit);
    }
    Ok(Some(run))
}
