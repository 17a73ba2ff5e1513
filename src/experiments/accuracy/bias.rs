//! The error of a method in the mean number of gaps that impact, on the same chains.

use crate::experiments::ensembles::run_unit;
use crate::experiments::prelude::*;
use impact_chain::HitGaps;
use impact_chain::methods::{CountedSteps, Task, VerletAbreast};
use literate::experiments::cutting::Unit;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Biases {
    pub parameters: BiasParams,
    /// For each σ and each setting, in their order, the realisations.
    pub runs: Vec<Vec<Vec<GapCount>>>,
    /// For each σ, the realisations of the engine with all forces changed by a few roundings.
    pub again: Vec<Vec<GapCount>>,
}

/// Different gaps with an impact in the window of one realisation, or `None` if the method gave up.
pub type GapCount = Option<u32>;

pub fn run(parameters: &BiasParams, progress: &Progress) -> Result<Biases, Error> {
    let stage = progress.stage("error of the mean", parameters.runs());
    let together = |means: &Means, nudged: bool| {
        let realisations = 0..means.chains.realisations;
        let unit = Unit { realisations, ..Unit::whole(means.chains.realisations as u64) };
        let counts = run_unit(&vec![means.ensemble(nudged)], &unit, &stage, progress)?;
        Ok(counts.distinct.concat())
    };
    let methods = |means: &Means| {
        let one = |&(setting, realisations): &(Setting, usize)| {
            if setting.method == MethodName::Certified {
                return together(means, false);
            }
            if setting.method == MethodName::VerletAbreast {
                let drawn = (0..realisations as u64).map(|index| means.chains.scenario(index));
                let scenarios = drawn.collect::<Vec<_>>();
                let steps = CountedSteps { from: means.transient, until: HitGaps::All };
                let verlet = VerletAbreast { step: setting.value };
                let ran = verlet.count_gaps(&scenarios, means.chains.until, steps);
                let (_, counts) = ran.map_err(|source| Error::failed("bias", source))?;
                stage.advance(realisations as u64);
                return Ok(counts.into_iter().map(Some).collect());
            }
            let method = setting.method();
            run_each(&stage, progress, 0..realisations as u64, |index| {
                let scenario = means.chains.scenario(index);
                let mut hit = vec![false; scenario.gaps()];
                let mut see = |impact: Impact| {
                    hit[impact.gap] |= impact.time > means.transient;
                    !progress.stopped()
                };
                let start = State::from_scenario(&scenario);
                let task = Task { scenario: &scenario, start: &start, until: means.chains.until };
                let ran = method.run(task, &mut see);
                progress.check()?;
                Ok(ran.ok().map(|_| hit.iter().map(|hit| u32::from(*hit)).sum()))
            })
        };
        means.settings.par_iter().map(one).collect()
    };
    let runs = parameters.means.par_iter().map(methods).collect::<Result<_, Error>>()?;
    let again = parameters.means.par_iter().map(|means| together(means, true));
    Ok(Biases { runs, again: again.collect::<Result<_, Error>>()?, parameters: parameters.clone() })
}
