//! Verdicts for machines: one entry for each claim, at the line of its statement.

use impact_paper::claims::targets::Target;
use impact_paper::claims::{Claim, Verdict, scorecard};
use impact_paper::report::claims::plain;
use impact_paper::report::guards::Failing;
use serde_json::json;
use std::fmt::Write as _;

/// The file that holds the statements, from the top of the project.
pub const FILE: &str = "templates/published.toml";

/// A claim and the line of its statement.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'a> {
    /// The claim.
    pub claim: &'a Claim,
    /// The line of its statement in [`FILE`], from 1.
    pub line: usize,
}

/// What a machine is told about a claim, in one line.
fn message(claim: &Claim) -> String {
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

/// All that is known, as JSON.
pub fn json(entries: &[Entry], targets: &[Target], failing: &[Failing]) -> String {
    let claims: Vec<_> = entries
        .iter()
        .map(|Entry { claim, line }| {
            json!({
                "id": claim.id, "place": claim.place, "statement": claim.statement,
                "printed": claim.printed, "found": plain(&claim.ours),
                "tolerance": plain(&claim.tolerance), "reason": claim.reason,
                "basis": claim.basis.words(),
                "verdict": claim.verdict.words(), "fails": claim.fails(),
                "note": plain(&claim.note), "file": FILE, "line": line,
            })
        })
        .collect();
    let targets: Vec<_> = targets
        .iter()
        .map(|target| {
            json!({
                "id": target.id, "what": target.what, "bound": plain(&target.bound),
                "found": plain(&target.found), "timed": target.timed,
                "standing": target.standing.words(),
            })
        })
        .collect();
    let score: serde_json::Map<String, serde_json::Value> = scores(entries)
        .into_iter()
        .map(|(verdict, count)| (verdict.words().into(), count.into()))
        .collect();
    let failing: Vec<_> =
        failing.iter().map(|f| json!({ "guard": f.name, "what": f.what })).collect();
    let all = json!({
        "score": score, "claims": claims, "targets": targets, "failing_guards": failing,
    });
    format!("{all:#}\n")
}

fn scores(entries: &[Entry]) -> Vec<(Verdict, usize)> {
    let claims: Vec<Claim> = entries.iter().map(|entry| entry.claim.clone()).collect();
    Verdict::ALL.into_iter().zip(scorecard(&claims)).collect()
}

/// Most annotations that are worth a reader's time.
const ANNOTATIONS: usize = 10;

/// Commands of GitHub's log: guards that fail, and the worst claims, each at its line.
pub fn github(entries: &[Entry], failing: &[Failing]) -> String {
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
    for Failing { name, what } in failing.iter().take(ANNOTATIONS) {
        let _ = writeln!(out, "::error title=guard {}::{}", property(name), data(what));
    }
    for Entry { claim, line } in worst.into_iter().take(ANNOTATIONS) {
        let kind = level(claim.verdict)
            .map_or("notice", |level| if level == "note" { "notice" } else { level });
        let title = property(&format!("{}: {}", claim.id, claim.verdict.words()));
        let text = data(&message(claim));
        let _ = writeln!(out, "::{kind} file={FILE},line={line},title={title}::{text}");
    }
    out
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
pub fn markdown(entries: &[Entry], targets: &[Target], failing: &[Failing]) -> String {
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
    if !targets.is_empty() {
        out.push_str("\n## Targets\n\n| target | bound | found | |\n|---|---|---|---|\n");
    }
    for target in targets {
        let (what, bound) = (cell(target.what), cell(&plain(&target.bound)));
        let (found, standing) = (cell(&plain(&target.found)), target.standing.words());
        let _ = writeln!(out, "| {what} | {bound} | {found} | {standing} |");
    }
    if !failing.is_empty() {
        out.push_str("\n## Guards that fail\n\n| guard | what is wrong |\n|---|---|\n");
    }
    for Failing { name, what } in failing {
        let _ = writeln!(out, "| {name} | {} |", cell(what));
    }
    out
}
