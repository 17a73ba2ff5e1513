//! Every method on every scene in which methods fail.

use super::case::Verdict;
use super::scenes;
use crate::experiments::prelude::*;
use crate::params::TrialParams;

/// The outcomes of every method in every scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trials {
    pub parameters: TrialParams,
    /// For each scene what happens in it, and for each setting in their order its verdicts.
    pub scenes: Vec<(String, Vec<Trial>)>,
}

/// The verdicts on one method in each case of a scene.
pub type Trial = Vec<Verdict>;

/// Number of cases with the expected outcome.
pub fn right(trial: &Trial) -> usize {
    trial.iter().filter(|verdict| **verdict == Verdict::Right).count()
}

/// The most frequent wrong verdict; of several the first in the order of [`Verdict`].
pub fn trouble(trial: &Trial) -> Option<Verdict> {
    let mut wrong: Vec<Verdict> =
        trial.iter().copied().filter(|verdict| *verdict != Verdict::Right).collect();
    wrong.sort_unstable();
    // Of equal counts `max_by_key` takes the last.
    wrong.chunk_by(|a, b| a == b).rev().max_by_key(|equal| equal.len()).map(|equal| equal[0])
}

pub fn run(parameters: &TrialParams, progress: &Progress) -> Result<Trials, Error> {
    let scenes = scenes::all(parameters.short).map_err(|source| Error::failed("trials", source))?;
    let settings = &parameters.settings;
    let pairs = scenes.iter().flat_map(|scene| settings.iter().map(move |way| (scene, way)));
    let stage = progress.stage("scenes where methods fail", (scenes.len() * settings.len()) as u64);
    let trials = each(&stage, progress, pairs, |(scene, setting)| {
        let method = setting.method.with(setting.value);
        let judge = |case: &super::case::Case| {
            progress.check()?;
            Ok(case.judge(method.as_ref()))
        };
        scene.cases.iter().map(judge).collect::<Result<Trial, Error>>()
    })?;
    let rows = scenes.iter().zip(trials.chunks(settings.len().max(1)));
    Ok(Trials {
        parameters: parameters.clone(),
        scenes: rows.map(|(scene, trials)| (scene.what.into(), trials.to_vec())).collect(),
    })
}
