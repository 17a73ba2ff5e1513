//! What the text says about all claims together, and about this copy of the report.

use crate::claims::{self, Claim, FAMILY_LEVEL};
use crate::experiments::Results;
use crate::params::Profile;
use crate::report::values::Value;
use std::collections::BTreeMap;

/// For each claim, a reference to its row with the verdict: `«row.sec7_jump»`.
pub fn references(claims: &[Claim]) -> BTreeMap<&str, String> {
    let reference = |claim: &Claim| format!("[@claim:{}], *{}*", claim.id, claim.verdict.words());
    claims.iter().map(|claim| (claim.id.as_str(), reference(claim))).collect()
}

/// The level of the claims, and what this copy was made with.
pub fn values(results: &Results) -> Vec<Value> {
    let level = claims::level();
    let profile = match results.profile {
        Profile::Quick => "quick",
        Profile::Ci => "ci",
        Profile::Full => "full",
    };
    let values = vec![
        Value::integer("statistical_claims", level.claims),
        Value::real("claim_quantile", level.quantile, 3),
        Value::real("family_level", FAMILY_LEVEL, 1),
        Value::text("profile", profile),
        Value::text("version", env!("CARGO_PKG_VERSION")),
    ];
    super::from(values, "claims::level", "")
}
