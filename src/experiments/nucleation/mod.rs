//! Runs chains to their first impact: how many have one by some time, and the number expected from
//! the reach of single gaps.

pub mod run;
pub mod tables;

pub use run::{First, Gaps, Nucleation, Theory};

use crate::experiments::prelude::*;
use crate::params::NucleationParams;

/// First impacts of chains from rest.
pub const NUCLEATION: Experiment<NucleationParams, Nucleation> = Experiment {
    name: "nucleation",
    code: &["src/experiments/nucleation"],
    parameters: NucleationParams::new,
    how: Whole(run::run, |parameters| run::count(parameters) * SECOND / 30_000),
    tables: tables::tables,
};
