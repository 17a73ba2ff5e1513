//! The error of a method in the mean number of gaps that impact, on the same chains.

use crate::experiments::prelude::*;
use crate::params::{BiasParams, Runs, Setting};
use rayon::prelude::*;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Biases {
    pub parameters: BiasParams,
    /// For each σ and each setting, in their order, the realisations.
    pub runs: Vec<Vec<Vec<GapCount>>>,
}

/// Different gaps with an impact in the window of one realisation; none if the method gave up.
pub type GapCount = Option<u32>;

pub fn run(parameters: &BiasParams, progress: &Progress) -> Result<Biases, Error> {
    let stage = progress.stage("error of the mean", parameters.runs());
    let settings = |chains: &Runs| {
        let one = |&(Setting { method, value }, realisations): &(Setting, usize)| {
            let method = method.with(value);
            each(&stage, progress, 0..realisations as u64, |index| {
                let scenario = chains.scenario(index);
                let mut hit = vec![false; scenario.gaps()];
                let mut see = |impact: Impact| {
                    hit[impact.gap] |= impact.time > parameters.transient;
                    !progress.stopped()
                };
                let ran = method.run((&scenario, &State::of(&scenario), chains.until), &mut see);
                progress.check()?;
                Ok(ran.ok().map(|_| hit.iter().map(|hit| u32::from(*hit)).sum()))
            })
        };
        parameters.settings.par_iter().map(one).collect()
    };
    let runs = parameters.chains.par_iter().map(settings).collect::<Result<_, Error>>()?;
    Ok(Biases { runs, parameters: parameters.clone() })
}
