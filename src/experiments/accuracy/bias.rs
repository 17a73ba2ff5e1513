//! The error of a method in the mean number of gaps that impact: the same chains by every method,
//! and the differences chain by chain.

use crate::experiments::prelude::*;
use crate::params::{BiasParams, Setting};

/// All realisations by all methods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Biases {
    pub parameters: BiasParams,
    /// For each σ and each setting, in their order, the realisations.
    pub runs: Vec<Vec<Vec<GapCount>>>,
}

/// Distinct gaps that impact in the window (T, T + W] of one realisation; none if the method gave
/// up.
pub type GapCount = Option<u32>;

pub fn run(parameters: &BiasParams, progress: &Progress) -> Result<Biases, Error> {
    let mut all = Vec::new();
    for chains in &parameters.chains {
        for &(setting, realisations) in &parameters.settings {
            all.extend((0..realisations as u64).map(|index| (chains, setting, index)));
        }
    }
    let stage = progress.stage("error of the mean", all.len() as u64);
    let counted = each(&stage, progress, all, |(chains, setting, index)| {
        let window = (parameters.transient, chains.until);
        let counted = count(setting, &chains.scenario(index), window, progress);
        progress.check()?;
        Ok(counted)
    })?;
    let mut counted = counted.into_iter();
    let mut runs = Vec::new();
    for _ in &parameters.chains {
        let mut by_setting: Vec<Vec<GapCount>> = Vec::new();
        for &(_, realisations) in &parameters.settings {
            by_setting.push(counted.by_ref().take(realisations).collect());
        }
        runs.push(by_setting);
    }
    Ok(Biases { runs, parameters: parameters.clone() })
}

fn count(
    setting: Setting,
    scenario: &Scenario,
    (transient, end): (f64, f64),
    progress: &Progress,
) -> GapCount {
    let mut hit = vec![false; scenario.gaps()];
    let mut see = |impact: Impact| {
        hit[impact.gap] |= impact.time > transient;
        !progress.stopped()
    };
    let method = setting.method.with(setting.value);
    let ran = method.run((scenario, &State::of(scenario), end), &mut see).ok();
    ran.map(|_| hit.iter().map(|hit| u32::from(*hit)).sum())
}
