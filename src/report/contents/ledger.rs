//! The claims as the templates see them, and what the text says about all of them.

use crate::claims::{self, Claim, Digits, FAMILY_LEVEL, Number, Piece, Text, Verdict};
use crate::experiments::Results;
use crate::params::Profile;
use crate::report::print::{Printed, Style, print};
use crate::report::values::{self, Value};
use serde::Serialize;
use std::collections::BTreeMap;

/// One row of the table of claims, each cell in Markdown.
#[derive(Debug, Serialize)]
pub struct Row {
    row: String,
    place: String,
    statement: String,
    printed: String,
    ours: String,
    tolerance: String,
    reason: String,
    verdict: &'static str,
    note: String,
}

/// A number of a claim with the digits that it deserves.
fn printed(number: &Number) -> Printed {
    let value = number.value;
    let number = match number.digits {
        Digits::Error(error) => {
            values::Number::Real { value, digits: values::Digits::Error(error) }
        }
        Digits::Decimals(n) => {
            values::Number::Real { value, digits: values::Digits::Decimals(n.into()) }
        }
        Digits::Significant(n) => {
            values::Number::Real { value, digits: values::Digits::Significant(n.into()) }
        }
        Digits::Integer => values::Number::Integer(value as i64),
    };
    print(&number, Style::default())
}

fn written(text: &Text, number: fn(&Printed) -> String) -> String {
    let piece = |piece: &Piece| match piece {
        Piece::Words(words) => words.clone(),
        Piece::Number(n) => number(&printed(n)),
    };
    text.0.iter().map(piece).collect()
}

/// A text of a claim in Markdown.
pub fn markdown(text: &Text) -> String {
    written(text, Printed::markdown)
}

/// A text of a claim for a terminal.
pub fn plain(text: &Text) -> String {
    written(text, Printed::plain)
}

/// The rows of the table.
pub fn rows(claims: &[Claim]) -> Vec<Row> {
    let row = |claim: &Claim| Row {
        row: format!("[!claim:{}]", claim.id),
        place: claim.place.clone(),
        statement: claim.statement.clone(),
        printed: claim.printed.clone(),
        ours: markdown(&claim.ours),
        tolerance: markdown(&claim.tolerance),
        reason: claim.reason.clone(),
        verdict: claim.verdict.words(),
        note: markdown(&claim.note),
    };
    claims.iter().map(row).collect()
}

/// For each claim, a reference to its row with the verdict: `«row.sec7_jump»`.
pub fn references(claims: &[Claim]) -> BTreeMap<&str, String> {
    let reference = |claim: &Claim| format!("[@claim:{}], *{}*", claim.id, claim.verdict.words());
    claims.iter().map(|claim| (claim.id.as_str(), reference(claim))).collect()
}

/// Numbers about the claims, and about this copy of the report.
pub fn values(results: &Results, claims: &[Claim]) -> Vec<Value> {
    let level = claims::level();
    let score = |verdict: Verdict| claims.iter().filter(|c| c.verdict == verdict).count();
    let profile = match results.profile {
        Profile::Quick => "quick",
        Profile::Ci => "ci",
        Profile::Full => "full",
    };
    let values = vec![
        Value::integer("claims_total", claims.len()),
        Value::integer("claims_reproduced", score(Verdict::Reproduced)),
        Value::integer("claims_explained", score(Verdict::DiffersAndExplained)),
        Value::integer("claims_differ", score(Verdict::Differs)),
        Value::integer("claims_open", score(Verdict::CannotBeJudged)),
        Value::integer("statistical_claims", level.claims),
        Value::real("claim_quantile", level.quantile, 3),
        Value::real("family_level", FAMILY_LEVEL, 1),
        Value::text("profile", profile),
        Value::text("version", env!("CARGO_PKG_VERSION")),
    ];
    super::from(values, "claims::all", "")
}
