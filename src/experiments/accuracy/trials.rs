//! Runs every method on every scene in which methods fail.

use super::case::{Case, Outcome, Scene, scenes};
use crate::experiments::prelude::*;
use crate::params::{Profile, Setting, trial_settings};
use rayon::prelude::*;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrialParams {
    pub settings: Vec<Setting>,
    pub scenes: Vec<Scene>,
}

/// Runs that last longer are left out in the quick profile.
const QUICK: f64 = 500.0;

impl TrialParams {
    pub fn new(profile: Profile) -> Self {
        let mut scenes = scenes();
        if profile == Profile::Quick {
            for scene in &mut scenes {
                scene.cases.retain(|case| case.until - case.start.time < QUICK);
            }
            scenes.retain(|scene| !scene.cases.is_empty());
        }
        TrialParams { settings: trial_settings(), scenes }
    }

    pub fn cases(&self) -> usize {
        self.scenes.iter().map(|scene| scene.cases.len()).sum()
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trials {
    pub parameters: TrialParams,
    /// For each scene and each setting, in their order.
    pub found: Vec<Vec<Trial>>,
}

/// The outcomes of one method in each case of a scene.
pub type Trial = Vec<Outcome>;

/// A run that takes more steps than this is not begun, and counts as given up.
const MOST_STEPS: f64 = 2e7;

pub fn right(trial: &Trial) -> usize {
    trial.iter().filter(|outcome| **outcome == Outcome::Right).count()
}

/// Returns the most frequent wrong outcome; of several the first in the order of [`Outcome`].
pub fn trouble(trial: &Trial) -> Option<Outcome> {
    let mut wrong = trial.clone();
    wrong.retain(|outcome| *outcome != Outcome::Right);
    wrong.sort_unstable();
    // Of equal counts `max_by_key` takes the last.
    wrong.chunk_by(|a, b| a == b).rev().max_by_key(|equal| equal.len()).map(|equal| equal[0])
}

pub fn run(parameters: &TrialParams, progress: &Progress) -> Result<Trials, Error> {
    let TrialParams { scenes, settings } = parameters;
    let stage = progress.stage("scenes where methods fail", parameters.cases() as u64);
    let of_scene = |scene: &Scene| {
        let cases = each(&stage, progress, &scene.cases, |case| {
            progress.check().map(|()| outcomes(settings, case))
        })?;
        let trial = |i: usize| cases.iter().map(|found| found[i]).collect();
        Ok((0..settings.len()).map(trial).collect())
    };
    let found = scenes.par_iter().map(of_scene).collect::<Result<_, Error>>()?;
    Ok(Trials { parameters: parameters.clone(), found })
}

/// Returns the outcome with each setting; a least rebound speed follows the setting without.
fn outcomes(settings: &[Setting], case: &Case) -> Vec<Outcome> {
    let mut bouncing = (Outcome::GaveUp, 0.0);
    let of = |setting: &Setting| {
        if setting.stop == 0.0 {
            bouncing = outcome(*setting, case);
        } else if bouncing.0 == Outcome::GaveUp || bouncing.1 < setting.stop {
            return outcome(*setting, case).0;
        }
        // A run in which every gap opened faster is the same with a least rebound speed.
        bouncing.0
    };
    settings.iter().map(of).collect()
}

fn outcome(setting: Setting, case: &Case) -> (Outcome, f64) {
    let steps = (case.until - case.start.time) / setting.value;
    if setting.value > 0.0 && !setting.method.has_tolerance() && steps > MOST_STEPS {
        return (Outcome::GaveUp, 0.0);
    }
    case.run(setting.method().as_ref())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::MethodName;

    #[test]
    fn a_stopping_speed_brings_a_mass_to_rest() {
        let scenes = scenes();
        let held = scenes.iter().find(|scene| scene.id == "held").unwrap();
        for method in MethodName::ALL.into_iter().filter(|method| method.locates_impacts()) {
            let settings = [0.0, 1e-3].map(|stop| Setting { method, value: 1e-2, stop });
            for case in &held.cases {
                assert_eq!(outcomes(&settings, case), [Outcome::GaveUp, Outcome::Right]);
            }
        }
    }
}
