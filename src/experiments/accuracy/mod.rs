//! Compares counted work and accuracy of each method, and where it fails.

pub mod answers;
pub mod bias;
pub mod case;
pub mod race;
pub mod scale;
pub mod tables;
pub mod trials;

use crate::experiments::prelude::*;
use crate::params::{BiasParams, RaceParams, ScaleParams};

/// Code that these experiments share, and no others but one.
const METHODS: &str = "src/experiments/accuracy";
const HORIZON: &str = "src/experiments/horizon.rs";

pub const RACE: Experiment<RaceParams, race::Race> = Experiment {
    name: "race",
    own: &["src/experiments/accuracy/race.rs", METHODS, HORIZON],
    reads: &[],
    parameters: RaceParams::new,
    how: Whole(race::run, |parameters| parameters.chains as u64 * WORK_PER_SECOND / 5),
    tables: tables::race,
};

pub const BIAS: Experiment<BiasParams, bias::Biases> = Experiment {
    name: "bias",
    own: &["src/experiments/accuracy/bias.rs", METHODS, HORIZON],
    reads: &[],
    parameters: BiasParams::new,
    how: Whole(bias::run, |parameters| parameters.runs() * WORK_PER_SECOND / 200),
    tables: tables::bias,
};

pub const TRIALS: Experiment<trials::TrialParams, trials::Trials> = Experiment {
    name: "trials",
    own: &["src/experiments/accuracy/trials.rs", METHODS, HORIZON, "scenes"],
    reads: &[],
    parameters: trials::TrialParams::new,
    how: Whole(trials::run, |parameters| parameters.cases() as u64 * WORK_PER_SECOND / 10),
    tables: |_| Vec::new(),
};

pub const SCALE: Experiment<ScaleParams, scale::Scale> = Experiment {
    name: "scale",
    own: &["src/experiments/accuracy/scale.rs", METHODS, HORIZON],
    reads: &[],
    parameters: ScaleParams::new,
    how: Whole(scale::run, |_| WORK_PER_SECOND / 10),
    tables: tables::scale,
};
