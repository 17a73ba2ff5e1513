//! Verdicts for machines: one entry for each claim, at the line of its statement.

use super::Judged;
use impact_paper::claims::{Check, Verdict, scorecard};
use impact_paper::report::claims::plain;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// A claim and the line of its statement.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'a> {
    /// The claim.
    pub claim: &'a Check,
    /// The file of its statement, from the folder of work if it lies there.
    pub file: &'a str,
    /// The line there, from 1.
    pub line: usize,
}

/// What a machine is told about a claim, in one line.
fn message(claim: &Check) -> String {
    let mut out = format!("{}: {}", claim.place, claim.statement);
    for (name, text) in [
        ("printed", claim.printed.clone()),
        ("found", plain(&claim.ours)),
        ("tolerance", plain(&claim.tolerance)),
        ("note", plain(&claim.note)),
    ] {
        if !text.is_empty() {
            let _ = write!(out, "; {name}: {text}");
        }
    }
    out
}

/// How bad a verdict is, as machines name it; None for what is well.
fn level(verdict: Verdict) -> Option<&'static str> {
    match verdict {
        Verdict::Differs => Some("error"),
        Verdict::CannotBeJudged => Some("warning"),
        Verdict::DiffersAndExplained => Some("note"),
        Verdict::Reproduced => None,
    }
}

/// A check for machines.
fn object(check: &Check) -> Value {
    json!({
        "id": check.id, "place": check.place, "statement": check.statement,
        "printed": check.printed, "found": plain(&check.ours),
        "tolerance": plain(&check.tolerance), "reason": check.reason,
        "basis": check.basis.words(), "verdict": check.words(), "fails": check.fails(),
        "note": plain(&check.note),
    })
}

/// All that is known, as JSON.
pub fn json(entries: &[Entry], judged: &Judged) -> String {
    let claim = |Entry { claim, file, line }: &Entry| {
        let mut own = object(claim);
        own["file"] = (*file).into();
        own["line"] = (*line).into();
        own
    };
    let score: serde_json::Map<String, Value> = scores(entries)
        .into_iter()
        .map(|(verdict, count)| (verdict.words().into(), count.into()))
        .collect();
    let all = json!({
        "score": score,
        "claims": entries.iter().map(claim).collect::<Vec<_>>(),
        "targets": judged.targets.iter().map(object).collect::<Vec<_>>(),
        "relations": judged.relations.iter().map(object).collect::<Vec<_>>(),
    });
    format!("{all:#}\n")
}

fn scores(entries: &[Entry]) -> Vec<(Verdict, usize)> {
    let claims: Vec<Check> = entries.iter().map(|entry| entry.claim.clone()).collect();
    Verdict::ALL.into_iter().zip(scorecard(&claims)).collect()
}

/// Most annotations that are worth a reader's time.
const ANNOTATIONS: usize = 10;

/// Commands of GitHub's log: guards that fail, and the worst claims, each at its line.
pub fn github(entries: &[Entry], judged: &Judged) -> String {
    let mut worst: Vec<&Entry> =
        entries.iter().filter(|entry| level(entry.claim.verdict).is_some()).collect();
    let rank = |entry: &&Entry| match entry.claim.verdict {
        Verdict::Differs => 0,
        Verdict::CannotBeJudged => 1,
        Verdict::DiffersAndExplained => 2,
        Verdict::Reproduced => 3,
    };
    worst.sort_by_key(rank);
    let mut out = String::new();
    for check in failing(&judged.relations).take(ANNOTATIONS) {
        let what = plain(&check.ours);
        let _ = writeln!(out, "::error title=relation {}::{}", property(&check.id), data(&what));
    }
    for Entry { claim, file, line } in worst.into_iter().take(ANNOTATIONS) {
        let kind = level(claim.verdict)
            .map_or("notice", |level| if level == "note" { "notice" } else { level });
        let title = property(&format!("{}: {}", claim.id, claim.verdict.words()));
        let text = data(&message(claim));
        let file = property(file);
        let _ = writeln!(out, "::{kind} file={file},line={line},title={title}::{text}");
    }
    out
}

fn failing(checks: &[Check]) -> impl Iterator<Item = &Check> {
    checks.iter().filter(|check| check.fails())
}

/// Text of a workflow command.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// A property of a workflow command.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

/// The whole as tables.
pub fn markdown(entries: &[Entry], judged: &Judged) -> String {
    let cell = |text: &str| text.replace('|', "\\|").replace('\n', " ");
    let mut out = String::from("## Claims\n\n| verdict | claims |\n|---|--:|\n");
    for (verdict, count) in scores(entries) {
        let _ = writeln!(out, "| {} | {count} |", verdict.words());
    }
    out.push_str(
        "\n| claim | place | printed | found | tolerance | verdict |\n|---|---|---|---|---|---|\n",
    );
    for Entry { claim, .. } in entries {
        let fields = [
            claim.id.clone(),
            claim.place.clone(),
            claim.printed.clone(),
            plain(&claim.ours),
            plain(&claim.tolerance),
        ];
        let mark = if claim.fails() { "**differs**" } else { claim.verdict.words() };
        let fields: Vec<String> = fields.iter().map(|text| cell(text)).collect();
        let _ = writeln!(out, "| {} | {mark} |", fields.join(" | "));
    }
    if !judged.targets.is_empty() {
        out.push_str("\n## Targets\n\n| target | bound | found | |\n|---|---|---|---|\n");
    }
    for target in &judged.targets {
        let fields = [&target.statement, &plain(&target.tolerance), &plain(&target.ours)];
        let fields = fields.map(|text| cell(text)).join(" | ");
        let _ = writeln!(out, "| {fields} | {} |", target.words());
    }
    if failing(&judged.relations).next().is_some() {
        out.push_str(
            "\n## Relations that do not hold\n\n| relation | what is wrong |\n|---|---|\n",
        );
    }
    for check in failing(&judged.relations) {
        let _ = writeln!(out, "| {} | {} |", check.id, cell(&plain(&check.ours)));
    }
    out
}
