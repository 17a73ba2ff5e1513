//! What is held against something else: statements of the paper, targets, and relations between numbers.

use super::Failure;
use crate::claims::relations::relations;
use crate::claims::targets::targets;
use crate::claims::{Basis, Check, Kind, Verdict, score};
use crate::experiments::Results;
use literate::input::count;

/// All checks of results but the statements of the paper: targets and relations.
///
/// # Errors
/// If a result was not run.
pub fn own(results: &Results) -> Result<Vec<Check>, Failure> {
    Ok([targets(results)?, relations(results)?].concat())
}

/// The checks of one kind.
pub fn of(checks: &[Check], kind: Kind) -> impl Iterator<Item = &Check> + Clone {
    checks.iter().filter(move |check| check.kind == kind)
}

/// The scores: of the paper's statements, and of our targets and relations where they were asked.
pub fn scores(checks: &[Check]) -> Vec<String> {
    let claims = of(checks, Kind::Statement);
    let counts: Vec<String> = Verdict::ALL
        .iter()
        .zip(score(claims.clone()))
        .map(|(verdict, count)| format!("{} {count}", verdict.words()))
        .collect();
    let bases = Basis::ALL.iter().filter_map(|basis| {
        let counts = score(claims.clone().filter(|check| check.basis == *basis));
        let all: usize = counts.iter().sum();
        (all > 0).then(|| format!("{} of {all} {}", counts[0], basis.words()))
    });
    let mut lines = vec![
        format!(
            "{} of the paper: {}",
            count(claims.clone().count(), "statement"),
            counts.join(", ")
        ),
        format!(
            "reproduced, by what the verdict rests on: {}",
            bases.collect::<Vec<_>>().join(", ")
        ),
    ];
    if of(checks, Kind::Relation).next().is_some() {
        let [held, _, broken, open] = score(of(checks, Kind::Relation));
        let all = held + broken + open;
        lines.push(format!("our own checks: {held} of {all} relations between numbers hold"));
        let [met, _, missed, open] = score(of(checks, Kind::Target));
        let late =
            of(checks, Kind::Target).filter(|own| own.verdict == Verdict::Differs && !own.fails());
        lines.push(format!(
            "{} targets: {met} met, {missed} missed ({} of these by the clock), {open} not measured",
            met + missed + open,
            late.count()
        ));
    }
    lines
}

/// Exit code 1, with names, for what does not hold. Times of the clock decide nothing.
pub fn verdict(checks: &[Check]) -> Result<(), Failure> {
    let faults = [
        (Kind::Statement, "statements differ without an explanation that holds"),
        (Kind::Target, "targets of accuracy or counted work are missed"),
        (Kind::Relation, "relations between numbers of the report do not hold"),
    ];
    let told = faults.into_iter().filter_map(|(kind, what)| {
        let names = of(checks, kind).filter(|check| check.fails()).map(|check| check.id.as_str());
        let names: Vec<&str> = names.collect();
        (!names.is_empty()).then(|| format!("{what}: {}", names.join(", ")))
    });
    let told: Vec<String> = told.collect();
    if told.is_empty() { Ok(()) } else { Err(Failure::check(told.join("; "))) }
}
