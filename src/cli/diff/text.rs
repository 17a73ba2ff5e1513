//! A comparison for the terminal.

use super::{by_weight, count, signed};
use impact_paper::report::compare::{Change, ClaimChange, Diff};
use literate::input::is_obeyed;

/// All of it.
pub fn text(old: &str, new: &str, diff: &Diff) -> String {
    if diff.is_empty() {
        return format!("{old} and {new}: nothing differs\n");
    }
    let mut out = String::new();
    let mut section = |title: String, lines: Vec<String>| {
        if !lines.is_empty() {
            out += &format!("{title}\n");
            // A report, and the name of a file, may hold what a terminal obeys.
            lines.iter().for_each(|line| out += &format!("  {}\n", line.replace(is_obeyed, " ")));
        }
    };
    let lines = diff.verdicts.iter().map(claim).collect();
    section(format!("{} changed", count(diff.verdicts.len(), "claim")), lines);
    let (numbers, other) = by_weight(&diff.numbers);
    let lines = numbers.into_iter().chain(other).map(value).collect();
    section(format!("{} changed", count(diff.numbers.len(), "number")), lines);
    let named = |what: &str, paths: &[String]| -> Vec<String> {
        paths.iter().map(|path| format!("{what} {path}")).collect()
    };
    let other = [named("new    ", &diff.gained), named("gone   ", &diff.lost)].concat();
    section("files".into(), [other, named("differs", &diff.differing)].concat());
    out
}

/// `reproduced -> differs`, `new, reproduced`, `gone, was reproduced`.
pub fn fate(before: Option<&str>, after: Option<&str>) -> String {
    match (before, after) {
        (Some(before), Some(after)) if before == after => before.into(),
        (Some(before), Some(after)) => format!("{before} -> {after}"),
        (None, Some(after)) => format!("new, {after}"),
        (Some(before), None) => format!("gone, was {before}"),
        (None, None) => String::new(),
    }
}

fn claim(change: &ClaimChange) -> String {
    let fields =
        [("ours", &change.ours), ("printed", &change.printed), ("tolerance", &change.tolerance)];
    let told = fields.into_iter().filter_map(|(name, pair)| {
        pair.as_ref().map(|[before, after]| format!("; {name}: {before} -> {after}"))
    });
    super::fate(change) + &told.collect::<String>()
}

fn value(change: &Change) -> String {
    let difference = change.difference.filter(|_| change.before != change.after);
    let difference = difference.map(|d| format!("; Δ {}", signed(d))).unwrap_or_default();
    let sigmas = change.sigmas.map(|s| format!(", {} σ", signed(s))).unwrap_or_default();
    format!("{change}{difference}{}", if difference.is_empty() { "" } else { &sigmas })
}
