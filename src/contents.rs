//! Gives the templates what is in no table: some values, and the rows of generated tables.
//!
//! A value is computed here from results and carries the path of the function that computed it,
//! which the compiler gives ([`literate::value::origin`]). Groups are `v` (ours), `paper` (numbers
//! that the paper chose) and `printed` (numbers in its statements).

use crate::claims::{self, Basis, Check, FAMILY_LEVEL, Kind, Published, Verdict};
use crate::experiments::accuracy::case::Outcome::{self, GaveUp, Refused, Right, Warned};
use crate::experiments::accuracy::case::{Scene, scenes};
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
    let statements = Vec::from_iter(checks.iter().filter(|check| check.kind == Kind::Statement));
    let methods = || trials.parameters.settings.chunk_by(|a, b| a.method == b.method);
    let heads: Vec<String> = methods().map(titled).collect();
    let sizes: Vec<usize> = methods().map(<[_]>::len).collect();
    let trials = trials.parameters.scenes.iter().zip(&trials.trials);
    let programs = results.of(&PROGRAMS)?.iter();
    let programs: Vec<&Program> = programs.filter(|program| !program.settings.is_empty()).collect();
    Ok(BTreeMap::from([
        (
            "basis_table",
            Basis::ALL.iter().filter_map(|basis| basis_row(*basis, &statements)).collect(),
        ),
        ("scene_heads", json!(heads)),
        ("scene_table", trials.map(|(scene, trials)| scene_row(scene, trials, &sizes)).collect()),
        (
            "program_heads",
            json!(programs.iter().map(|program| &program.settings[0].name).collect::<Vec<_>>()),
        ),
        ("program_table", program_table(&programs)),
    ]))
}

/// Returns a basis, how many statements rest on it, how many of these are reproduced, and a sign
/// for each, by verdict, or `None` if no statement rests on it.
fn basis_row(basis: Basis, checks: &[&Check]) -> Option<Json> {
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

/// Returns the mark that stands for a value of the scorecard in a template.
fn mark(name: &str) -> String {
    framed(&format!("score.{}", name.replace(' ', "_")), "")
}

/// Returns the rows of the table of scenes for programs that people use.
fn program_table(programs: &[&Program]) -> Json {
    let sizes: Vec<usize> = programs.iter().map(|program| program.settings.len()).collect();
    let row = |scene: &Scene| {
        let runs = programs.iter().flat_map(|program| &program.settings);
        let trials: Vec<Trial> = runs.map(|run| run.trial(scene).clone()).collect();
        scene_row(scene, &trials, &sizes)
    };
    scenes().iter().map(row).collect()
}

/// Returns what goes wrong most often in a scene with each method, at its settings from coarse to
/// fine, and in how many cases; and whether failures end with an error or with a wrong result that
/// looks like a right one. No method here warns of a result that it gives. `sizes` counts the
/// settings of each method.
fn scene_row(scene: &Scene, trials: &[Trial], sizes: &[usize]) -> Json {
    // In how many cases, and the label of the outcome.
    let outcome = |trial: &Trial| match (trouble(trial), trial.len() - right(trial), trial.len()) {
        (None, ..) => (String::new(), "right"),
        (Some(trouble), _, 1) => (String::new(), trouble.label()),
        (Some(trouble), wrong, cases) if wrong == cases => ("all".into(), trouble.label()),
        (Some(trouble), wrong, _) => (wrong.to_string(), trouble.label()),
    };
    let (mut cells, mut settings) = (Vec::new(), trials.iter());
    for &size in sizes {
        let mut outcomes: Vec<_> = settings.by_ref().take(size).map(outcome).collect();
        if outcomes.iter().all(|other| *other == outcomes[0]) {
            outcomes.truncate(1);
        }
        // Of neighbours with the same label, the last has it.
        let part = |(i, (number, label)): (usize, &(String, &str))| match outcomes.get(i + 1) {
            Some(next) if next.1 == *label && !number.is_empty() => number.clone(),
            _ => format!("{number} {label}").trim().to_string(),
        };
        cells.push(outcomes.iter().enumerate().map(part).collect::<Vec<_>>().join("; "));
    }
    let mut outcomes = trials.iter().flatten();
    let is_said = |outcome: &Outcome| matches!(outcome, GaveUp | Refused | Warned);
    let says_so = outcomes.clone().any(is_said);
    let is_silent = outcomes.any(|outcome| *outcome != Right && !is_said(outcome));
    let failure = match (says_so, is_silent) {
        (false, false) => "–",
        (true, false) => "announced",
        (false, true) => "silent",
        (true, true) => "silent or announced",
    };
    json!({"name": scene.title, "cases": trials[0].len(), "cells": cells, "failure": failure})
}
