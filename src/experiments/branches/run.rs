//! Runs chains from rest and from above, and keeps the count of every chain.
//!
//! A chain from above runs well beyond the rise first; then all its forces are lowered by one
//! factor. Chain i has the same forces on both branches and at every σ.

use crate::experiments::ensembles::{part, rows};
use crate::experiments::prelude::*;
use crate::params::Ensemble;
use impact_chain::Counts;
use literate::experiments::cutting::Cutting;

/// The counts of an ensemble, chain by chain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chains {
    pub ensemble: Ensemble,
    /// For each σ and each window, the active gaps of each chain; none if its run was not complete.
    pub counts: Vec<Vec<Vec<Option<u32>>>>,
}

/// How the ensembles are cut into units, and joined.
pub const CUTTING: Cutting<Vec<Ensemble>, Counts, Vec<Chains>> = Cutting { rows, part, join };

fn join(
    all: &Vec<Ensemble>,
    parts: Vec<Vec<Counts>>,
    progress: &Progress,
) -> Result<Vec<Chains>, Error> {
    progress.check()?;
    let mut parts = parts.into_iter();
    let mut found = Vec::with_capacity(all.len());
    for ensemble in all {
        let at_each = parts.by_ref().take(ensemble.sigmas.len());
        let counts = at_each.map(|parts| Counts::from_iter(parts).distinct).collect();
        found.push(Chains { ensemble: ensemble.clone(), counts });
    }
    Ok(found)
}
