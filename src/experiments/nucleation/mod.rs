//! Chains run to their first impact: how many have one by some time, and how many should.

pub mod run;
pub mod tables;

pub use run::Nucleation;

use crate::experiments::prelude::*;

pub const NUCLEATION: Experiment<NucleationParams, Nucleation> = Experiment {
    own: &["src/experiments/nucleation"],
    how: Whole(run::run, |parameters| parameters.chains() * WORK_PER_SECOND / 30_000),
    ..Experiment::new("nucleation", NucleationParams::new, run::run, tables::make)
};
