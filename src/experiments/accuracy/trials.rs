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
    let stage = progress.stage("scenes where methods fail", (scenes.len() * settings.len()) as u64);
    let of_scene = |scene: &Scene| {
        each(&stage, progress, settings, |setting| {
            let one = |case| progress.check().map(|()| outcome(*setting, case));
            scene.cases.iter().map(one).collect()
        })
    };
    let found = scenes.par_iter().map(of_scene).collect::<Result<_, _>>()?;
    Ok(Trials { parameters: parameters.clone(), found })
}

fn outcome(Setting { method, value }: Setting, case: &Case) -> Outcome {
    let steps = (case.until - case.start.time) / value;
    if value > 0.0 && !method.has_tolerance() && steps > MOST_STEPS {
        return Outcome::GaveUp;
    }
    case.run(method.with(value).as_ref())
}
