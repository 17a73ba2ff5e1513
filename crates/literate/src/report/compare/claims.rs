//! Which claims are judged otherwise, and which are held to another measure.

use super::super::ledger::ClaimEntry;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// One difference between two sets of claims.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClaimChange {
    /// Id of the claim.
    pub id: String,
    /// Its verdict; None for a new claim.
    pub before: Option<String>,
    /// Its verdict now; None for a claim that is gone.
    pub after: Option<String>,
    /// What was found, before and after, where the verdict differs.
    pub ours: Option<[String; 2]>,
    /// What it is held against, where that differs.
    pub printed: Option<[String; 2]>,
    /// The tolerance, where that differs.
    pub tolerance: Option<[String; 2]>,
}

/// All changes, sorted by id.
pub fn changes(before: &[ClaimEntry], after: &[ClaimEntry]) -> Vec<ClaimChange> {
    let by_id = |claims| -> BTreeMap<&str, &ClaimEntry> {
        <[ClaimEntry]>::iter(claims).map(|claim| (claim.id.as_str(), claim)).collect()
    };
    let (before, after) = (by_id(before), by_id(after));
    let ids: BTreeSet<&str> = before.keys().chain(after.keys()).copied().collect();
    let change = |id: &str| {
        let (old, new) = (before.get(id), after.get(id));
        let pair = |field: fn(&ClaimEntry) -> &String| {
            let pair = old.zip(new).map(|(old, new)| [field(old).clone(), field(new).clone()]);
            pair.filter(|[before, after]| before != after)
        };
        let (verdict, printed) = (pair(|claim| &claim.verdict), pair(|claim| &claim.printed));
        let tolerance = pair(|claim| &claim.tolerance);
        let both = old.is_some() && new.is_some();
        if both && verdict.is_none() && printed.is_none() && tolerance.is_none() {
            return None;
        }
        Some(ClaimChange {
            id: id.into(),
            before: old.map(|claim| claim.verdict.clone()),
            after: new.map(|claim| claim.verdict.clone()),
            ours: pair(|claim| &claim.ours).filter(|_| verdict.is_some()),
            printed,
            tolerance,
        })
    };
    ids.into_iter().filter_map(change).collect()
}
