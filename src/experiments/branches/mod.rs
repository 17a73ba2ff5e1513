//! Compares chains from rest with chains from above under the same forces; the latter run well
//! beyond the rise first, then all forces are lowered by one factor. Chain i has the same forces on
//! both branches and at every σ.

mod fits;
mod pairs;
pub mod tables;

pub use pairs::Chains;

use crate::experiments::ensembles::{Parts, join_counts, run_unit, unit_rows};
use crate::experiments::prelude::*;

pub const BRANCHES: Experiment<Vec<Ensemble>, Vec<Chains>, Counts> = Experiment {
    name: "branches",
    own: &["src/experiments/branches", "src/experiments/ensembles.rs"],
    reads: &[],
    parameters: params::branches,
    how: Cut("branches", Cutting { rows: unit_rows, run_unit, join }),
    tables: tables::make,
};

fn join(groups: &Vec<Ensemble>, parts: Parts, progress: &Progress) -> Result<Vec<Chains>, Error> {
    progress.check()?;
    let chains = |(ensemble, counts): (Ensemble, Vec<Counts>)| Chains {
        ensemble,
        counts: counts.into_iter().map(|counts| counts.distinct).collect(),
    };
    Ok(join_counts(groups, parts).map(chains).collect())
}
