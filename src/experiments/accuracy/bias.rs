//! The error of a method in the mean number of gaps that impact, on the same chains.

use crate::experiments::prelude::*;
use crate::params::{BiasParams, Means, MethodName, Setting};
use impact_chain::Abreast;
use impact_chain::methods::VerletAbreast;
use rayon::prelude::*;
use std::ops::Range;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Biases {
    pub parameters: BiasParams,
    /// For each σ and each setting, in their order, the realisations.
    pub runs: Vec<Vec<Vec<GapCount>>>,
    /// For each σ, those of the engine when all forces are changed by a few roundings.
    pub again: Vec<Vec<GapCount>>,
}

/// Different gaps with an impact in the window of one realisation; none if the method gave up.
pub type GapCount = Option<u32>;

/// Counts chains by their numbers.
type Counting<'a> = dyn Fn(Range<u64>) -> Result<Vec<GapCount>, Error> + Sync + 'a;

/// Chains that [`VerletAbreast`] gets at a time: those without impacts leave no lane empty.
const TOGETHER: usize = 64;

pub fn run(parameters: &BiasParams, progress: &Progress) -> Result<Biases, Error> {
    let stage = progress.stage("error of the mean", parameters.runs());
    let failed = |source| Error::failed("bias", source);
    let grouped = |all: usize, number: usize, count: &Counting| {
        let groups = (0..all as u64).step_by(number);
        let found = each(&stage, progress, groups, |first| {
            let counts = count(first..(first + number as u64).min(all as u64))?;
            stage.advance(counts.len() as u64 - 1);
            Ok(counts)
        })?;
        progress.check()?;
        Ok(found.concat())
    };
    let together = |of: &Means, nudged: bool| {
        let ensemble = of.ensemble(nudged);
        let at = ensemble.at(ensemble.sigmas[0]);
        grouped(ensemble.realisations, Abreast::number(&ensemble.chain), &|group| {
            let counts = at.count(group, &|| progress.stopped()).map_err(failed)?;
            Ok(counts.into_iter().map(|one| one.distinct[0][0]).collect())
        })
    };
    let methods = |of: &Means| {
        let one = |&(setting, realisations): &(Setting, usize)| {
            let (until, after) = (of.chains.until, of.transient);
            match setting.method {
                MethodName::Certified => return together(of, false),
                MethodName::VerletAbreast => {
                    let verlet = VerletAbreast { step: setting.value };
                    return grouped(realisations, TOGETHER, &|group| {
                        let all: Vec<Scenario> = group.map(|i| of.chains.scenario(i)).collect();
                        let window = Some((after, false));
                        let ran = verlet.run_all(&all, until, window, &mut |_, _| true);
                        Ok(ran.map_err(failed)?.1.into_iter().map(Some).collect())
                    });
                }
                _ => (),
            }
            let method = setting.method();
            each(&stage, progress, 0..realisations as u64, |index| {
                let scenario = of.chains.scenario(index);
                let mut hit = vec![false; scenario.gaps()];
                let mut see = |impact: Impact| {
                    hit[impact.gap] |= impact.time > after;
                    !progress.stopped()
                };
                let ran = method.run((&scenario, &State::of(&scenario), until), &mut see);
                progress.check()?;
                Ok(ran.ok().map(|_| hit.iter().map(|hit| u32::from(*hit)).sum()))
            })
        };
        of.settings.par_iter().map(one).collect()
    };
    let runs = parameters.means.par_iter().map(methods).collect::<Result<_, Error>>()?;
    let again = parameters.means.par_iter().map(|of| together(of, true));
    let again = again.collect::<Result<_, Error>>()?;
    Ok(Biases { runs, again, parameters: parameters.clone() })
}
