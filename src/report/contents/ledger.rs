//! What the text says about all claims together, and about this copy of the report.

use super::mark;
use crate::claims::{self, Basis, Check, FAMILY_LEVEL, Verdict};
use crate::experiments::Results;
use crate::report::values::{Value, origin};

/// The verdicts on the statements of one section of the paper.
#[derive(serde::Serialize)]
pub struct Strip {
    /// The section.
    place: String,
    /// A sign for each statement, which leads to its row.
    signs: String,
}

/// The verdicts, section by section.
pub fn strip(claims: &[Check]) -> Vec<Strip> {
    let section = |claim: &Check| claim.id.split('_').next().unwrap_or_default().to_string();
    let one = |own: &[Check]| {
        let signs: Vec<String> = own.iter().map(|claim| format!("[@sign:{}]", claim.id)).collect();
        let place = section(&own[0]).replace("sec", "Sec.\u{a0}");
        Strip { place, signs: signs.join(" ") }
    };
    claims.chunk_by(|a, b| section(a) == section(b)).map(one).collect()
}

/// One line of the scorecard.
#[derive(serde::Serialize)]
pub struct ScoreLine {
    /// The verdict in words.
    verdict: &'static str,
    /// How many statements have it, as a mark.
    count: String,
    /// References to them, or the word "none".
    claims: String,
}

/// How many statements have each verdict, and which.
pub fn scorecard(claims: &[Check]) -> Vec<ScoreLine> {
    let line = |verdict: &Verdict| {
        let own: Vec<String> = claims
            .iter()
            .filter(|claim| claim.verdict == *verdict)
            .map(|claim| format!("@claim:{}", claim.id))
            .collect();
        let name = verdict.words().replace(' ', "_");
        ScoreLine {
            verdict: verdict.words(),
            count: mark(format!("score.{name}")),
            claims: if own.is_empty() { "none".into() } else { format!("[{}]", own.join("; ")) },
        }
    };
    Verdict::ALL.iter().map(line).collect()
}

/// How the verdicts split by what they rest on: basis, statements, and how many are reproduced.
/// What none rests on has no line.
pub fn bases(claims: &[Check]) -> Vec<[String; 3]> {
    let own = |basis: &&Basis| claims.iter().any(|claim| claim.basis == **basis);
    let line = |basis: &Basis| {
        let name = basis.words().replace(' ', "_");
        [basis.words().into(), mark(format!("score.{name}_of")), mark(format!("score.{name}"))]
    };
    Basis::ALL.iter().filter(own).map(line).collect()
}

/// The level of the claims, and what this copy was made with.
pub fn values(results: &Results) -> Vec<Value> {
    let level = claims::level();
    let values = vec![
        Value::integer("statistical_claims", level.claims),
        Value::real("claim_quantile", level.quantile, 3),
        Value::real("family_level", FAMILY_LEVEL, 1),
        Value::text("profile", results.profile.name()),
        Value::text("version", env!("CARGO_PKG_VERSION")),
    ];
    super::from(values, origin(claims::level), "")
}
