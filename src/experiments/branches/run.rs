//! Counts chains from rest and from above; the latter run well beyond the rise first, then all
//! forces are lowered by one factor. Chain i has the same forces on both branches and at every σ.

use crate::experiments::ensembles::{EnsembleCounts, join_counts, run_unit, unit_rows};
use crate::experiments::prelude::*;
use crate::params::Ensemble;
use impact_chain::Counts;
use literate::experiments::cutting::Cutting;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chains {
    pub ensemble: Ensemble,
    /// For each σ and each window, the active gaps of each chain, or `None` if its run was not
    /// complete.
    pub counts: Vec<Vec<Vec<Option<u32>>>>,
}

pub const CUTTING: Cutting<Vec<Ensemble>, Counts, Vec<Chains>> =
    Cutting { rows: unit_rows, run_unit, join };

fn join(
    ensembles: &Vec<Ensemble>,
    parts: Vec<Vec<Counts>>,
    progress: &Progress,
) -> Result<Vec<Chains>, Error> {
    progress.check()?;
    let chains = |EnsembleCounts { ensemble, counts }| {
        let counts = counts.into_iter().map(|counts| counts.distinct).collect();
        Chains { ensemble, counts }
    };
    Ok(join_counts(ensembles, parts).map(chains).collect())
}
