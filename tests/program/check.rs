//! `impact-paper check` for machines: every form says of every claim what the text says.

use crate::{TEMPLATES, outcome, program, run};
use impact_paper::claims::Basis;
use std::path::Path;

fn check(folder: &Path, arguments: &[&str], summary: Option<&Path>) -> (i32, String, String) {
    let mut command = program(folder, "check --profile quick --results r --templates");
    command.arg(TEMPLATES).args(arguments).env_remove("GITHUB_STEP_SUMMARY");
    if let Some(summary) = summary {
        command.env("GITHUB_STEP_SUMMARY", summary);
    }
    outcome(&mut command)
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap()
}

fn list<'a>(value: &'a serde_json::Value, pointer: &str) -> &'a Vec<serde_json::Value> {
    value.pointer(pointer).and_then(|found| found.as_array()).unwrap_or_else(|| panic!("{pointer}"))
}

#[test]
fn every_form_has_every_claim_at_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let form = |name| check(folder.path(), &["--format", name, "--all"], None);
    let (code, text, _) = form("text");
    let verdicts: Vec<(String, String)> = text
        .lines()
        .filter(|line| line.starts_with("ok ") || line.starts_with("FAILS"))
        .map(|line| {
            let (head, verdict) = line[6..].rsplit_once(": ").unwrap();
            let (verdict, basis) = verdict.split_once(" (").unwrap();
            assert!(Basis::ALL.iter().any(|own| format!("{})", own.words()) == basis), "{line}");
            (head.split(' ').next().unwrap().to_string(), verdict.to_string())
        })
        .collect();
    assert_eq!(verdicts.len(), 71, "{text}");
    // Without --all only what is not simply reproduced.
    let (_, short, _) = check(folder.path(), &[], None);
    let listed = short.lines().filter(|line| line.starts_with("ok ")).count();
    let other = verdicts.iter().filter(|(_, verdict)| verdict != "reproduced").count();
    assert!(listed == other && other < 71 && short.contains("--all"), "{short}");
    // The statements of the paper and our own checks are scored apart.
    let scores: Vec<&str> = text.lines().rev().take(3).collect();
    assert!(scores[2].starts_with("71 statements of the paper: "), "{text}");
    let explained = verdicts.iter().filter(|(_, own)| own == "differs and explained").count();
    assert!(scores[2].contains(&format!(", differs and explained {explained}, ")), "{text}");
    assert!(scores[1].starts_with("reproduced, by what the verdict rests on: "), "{text}");
    assert!(scores[0].starts_with("our own checks: "), "{text}");
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/templates/published.toml");
    let published = std::fs::read_to_string(file).unwrap();
    let lines: Vec<&str> = published.lines().collect();

    let (same, out, _) = form("json");
    assert_eq!(same, code);
    let all = json(&out);
    let claims = list(&all, "/claims");
    assert_eq!(claims.len(), verdicts.len());
    for (claim, (id, verdict)) in claims.iter().zip(&verdicts) {
        assert_eq!(
            (claim["id"].as_str(), claim["verdict"].as_str()),
            (Some(&**id), Some(&**verdict))
        );
        let basis = claim["basis"].as_str();
        assert!(Basis::ALL.iter().any(|own| Some(own.words()) == basis), "{claim}");
        let line = claim["line"].as_u64().unwrap() as usize;
        assert_eq!(lines[line - 1], format!("id = \"{id}\""));
    }
    assert!(list(&all, "/targets").len() > 10);

    let (_, out, _) = form("markdown");
    let rows = out.lines().filter(|line| line.starts_with("| sec"));
    assert_eq!(rows.count(), verdicts.len(), "{out}");
    let columns = |line: &str| line.replace("\\|", "").matches('|').count();
    assert!(out.lines().filter(|line| line.starts_with("| sec")).all(|line| columns(line) == 7));

    let summary = folder.path().join("summary.md");
    std::fs::write(&summary, "before\n").unwrap();
    let (_, out, _) = check(folder.path(), &["--format", "github"], Some(&summary));
    let told = std::fs::read_to_string(&summary).unwrap();
    assert!(
        told.starts_with("before\n## Claims") && told.contains("| sec2_half_height |"),
        "{told}"
    );
    let annotations: Vec<&str> = out.lines().collect();
    assert_eq!(annotations.len(), 10, "{out}");
    // The worst come first.
    let rank =
        |line: &&str| ["::error", "::warning", "::notice"].iter().position(|k| line.starts_with(k));
    assert!(annotations.is_sorted_by_key(|line| rank(line).unwrap()), "{out}");
    let file = format!(" file={TEMPLATES}/published.toml,line=");
    assert!(annotations[0].contains(&file), "{out}");
}

/// A change of what is printed, more arguments, and signs of it in text, annotations and Markdown.
type Wrong<'a> = (fn(&str) -> String, &'a str, [&'a str; 3]);

/// A number of the paper that was other than it is, and one that is read otherwise than it is printed: every form shows
/// it, by the name of the claim or guard, and the exit code is 1.
#[test]
fn what_does_not_hold_is_an_error_in_every_form() {
    let edges = |text: &str| {
        let at = text.find("id = \"sec3_edges\"").unwrap();
        let value = at + text[at..].find("value = ").unwrap() + "value = ".len();
        format!("{}9{}", &text[..value], &text[value..])
    };
    let more = |text: &str| text.replacen("printed = \"16\"", "printed = \"16 or 99\"", 1);
    // The file is named from the folder of work, however it was given.
    let annotation = "::error file=t/published.toml,line=";
    let guard = "::error title=relation printed_as_it_reads::";
    let cases: [Wrong; 2] = [
        (edges, " --claim sec3_edges", ["FAILS sec3_edges", annotation, "**differs**"]),
        (more, "", ["FAILS relation printed_as_it_reads: ", guard, "| printed_as_it_reads | "]),
    ];
    for (change, more, [text, github, markdown]) in cases {
        let folder = tempfile::tempdir().unwrap();
        crate::templates(&folder.path().join("t"), "published.toml", change);
        for (form, sign) in [
            ("text", text),
            ("json", "\"fails\": true"),
            ("github", github),
            ("markdown", markdown),
        ] {
            let check = "check --profile quick --results r --templates";
            let given = folder.path().canonicalize().unwrap().join("t");
            let command = format!("{check} {} --format {form}{more}", given.display());
            let (code, out, note) = run(folder.path(), &command);
            assert_eq!(code, 1, "{note}");
            assert!(out.contains(sign), "{sign}: {out}");
            assert!(
                !more.is_empty() || note.contains("do not hold: printed_as_it_reads"),
                "{note}"
            );
        }
    }
}
