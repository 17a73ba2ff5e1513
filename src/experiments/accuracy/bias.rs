//! The error of a method in the mean number of gaps that impact, on the same chains.

use crate::experiments::prelude::*;
use crate::params::{BiasParams, Means, Setting};
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
    let methods = |of: &Means| {
        let one = |&(setting, realisations): &(Setting, usize)| {
            let method = setting.method();
            each(&stage, progress, 0..realisations as u64, |index| {
                let scenario = of.chains.scenario(index);
                let mut hit = vec![false; scenario.gaps()];
                let mut see = |impact: Impact| {
                    hit[impact.gap] |= impact.time > of.transient;
                    !progress.stopped()
                };
                let task = (&scenario, &State::of(&scenario), of.chains.until);
                let ran = method.run(task, &mut see);
                progress.check()?;
                Ok(ran.ok().map(|_| hit.iter().map(|hit| u32::from(*hit)).sum()))
            })
        };
        of.settings.par_iter().map(one).collect()
    };
    let runs = parameters.means.par_iter().map(methods).collect::<Result<_, Error>>()?;
    Ok(Biases { runs, parameters: parameters.clone() })
}
