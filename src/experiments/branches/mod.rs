//! Compares chains from rest with chains from above under the same forces.

mod fits;
mod pairs;
pub mod run;
pub mod tables;

pub use run::Chains;

use crate::params::{self, Ensemble};
use impact_chain::Counts;
use literate::experiments::Experiment;
use literate::experiments::experiment::How::Cut;

pub const BRANCHES: Experiment<Vec<Ensemble>, Vec<Chains>, Counts> = Experiment {
    name: "branches",
    own: &["src/experiments/branches", "src/experiments/ensembles.rs"],
    reads: &[],
    parameters: params::branches,
    how: Cut("branches", run::CUTTING),
    tables: tables::make,
};
