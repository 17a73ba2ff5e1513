//! A comparison for the terminal.

use super::{by_weight, count, signed};
use impact_paper::input::{is_obeyed, one_line};
use impact_paper::report::compare::{Change, ClaimChange, Diff, Piece, ProseChange};

/// So many characters of what stayed lead from one change of a sentence to the next.
const AROUND: usize = 160;

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
    section("prose".into(), prose(&diff.prose));
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

fn prose(changes: &[ProseChange]) -> Vec<String> {
    let mut lines: Vec<String> = reworded(changes).into_iter().collect();
    for change in changes {
        for part in change.sentences.chunk_by(|a, b| a.section == b.section) {
            lines.push(format!("{}, {}", change.document, part[0].section));
            lines.extend(part.iter().map(|sentence| {
                let marks = [["[-", "-]"], ["{+", "+}"]];
                format!("  {}", words(&sentence.pieces, marks, "", str::to_owned))
            }));
        }
    }
    lines
}

/// How many sentences differ, if a document does.
pub fn reworded(changes: &[ProseChange]) -> Option<String> {
    let words = changes.iter().map(|change| change.sentences.len()).sum();
    let numbers: usize = changes.iter().map(|change| change.numbers_alone).sum();
    let told = || {
        let words = count(words, "sentence");
        format!("{words} with other words, {numbers} with other numbers alone")
    };
    (!changes.is_empty()).then(told)
}

/// A sentence with marks about what went and what came.
pub fn words(
    pieces: &[Piece],
    marks: [[&str; 2]; 2],
    between: &str,
    told: impl Fn(&str) -> String,
) -> String {
    let marked = |(text, [open, close]): (&String, [&str; 2])| {
        (!text.is_empty()).then(|| format!("{open}{}{close}", told(text)))
    };
    let piece = |piece: &Piece| match piece {
        Piece::Same(text) => told(&one_line(text, AROUND)),
        Piece::Changed(texts) => {
            texts.iter().zip(marks).filter_map(marked).collect::<Vec<_>>().join(between)
        }
    };
    pieces.iter().map(piece).collect::<Vec<_>>().join(" ")
}
