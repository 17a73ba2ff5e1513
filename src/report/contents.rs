//! What the templates can name beside the cells of tables: some values, and the rows of generated tables.
//!
//! A value is computed here from results and carries the path of the function that computed it, which the
//! compiler gives ([`super::values::origin`]). Groups are `v` (ours), `paper` (numbers that the paper chose) and
//! `printed` (numbers in its statements).

use super::claims::printed;
use super::mark::framed;
use super::values::{Registry, Value, origin};
use crate::claims::{self, Basis, Check, FAMILY_LEVEL, Published, Verdict};
use crate::experiments::accuracy::case;
use crate::experiments::accuracy::tables::titled;
use crate::experiments::accuracy::trials::{Trial, right, trouble};
use crate::experiments::{Results, TRIALS};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;

/// What can go wrong between results and values.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A result or a printed number is missing.
    #[error(transparent)]
    Claims(#[from] claims::Error),
    /// An experiment was not run.
    #[error(transparent)]
    Experiment(#[from] crate::experiments::Error),
    /// A value that the registry refuses.
    #[error(transparent)]
    Report(#[from] super::Error),
    /// A table that is not JSON.
    #[error("the rows of a table: {0}")]
    Rows(#[from] serde_json::Error),
}

/// All values of the report.
///
/// # Errors
/// If a result is missing, or two values have one id.
pub fn registry(results: &Results, published: &Published) -> Result<Registry, Error> {
    let mut registry = Registry::new();
    registry.extend(printed(published))?;
    registry.extend(about(results))?;
    results.tables().values().try_for_each(|table| registry.add_table(table.clone()))?;
    Ok(registry)
}

/// The level of the checks, and what this copy was made with.
fn about(results: &Results) -> impl Iterator<Item = Value> {
    let level = claims::level();
    let values = [
        Value::integer("statistical_claims", level.claims),
        Value::real("claim_quantile", level.quantile, 3),
        Value::real("family_level", FAMILY_LEVEL, 1),
        Value::text("profile", results.profile.name()),
        Value::text("version", env!("CARGO_PKG_VERSION")),
    ];
    values.into_iter().map(|value| value.source(origin(claims::level), ""))
}

/// The rows of the generated tables, by the name that templates use; beside them heads and words that depend on the
/// results.
///
/// # Errors
/// If a result is missing.
pub fn rows(results: &Results, checks: &[Check]) -> Result<BTreeMap<&'static str, Json>, Error> {
    let trials = results.of(&TRIALS)?;
    let heads: Vec<String> = trials.parameters.settings.iter().map(|s| titled(*s)).collect();
    Ok(BTreeMap::from([
        ("scorecard", Verdict::ALL.iter().map(|verdict| score(*verdict, checks)).collect()),
        ("basis_table", Basis::ALL.iter().filter_map(|basis| split(*basis, checks)).collect()),
        ("strip", checks.chunk_by(|a, b| section(a) == section(b)).map(strip).collect()),
        ("scene_heads", json!(heads)),
        ("scene_table", trials.scenes.iter().map(|(what, trials)| scene(what, trials)).collect()),
    ]))
}

fn section(check: &Check) -> &str {
    check.id.split('_').next().unwrap_or_default()
}

/// The verdicts on the statements of one section of the paper: signs that lead to their rows.
fn strip(own: &[Check]) -> Json {
    let signs: Vec<String> = own.iter().map(|check| format!("[@sign:{}]", check.id)).collect();
    json!({"place": section(&own[0]).replace("sec", "Sec.\u{a0}"), "signs": signs.join(" ")})
}

/// How many statements have a verdict, and references to them.
fn score(verdict: Verdict, checks: &[Check]) -> Json {
    let own = checks.iter().filter(|check| check.verdict == verdict);
    let own: Vec<String> = own.map(|check| format!("@claim:{}", check.id)).collect();
    let which = if own.is_empty() { "none".into() } else { format!("[{}]", own.join("; ")) };
    json!({"verdict": verdict.words(), "count": mark(verdict.words()), "claims": which})
}

/// A basis, how many statements rest on it, and how many of these are reproduced. What none rests on has no line.
fn split(basis: Basis, checks: &[Check]) -> Option<Json> {
    checks.iter().find(|check| check.basis == basis)?;
    let words = basis.words();
    Some(json!([words, mark(&format!("{words}_of")), mark(words)]))
}

/// The value of the scorecard with this name, as a template writes it.
fn mark(name: &str) -> String {
    framed(&format!("score.{}", name.replace(' ', "_")), "")
}

/// In how many cases of a scene each method is right, and what goes wrong else; and whether failures end with an error
/// or with a wrong result that looks like a right one. No method here warns of a result that it gives.
fn scene(what: &str, trials: &[Trial]) -> Json {
    use case::Verdict::{GaveUp, Right};
    let cell = |trial: &Trial| match (trouble(trial), right(trial), trial.len()) {
        (None, ..) => "right".to_string(),
        (Some(trouble), 0, 1) => trouble.words().to_string(),
        (Some(trouble), right, all) => {
            format!("{right} of {all} right, else {}", trouble.words())
        }
    };
    let mut all = trials.iter().flatten();
    let refused = all.clone().any(|verdict| *verdict == GaveUp);
    let silent = all.any(|verdict| !matches!(verdict, Right | GaveUp));
    let told = match (refused, silent) {
        (false, false) => "–",
        (true, false) => "refused",
        (false, true) => "silent",
        (true, true) => "silent or refused",
    };
    json!({"name": what, "cells": trials.iter().map(cell).collect::<Vec<_>>(), "told": told})
}
