//! Chains run to their first impact: how many have one by some time, and how many should.

pub mod run;
pub mod tables;

pub use run::Nucleation;

use crate::experiments::prelude::*;
use crate::params::NucleationParams;

pub const NUCLEATION: Experiment<NucleationParams, Nucleation> = Experiment {
    name: "nucleation",
    own: &["src/experiments/nucleation"],
    reads: &[],
    parameters: NucleationParams::new,
    how: Whole(run::run, |parameters| parameters.chains() * WORK_PER_SECOND / 30_000),
    tables: tables::make,
};
