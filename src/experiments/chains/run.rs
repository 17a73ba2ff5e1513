//! One realisation: counts by pieces in each window.

use super::super::ensembles::Running;
use super::super::{Error, Progress};
use super::{Run, chain, pieces};
use crate::params::{ChainCurve, ChainsParams};
use impact_chain::Scenario;
use impact_numerics::random::NormalPairs;

pub(super) fn realisation(
    parameters: &ChainsParams,
    curve: &ChainCurve,
    sigma: f64,
    index: u64,
    progress: &Progress,
) -> Result<Option<Run>, Error> {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(&chain(parameters, curve), sigma, &mut normals);
    let sizes = pieces(scenario.gaps(), parameters.piece);
    let until = curve.transients.last().copied().unwrap_or(0.0) + parameters.window;
    let Some(mut motion) = Running::new(&scenario, "chains", progress)? else { return Ok(None) };
    let Some(passages) = motion.passages(&curve.transients, until)? else { return Ok(None) };
    let counts = |transient: usize| {
        let hit = passages.hit(transient, parameters.window);
        let mut rest = hit.as_slice();
        let of = |size: &usize| {
            let (own, after) = rest.split_at(*size);
            rest = after;
            own.iter().map(|&hit| u32::from(hit)).sum()
        };
        sizes.iter().map(of).collect()
    };
    Ok(Some(Run { counts: (0..curve.transients.len()).map(counts).collect() }))
}
