//! Runs every method on every scene in which methods fail.

use super::case::{Case, Outcome, Scene, scenes};
use crate::experiments::prelude::*;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrialParams {
    pub settings: Vec<Setting>,
    pub scenes: Vec<Scene>,
}

/// Runs that last longer are left out in the quick profile.
const QUICK: f64 = 100.0;

impl TrialParams {
    pub fn new(profile: Profile) -> Self {
        let mut scenes = scenes();
        if profile == Profile::Quick {
            for scene in &mut scenes {
                scene.cases.retain(|case| case.length() < QUICK);
            }
            scenes.retain(|scene| !scene.cases.is_empty());
        }
        TrialParams { settings: params::trial_settings(profile), scenes }
    }

    pub fn cases(&self) -> usize {
        self.scenes.iter().map(|scene| scene.cases.len()).sum()
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trials {
    pub parameters: TrialParams,
    /// For each scene and each setting, in their order.
    #[serde(rename = "found")]
    pub trials: Vec<Vec<Trial>>,
}

/// The outcomes of one method in each case of a scene.
pub type Trial = Vec<Outcome>;

/// A run that takes more steps than this is not begun, and counts as given up.
const MOST_STEPS: f64 = 2e7;

/// A setting that gives up without a least rebound speed, or misses an impact in a case this factor
/// shorter than the next, is not run in the next case, and counts as failing alike.
const LONGER: f64 = 5.0;

/// Counts the cases with the expected outcome.
pub fn right(trial: &Trial) -> usize {
    trial.iter().filter(|outcome| **outcome == Outcome::Right).count()
}

/// Returns the most frequent wrong outcome, of several the first in the order of [`Outcome`], or
/// `None` if all are right.
pub fn trouble(trial: &Trial) -> Option<Outcome> {
    let mut wrong = trial.clone();
    wrong.retain(|outcome| *outcome != Outcome::Right);
    wrong.sort_unstable();
    // Of equal counts `max_by_key` takes the last.
    wrong.chunk_by(|a, b| a == b).rev().max_by_key(|equal| equal.len()).map(|equal| equal[0])
}

pub fn run(parameters: &TrialParams, progress: &Progress) -> Result<Trials, Error> {
    let TrialParams { scenes, settings } = parameters;
    let alike: Vec<_> =
        settings.chunk_by(|a, b| (a.method, a.value) == (b.method, b.value)).collect();
    let stage = progress.stage("scenes where methods fail", (scenes.len() * alike.len()) as u64);
    let of_scene = |scene: &Scene| {
        let trials =
            run_each(&stage, progress, &alike, |settings| try_settings(settings, scene, progress))?;
        Ok(trials.concat())
    };
    let trials = scenes.par_iter().map(of_scene).collect::<Result<_, Error>>()?;
    Ok(Trials { parameters: parameters.clone(), trials })
}

/// Tries a setting and the same with least rebound speeds, which follow it, in a scene.
fn try_settings(
    settings: &[Setting],
    scene: &Scene,
    progress: &Progress,
) -> Result<Vec<Trial>, Error> {
    let mut trials = vec![Trial::new(); settings.len()];
    for (i, case) in scene.cases.iter().enumerate() {
        let longer = i > 0 && case.length() > LONGER * scene.cases[i - 1].length();
        // The outcome without a least rebound speed, and the least speed at which a gap opened.
        let mut bouncing = (Outcome::GaveUp, 0.0);
        for (setting, trial) in settings.iter().zip(&mut trials) {
            progress.check()?;
            let run = match trial.last() {
                Some(Outcome::GaveUp) if setting.stop == 0.0 => (Outcome::GaveUp, 0.0),
                Some(Outcome::Missed) if longer => (Outcome::Missed, 0.0),
                // A run in which every gap opened faster is the same with a least rebound speed.
                _ if bouncing.0 != Outcome::GaveUp && bouncing.1 >= setting.stop => bouncing,
                _ => outcome(*setting, case),
            };
            if setting.stop == 0.0 {
                bouncing = run;
            }
            trial.push(run.0);
        }
    }
    Ok(trials)
}

/// Runs a case, and returns its outcome and the least speed at which a gap opened by the law.
fn outcome(setting: Setting, case: &Case) -> (Outcome, f64) {
    let steps = case.length() / setting.value;
    if setting.value > 0.0 && !setting.method.has_tolerance() && steps > MOST_STEPS {
        return (Outcome::GaveUp, 0.0);
    }
    case.run(&|task, sink| setting.method().run(task, sink))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stopping_speed_brings_a_mass_to_rest() {
        let scenes = scenes();
        let held = scenes.iter().find(|scene| scene.id == "held").unwrap();
        for method in MethodName::ALL.into_iter().filter(|method| method.locates_impacts()) {
            let settings = [0.0, 1e-3].map(|stop| Setting { method, value: 1e-2, stop });
            let trials = try_settings(&settings, held, &Progress::silent()).unwrap();
            assert_eq!(trials, [[Outcome::GaveUp; 2], [Outcome::Right; 2]]);
        }
    }

    #[test]
    fn a_longer_case_is_not_run_after_a_miss() {
        let setting = Setting { method: MethodName::MoreauJean, value: 1e-2, stop: 0.0 };
        let mut grazes = scenes().into_iter().find(|scene| scene.id == "grazing-hits").unwrap();
        // A graze that is missed, and before and after it one that is seen, in a longer run.
        let [mut seen, missed] = [0, 12].map(|i| grazes.cases[i].clone());
        seen.until += 10.0 * missed.length();
        grazes.cases = vec![seen.clone(), missed, seen];
        let trials = try_settings(&[setting], &grazes, &Progress::silent()).unwrap();
        assert_eq!(trials, [[Outcome::Right, Outcome::Missed, Outcome::Missed]]);
    }
}
