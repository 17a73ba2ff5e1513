//! Counted work of an impact against the number of masses.

use super::routes::method;
use crate::experiments::ensembles::each;
use crate::experiments::{Error, Progress};
use crate::params::{ScaleParams, Setting};
use impact_chain::methods::State;
use impact_chain::{Impact, Scenario};
use impact_numerics::random::NormalPairs;
use serde::{Deserialize, Serialize};

/// Counted work of all methods at all sizes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scale {
    /// What was run.
    pub parameters: ScaleParams,
    /// Settings in their order, for each its numbers of masses, rising.
    pub rows: Vec<ScaleRow>,
}

/// One method at one number of masses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScaleRow {
    /// Method and setting.
    pub setting: Setting,
    /// n.
    pub masses: usize,
    /// Evaluations per impact.
    pub evaluations_per_impact: f64,
}

/// Runs everything.
pub fn run(parameters: &ScaleParams, progress: &Progress) -> Result<Scale, Error> {
    let cases: Vec<(Setting, usize)> = parameters
        .settings
        .iter()
        .flat_map(|&(setting, largest)| {
            let masses = parameters.masses.iter().filter(move |n| **n <= largest);
            masses.map(move |&n| (setting, n))
        })
        .collect();
    let stage = progress.stage("work against size", cases.len() as u64);
    let rows = each(&stage, progress, cases, |(setting, masses)| {
        let chain = crate::params::Chain { masses, ..parameters.chain.clone() };
        let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, 0);
        let scenario = Scenario::draw(&chain, parameters.sigma, &mut normals);
        let until = parameters.until(masses, setting.method);
        let mut go_on = |_: Impact| !progress.stopped();
        let cost = method(setting).run(&scenario, &State::of(&scenario), until, &mut go_on);
        progress.check()?;
        let cost = cost.map_err(|source| Error::failed("scale", source))?;
        let evaluations_per_impact = cost.evaluations as f64 / cost.impacts.max(1) as f64;
        Ok(ScaleRow { setting, masses, evaluations_per_impact })
    })?;
    Ok(Scale { parameters: parameters.clone(), rows })
}
