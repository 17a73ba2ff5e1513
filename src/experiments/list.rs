//! Lists the experiments in the order in which they run, and the tables that need several of them.

use super::{
    BIAS, BRANCHES, HORIZON, LENGTHS, MEASURED, NUCLEATION, PROTOCOL, RACE, REPLAY, RESTITUTION,
    SCALE, SECOND_SEED, SEEDS, SEGMENTS, SPACE_TIME, STARTS, SWEEP, TRIALS, TWO_MASSES, identities,
    seeds, starts, theory,
};
use crate::params;
use literate::experiments::experiment::How::Read;
use literate::experiments::{AnyExperiment, DerivedTables, Experiment};

/// All experiments, in the order in which they run.
pub const ALL: &[&dyn AnyExperiment] = &[
    &THEORY,
    &SEGMENTS,
    &MEASURED,
    &SWEEP,
    &SECOND_SEED,
    &PROTOCOL,
    &STARTS,
    &HORIZON,
    &TWO_MASSES,
    &SPACE_TIME,
    &RACE,
    &BIAS,
    &TRIALS,
    &SCALE,
    &NUCLEATION,
    &SEEDS,
    &RESTITUTION,
    &LENGTHS,
    &BRANCHES,
    &REPLAY,
];

/// Tables that need several experiments.
pub const DERIVED: [DerivedTables; 3] =
    [theory::comparison::tables, seeds::compared::tables, starts::against_theory];

/// The graph theory, which costs nothing and is never saved.
pub const THEORY: Experiment<serde_json::Value, ()> = Experiment {
    name: "theory",
    code: &["src/experiments/theory"],
    parameters: |_| serde_json::json!({ "N": params::VERTICES }),
    how: Read(|_| Ok(())),
    tables: |()| {
        let (theory, identities) = rayon::join(theory::tables, identities::tables);
        [theory, identities].concat()
    },
};
