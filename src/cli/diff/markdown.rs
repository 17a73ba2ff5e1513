//! A comparison as a comment on a pull request.

use super::text::fate;
use super::{by_weight, count, signed};
use impact_paper::report::compare::{Change, ClaimChange, Diff};
use impact_paper::report::markdown::escaped;
use impact_paper::report::spell;
use literate::input::{is_obeyed, one_line};

/// Of more rows the largest are shown.
const ROWS: usize = 40;

/// Hosts take comments of 65536 characters.
const LONGEST: usize = 60_000;

/// A cell is read, not studied.
const WIDTH: usize = 160;

/// The largest differences.
pub fn markdown(old: &str, new: &str, diff: &Diff) -> String {
    let mut out = format!("### What changes in the report: {} → {}\n\n", cell(old), cell(new));
    if diff.is_empty() {
        return out + "Nothing: every file has the same bytes.\n";
    }
    let counts = [count(diff.verdicts.len(), "claim"), count(diff.numbers.len(), "number")];
    out += &format!("{} changed.\n", sentence(&counts.join(", ")));
    let rows = diff.verdicts.iter().map(claim).collect();
    table(&mut out, "| Check | Verdict | Ours | Measure |\n|---|---|---|---|\n", rows);
    let (numbers, other) = by_weight(&diff.numbers);
    let rows = numbers.into_iter().map(value).collect();
    table(&mut out, "| Number | Before | Now | Δ | Δ/σ |\n|---|---|---|---|---|\n", rows);
    let ids = |new: bool| {
        let these = other.iter().filter(|change| change.after.is_some() == new);
        these.map(|change| change.id.clone()).collect::<Vec<String>>()
    };
    for (what, names) in [
        ("New numbers", &ids(true)),
        ("Numbers gone", &ids(false)),
        ("New files", &diff.gained),
        ("Files gone", &diff.lost),
        ("Other bytes", &diff.differing),
    ] {
        if !names.is_empty() {
            let shown: Vec<String> = names.iter().take(ROWS).map(|name| cell(name)).collect();
            let more = more(names.len().saturating_sub(ROWS));
            out += &format!("\n{what}: {}{more}\n", shown.join(", "));
        }
    }
    shortened(out)
}

/// Whole lines only.
fn shortened(mut text: String) -> String {
    if text.len() > LONGEST {
        let end = text.floor_char_boundary(LONGEST);
        text.truncate(text[..end].rfind('\n').map_or(end, |end| end + 1));
        text += "\nThe rest is too long for a comment.\n";
    }
    text
}

fn table(out: &mut String, head: &str, rows: Vec<String>) {
    if rows.is_empty() {
        return;
    }
    *out += &format!("\n{head}");
    rows.iter().take(ROWS).for_each(|row| *out += row);
    let more = more(rows.len().saturating_sub(ROWS));
    if !more.is_empty() {
        *out += &format!("\n{}\n", more.trim_start());
    }
}

fn more(number: usize) -> String {
    if number == 0 { String::new() } else { format!(" … and {number} more.") }
}

fn sentence(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map(|first| first.to_uppercase().chain(chars).collect()).unwrap_or_default()
}

/// One line of plain words for a cell.
fn cell(text: &str) -> String {
    // An at-sign would call somebody.
    let seen = one_line(&spell::text(text).replace(is_obeyed, " "), WIDTH);
    escaped(&seen.replace('@', "@\u{200b}"))
}

fn pair(pair: &Option<[String; 2]>) -> String {
    pair.as_ref()
        .map(|[before, after]| format!("{} → {}", cell(before), cell(after)))
        .unwrap_or_default()
}

fn claim(change: &ClaimChange) -> String {
    let verdict = fate(change.before.as_deref(), change.after.as_deref()).replace("->", "→");
    let measure = [pair(&change.printed), pair(&change.tolerance)];
    let measure: Vec<&str> = measure.iter().map(String::as_str).filter(|m| !m.is_empty()).collect();
    let [id, verdict, ours] = [cell(&change.id), cell(&verdict), pair(&change.ours)];
    format!("| {id} | {verdict} | {ours} | {} |\n", measure.join("; "))
}

fn value(change: &Change) -> String {
    let text = |text: &Option<String>| text.as_deref().map(cell).unwrap_or_default();
    let number = |value: Option<f64>| value.map(signed).unwrap_or_default();
    let id = match pair(&change.kind) {
        kind if kind.is_empty() => cell(&change.id),
        kind => format!("{} ({kind})", cell(&change.id)),
    };
    let (before, after) = (text(&change.before), text(&change.after));
    let (difference, sigmas) = (number(change.difference), number(change.sigmas));
    format!("| {id} | {before} | {after} | {difference} | {sigmas} |\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_plain_words() {
        assert_eq!(cell("a|b\n<c> $x$ @d"), escaped("a|b <c> x @\u{200b}d"));
        assert!(!cell("[a](http://b)").contains("[a](http"));
        assert!(cell(&"x".repeat(9999)).chars().count() <= WIDTH + 1);
    }

    #[test]
    fn a_comment_has_a_length() {
        let change = |i| ClaimChange {
            id: format!("claim{i}"),
            before: Some("é_".repeat(200)),
            after: Some("x".into()),
            ours: Some(["_".repeat(300), "|".repeat(300)]),
            printed: Some(["_".repeat(300), "|".repeat(300)]),
            tolerance: Some(["_".repeat(300), "|".repeat(300)]),
        };
        let diff = Diff { verdicts: (0..99).map(change).collect(), ..Diff::default() };
        let text = markdown("a", "b", &diff);
        assert!(text.chars().count() < 65536 && text.ends_with("too long for a comment.\n"));
        assert!(text.lines().filter(|line| line.starts_with("| claim")).all(|l| l.ends_with(" |")));
        let few = Diff { gained: (0..50).map(|i| i.to_string()).collect(), ..Diff::default() };
        assert!(markdown("a", "b", &few).ends_with("39 … and 10 more.\n"));
    }
}
