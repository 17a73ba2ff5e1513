//! Gives the templates what is in no table: some values, and the rows of generated tables.
//!
//! A value is computed here from results and carries the path of the function that computed it,
//! which the compiler gives ([`literate::value::origin`]). Groups are `v` (ours), `paper` (numbers
//! that the paper chose) and `printed` (numbers in its statements).

use crate::claims::{self, Basis, Check, FAMILY_LEVEL, Kind, Published, Verdict};
use crate::experiments::accuracy::case::{Outcome, Scene, scenes};
use crate::experiments::accuracy::tables::titled;
use crate::experiments::accuracy::trials::{Trial, right, trouble};
use crate::experiments::programs::Program;
use crate::experiments::{PROGRAMS, Results, TRIALS};
use literate::Failure;
use literate::report::framed;
use literate::value::{Value, origin};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;

/// The level of the checks, and the version of the program.
pub fn values(_: &Results, _: &Published) -> Result<Vec<Value>, Failure> {
    let level = claims::level();
    let values = [
        Value::integer("statistical_claims", level.claims),
        Value::real("claim_quantile", level.quantile, 3),
        Value::real("family_level", FAMILY_LEVEL, 1),
        Value::words("version", env!("CARGO_PKG_VERSION")),
    ];
    Ok(values.map(|value| value.source(origin(claims::level))).into())
}

/// The rows of the generated tables, by the name that templates use, with heads and words that
/// depend on the results.
pub fn rows(results: &Results, checks: &[Check]) -> Result<BTreeMap<&'static str, Json>, Failure> {
    let trials = results.of(&TRIALS)?;
    let statements: Vec<&Check> =
        checks.iter().filter(|check| check.kind == Kind::Statement).collect();
    let methods = || trials.parameters.settings.chunk_by(|a, b| a.method == b.method);
    let heads: Vec<String> = methods().map(titled).collect();
    let sizes: Vec<usize> = methods().map(<[_]>::len).collect();
    let trials = trials.parameters.scenes.iter().zip(&trials.found);
    let tested: Vec<&Program> =
        results.of(&PROGRAMS)?.iter().filter(|of| !of.settings.is_empty()).collect();
    Ok(BTreeMap::from([
        ("basis_table", Basis::ALL.iter().filter_map(|basis| split(*basis, &statements)).collect()),
        ("scene_heads", json!(heads)),
        ("scene_table", trials.map(|(all, found)| scene(&all.what, found, &sizes)).collect()),
        ("program_heads", json!(tested.iter().map(|of| &of.settings[0].name).collect::<Vec<_>>())),
        ("program_table", program_table(&tested)),
    ]))
}

/// A basis, how many statements rest on it, how many of these are reproduced, and a sign for each,
/// by verdict; none if no statement rests on it.
fn split(basis: Basis, checks: &[&Check]) -> Option<Json> {
    let mut own: Vec<_> = checks.iter().filter(|check| check.basis == basis).collect();
    own.sort_by_key(|check| Verdict::ALL.iter().position(|verdict| *verdict == check.verdict));
    let signs: Vec<_> = own.iter().map(|check| format!("[@sign:{}]", check.id)).collect();
    let words = basis.words();
    (!own.is_empty()).then(|| {
        json!({
            "basis": words,
            "all": mark(&format!("{words}_of")),
            "reproduced": mark(words),
            "signs": signs.join(" "),
        })
    })
}

/// The value of the scorecard with this name, as a template writes it.
fn mark(name: &str) -> String {
    framed(&format!("score.{}", name.replace(' ', "_")), "")
}

/// The rows of the table of scenes for programs that people use.
fn program_table(tested: &[&Program]) -> Json {
    let sizes: Vec<usize> = tested.iter().map(|of| of.settings.len()).collect();
    let row = |of_scene: &Scene| {
        let runs = tested.iter().flat_map(|of| &of.settings);
        let found: Vec<Trial> = runs.map(|run| run.trial(of_scene).clone()).collect();
        scene(&of_scene.what, &found, &sizes)
    };
    scenes().iter().map(row).collect()
}

/// What goes wrong most often in a scene with each method, at its settings from coarse to fine, and
/// in how many cases; and whether failures end with an error or with a wrong result that looks like
/// a right one. No method here warns of a result that it gives. `sizes` counts settings by method.
fn scene(what: &str, trials: &[Trial], sizes: &[usize]) -> Json {
    // In how many cases, and what.
    let outcome = |trial: &Trial| match (trouble(trial), trial.len() - right(trial), trial.len()) {
        (None, ..) => (String::new(), "right"),
        (Some(trouble), _, 1) => (String::new(), trouble.words()),
        (Some(trouble), wrong, all) if wrong == all => ("all".into(), trouble.words()),
        (Some(trouble), wrong, _) => (wrong.to_string(), trouble.words()),
    };
    let (mut cells, mut all) = (Vec::new(), trials.iter());
    for &size in sizes {
        let mut outcomes: Vec<_> = all.by_ref().take(size).map(outcome).collect();
        if outcomes.iter().all(|other| *other == outcomes[0]) {
            outcomes.truncate(1);
        }
        // Of neighbours with the same words, the last has them.
        let text = |(i, (number, words)): (usize, &(String, &str))| match outcomes.get(i + 1) {
            Some(next) if next.1 == *words && !number.is_empty() => number.clone(),
            _ => format!("{number} {words}").trim().to_string(),
        };
        cells.push(outcomes.iter().enumerate().map(text).collect::<Vec<_>>().join("; "));
    }
    let mut all = trials.iter().flatten();
    let said =
        |outcome: &Outcome| matches!(outcome, Outcome::GaveUp | Outcome::Refused | Outcome::Warned);
    let announced = all.clone().any(said);
    let silent = all.any(|outcome| *outcome != Outcome::Right && !said(outcome));
    let failure = match (announced, silent) {
        (false, false) => "–",
        (true, false) => "announced",
        (false, true) => "silent",
        (true, true) => "silent or announced",
    };
    json!({"name": what, "cases": trials[0].len(), "cells": cells, "failure": failure})
}
