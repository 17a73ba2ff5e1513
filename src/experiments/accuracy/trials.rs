//! Every method on every scene in which methods fail.

use super::case::Verdict;
use super::routes::method;
use super::scenes;
use crate::experiments::ensembles::each;
use crate::experiments::{Error, Progress};
use crate::params::{Setting, TrialParams};
use serde::{Deserialize, Serialize};

/// What became of every method in every scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trials {
    /// What was run.
    pub parameters: TrialParams,
    /// One for each scene.
    pub scenes: Vec<SceneRow>,
}

/// One scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneRow {
    /// Its id.
    pub id: String,
    /// What happens in it.
    pub what: String,
    /// One for each setting, in their order.
    pub trials: Vec<Trial>,
}

/// One method in one scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Method and setting.
    pub setting: Setting,
    /// What it made of each case.
    pub verdicts: Vec<Verdict>,
}

impl Trial {
    /// Cases that came out as they must.
    pub fn right(&self) -> usize {
        self.verdicts.iter().filter(|verdict| **verdict == Verdict::Right).count()
    }

    /// What went wrong most often; of several the first in the order of [`Verdict`].
    pub fn trouble(&self) -> Option<Verdict> {
        let wrong = |v: &Verdict| *v != Verdict::Right;
        let count = |v: Verdict| self.verdicts.iter().filter(|other| **other == v).count();
        let mut kinds: Vec<Verdict> = self.verdicts.iter().copied().filter(wrong).collect();
        kinds.sort_unstable();
        kinds.dedup();
        // Of equal counts `max_by_key` takes the last.
        kinds.into_iter().rev().max_by_key(|v| count(*v))
    }
}

/// Runs everything.
pub fn run(parameters: &TrialParams, progress: &Progress) -> Result<Trials, Error> {
    let failed = |source| Error::failed("trials", source);
    let scenes = scenes::all(parameters.short, &parameters.clusters).map_err(failed)?;
    let pairs: Vec<(usize, usize)> = (0..scenes.len())
        .flat_map(|scene| (0..parameters.settings.len()).map(move |setting| (scene, setting)))
        .collect();
    let stage = progress.stage("scenes where methods fail", pairs.len() as u64);
    let trials = each(&stage, progress, pairs, |(scene, setting)| {
        let setting = parameters.settings[setting];
        let method = method(setting);
        let mut verdicts = Vec::new();
        for case in &scenes[scene].cases {
            progress.check()?;
            verdicts.push(case.judge(method.as_ref()).verdict);
        }
        Ok(Trial { setting, verdicts })
    })?;
    let rows = scenes.iter().zip(trials.chunks(parameters.settings.len().max(1)));
    Ok(Trials {
        parameters: parameters.clone(),
        scenes: rows
            .map(|(scene, trials)| SceneRow {
                id: scene.id.into(),
                what: scene.what.into(),
                trials: trials.to_vec(),
            })
            .collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::MethodName;

    #[test]
    fn the_commonest_trouble_is_named() {
        use Verdict::{Displaced, Ghost, Missed, Right};
        let of = |verdicts: &[Verdict]| {
            let setting = Setting { method: MethodName::Verlet, value: 0.1 };
            Trial { setting, verdicts: verdicts.to_vec() }.trouble()
        };
        assert_eq!(of(&[Right, Right]), None);
        assert_eq!(of(&[Right, Displaced, Displaced, Missed]), Some(Displaced));
        assert_eq!(of(&[Ghost, Missed]), Some(Missed));
    }
}
