//! Which claims are judged otherwise, and which are held to another measure.

use super::super::shown::Shown;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// What a comparison needs of a ledger.json. Other fields came and went with versions.
#[derive(Clone, Debug, Deserialize)]
struct Read {
    claims: Vec<Check>,
    #[serde(default)]
    documents: BTreeMap<String, Shown>,
}

#[derive(Clone, Debug, Deserialize)]
struct Check {
    id: String,
    verdict: String,
    #[serde(default)]
    printed: String,
    #[serde(default)]
    ours: String,
    #[serde(default)]
    tolerance: String,
}

/// The claims of a ledger.json, by id, and what each document shows.
#[derive(Clone, Debug)]
pub struct Claims(BTreeMap<String, Check>, BTreeMap<String, Shown>);

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

impl Claims {
    /// Reads a ledger.json.
    pub fn read(text: &str) -> Result<Self, String> {
        let read: Read = serde_json::from_str(text).map_err(|e| format!("ledger.json: {e}"))?;
        let claims = read.claims.into_iter().map(|claim| (claim.id.clone(), claim));
        Ok(Claims(claims.collect(), read.documents))
    }

    /// What a document shows, if the ledger says so.
    pub fn shown(&self, document: &str) -> Option<Shown> {
        self.1.get(document).cloned()
    }

    /// Leaves the claims that a document refers to.
    pub fn retain(&mut self, shown: &Shown) {
        self.0.retain(|id, _| shown.claims.contains(id));
    }

    /// All changes, sorted by id.
    pub fn changes(&self, after: &Claims) -> Vec<ClaimChange> {
        let ids: BTreeSet<&String> = self.0.keys().chain(after.0.keys()).collect();
        let change = |id: &String| {
            let (old, new) = (self.0.get(id), after.0.get(id));
            let pair = |field: fn(&Check) -> &String| {
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
                id: id.clone(),
                before: old.map(|claim| claim.verdict.clone()),
                after: new.map(|claim| claim.verdict.clone()),
                ours: pair(|claim| &claim.ours).filter(|_| verdict.is_some()),
                printed,
                tolerance,
            })
        };
        ids.into_iter().filter_map(change).collect()
    }
}
