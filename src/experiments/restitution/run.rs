//! One realisation: what is counted in its windows.

use super::super::{Error, Progress};
use super::{Case, Run, chain};
use crate::dynamics::{self, Engine, Scenario};
use crate::numerics::random::NormalPairs;
use crate::params::RestitutionParams;

pub(super) fn realisation(
    parameters: &RestitutionParams,
    case: &Case,
    index: u64,
    progress: &Progress,
) -> Result<Option<Run>, Error> {
    progress.check()?;
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(&chain(parameters, case.restitution), case.sigma, &mut normals);
    let fault = |source| Error::failed("restitution", source);
    let mut engine = Engine::new(&scenario).map_err(fault)?;
    let mut run = Run::default();
    let mut hit = Vec::new();
    for &end in &case.ends {
        let before = engine.counters();
        hit = vec![false; scenario.gaps()];
        let ended = engine.run(end, |impact| {
            hit[impact.gap] = true;
            !progress.stopped()
        });
        progress.check()?;
        match ended {
            Ok(()) => {}
            Err(dynamics::Error::Work { .. }) => return Ok(None),
            Err(source) => return Err(fault(source)),
        }
        let counters = engine.counters();
        run.impacts.push(counters.impacts - before.impacts);
        run.phases = counters.contact_phases - before.contact_phases;
        let free = engine.free_parts();
        run.free.push(free.iter().map(|[a, b]| 0.5 * (a * a + b * b)).sum());
    }
    run.distinct = hit.iter().map(|&hit| u64::from(hit)).sum();
    Ok(Some(run))
}
