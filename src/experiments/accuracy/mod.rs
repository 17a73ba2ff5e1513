//! Compares counted work and accuracy of each method, and where it fails.

pub mod answers;
pub mod bias;
pub mod case;
pub mod race;
pub mod scale;
pub mod tables;
pub mod trials;

use crate::experiments::prelude::*;

/// Code that these experiments share, and no others but one.
const METHODS: &str = "src/experiments/accuracy";
const HORIZON: &str = "src/experiments/horizon.rs";

pub const RACE: Experiment<RaceParams, race::Race> = Experiment {
    own: &["src/experiments/accuracy/race.rs", METHODS, HORIZON],
    how: Whole(race::run, |parameters| parameters.chains as u64 * WORK_PER_SECOND / 5),
    ..Experiment::new("race", RaceParams::new, race::run, tables::race)
};

pub const BIAS: Experiment<BiasParams, bias::Biases> = Experiment {
    own: &["src/experiments/accuracy/bias.rs", METHODS, HORIZON],
    how: Whole(bias::run, |parameters| parameters.runs() * WORK_PER_SECOND / 200),
    ..Experiment::new("bias", BiasParams::new, bias::run, tables::bias)
};

pub const TRIALS: Experiment<trials::TrialParams, trials::Trials> = Experiment {
    own: &["src/experiments/accuracy/trials.rs", METHODS, HORIZON, "scenes"],
    how: Whole(trials::run, |parameters| parameters.cases() as u64 * WORK_PER_SECOND / 10),
    ..Experiment::new("trials", trials::TrialParams::new, trials::run, |_| Vec::new())
};

pub const SCALE: Experiment<ScaleParams, scale::Scale> = Experiment {
    own: &["src/experiments/accuracy/scale.rs", METHODS, HORIZON],
    how: Whole(scale::run, |_| WORK_PER_SECOND / 10),
    ..Experiment::new("scale", ScaleParams::new, scale::run, tables::scale)
};
