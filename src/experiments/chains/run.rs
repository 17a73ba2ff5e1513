//! One realisation: counts by pieces in each window.

use super::super::{Error, Progress};
use super::{Run, chain, pieces};
use crate::dynamics::{self, Engine, Scenario};
use crate::numerics::random::NormalPairs;
use crate::params::{ChainCurve, ChainsParams};

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
    let mut counts = Vec::with_capacity(curve.transients.len());
    let mut go = || {
        let mut engine = Engine::new(&scenario)?;
        for transient in &curve.transients {
            engine.run(*transient, |_| !progress.stopped())?;
            let mut hit = vec![false; sizes.iter().sum()];
            engine.run(transient + parameters.window, |impact| {
                // A ring counts its gaps from 1.
                let gap = impact.gap % hit.len();
                hit[gap] = true;
                !progress.stopped()
            })?;
            let mut rest = hit.as_slice();
            let of = |size: &usize| {
                let (own, after) = rest.split_at(*size);
                rest = after;
                own.iter().map(|&hit| u32::from(hit)).sum()
            };
            counts.push(sizes.iter().map(of).collect());
        }
        Ok(())
    };
    let ended = go();
    progress.check()?;
    match ended {
        Ok(()) => Ok(Some(Run { counts })),
        Err(dynamics::Error::Work { .. }) => Ok(None),
        Err(source) => Err(Error::failed("chains", source)),
    }
}
