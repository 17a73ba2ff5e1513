//! `impact-paper check` for people and machines: every form says of every statement what the others say.

use crate::{TEMPLATES, run};
use impact_paper::claims::Basis;
use serde_json::Value;
use std::path::Path;

fn check(folder: &Path, more: &str) -> (i32, String, String) {
    run(folder, format!("check --profile quick --results r --templates {TEMPLATES} {more}").trim())
}

#[test]
fn every_form_has_every_statement_at_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let (code, text, _) = check(folder.path(), "--all");
    let verdicts: Vec<(String, String)> = text
        .lines()
        .filter(|line| !line.starts_with(' ') && line[6.min(line.len())..].starts_with("sec"))
        .map(|line| {
            let (head, verdict) = line[6..].rsplit_once(": ").unwrap();
            let (verdict, basis) = verdict.split_once(" (").unwrap();
            assert!(Basis::ALL.iter().any(|own| format!("{})", own.words()) == basis), "{line}");
            assert_eq!(line.starts_with("open"), verdict == "cannot be judged", "{line}");
            (head.split(' ').next().unwrap().to_string(), verdict.to_string())
        })
        .collect();
    assert_eq!(verdicts.len(), 71, "{text}");
    // Without --all only what is not simply reproduced.
    let (_, short, _) = check(folder.path(), "");
    assert!(!short.contains(": reproduced (") && short.contains("--all"), "{short}");
    // The statements of the paper and our own checks are scored apart.
    let scores: Vec<&str> = text.lines().rev().take(4).collect();
    assert!(scores[3].starts_with("71 statements of the paper: "), "{text}");
    let explained = verdicts.iter().filter(|(_, own)| own == "differs and explained").count();
    assert!(scores[3].contains(&format!(", differs and explained {explained}, ")), "{text}");
    assert!(scores[2].starts_with("reproduced, by what the verdict rests on: "), "{text}");
    assert!(scores[1].starts_with("our own checks: ") && scores[0].contains("targets"), "{text}");

    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/templates/published.toml");
    let published = std::fs::read_to_string(file).unwrap();
    let lines: Vec<&str> = published.lines().collect();
    let (same, out, _) = check(folder.path(), "--format json");
    assert_eq!(same, code);
    let all: Value = serde_json::from_str(&out).unwrap();
    let claims = all["claims"].as_array().unwrap();
    assert_eq!(claims.len(), verdicts.len());
    for (claim, (id, verdict)) in claims.iter().zip(&verdicts) {
        assert_eq!(
            (&claim["id"], &claim["verdict"]),
            (&id.as_str().into(), &verdict.as_str().into())
        );
        let line = claim["line"].as_u64().unwrap() as usize;
        assert_eq!(lines[line - 1], format!("id = \"{id}\""));
    }
    assert!(all["targets"].as_array().unwrap().len() > 10);
    let relations = all["relations"].as_array().unwrap();
    assert!((1..=10).contains(&relations.len()), "{relations:?}");
    assert!(relations.iter().all(|own| own["words"] == "holds"), "{relations:?}");

    let (_, out, _) = check(folder.path(), "--format github");
    assert_eq!(out.lines().count(), 10, "{out}");
    // The worst come first.
    let rank =
        |line: &&str| ["::error", "::warning", "::notice"].iter().position(|k| line.starts_with(k));
    assert!(out.lines().is_sorted_by_key(|line| rank(&line).unwrap()), "{out}");
    assert!(out.starts_with(&format!("::warning file={TEMPLATES}/published.toml,line=")), "{out}");
}

/// A number of the paper that was other than it is: every form shows it, and the exit code is 1.
#[test]
fn what_does_not_hold_is_an_error_in_every_form() {
    let folder = tempfile::tempdir().unwrap();
    crate::templates(&folder.path().join("t"), "published.toml", |text| {
        let at = text.find("id = \"sec3_edges\"").unwrap();
        let own =
            text[at..].replacen("\"16\"", "\"17\"", 1).replacen("value = 16", "value = 17", 1);
        format!("{}{own}", &text[..at])
    });
    // The file is named from the folder of work, however it was given.
    let given = folder.path().canonicalize().unwrap().join("t");
    for (form, sign) in [
        ("text", "FAILS sec3_edges"),
        ("json", "\"fails\": true"),
        ("github", "::error file=t/published.toml,line="),
    ] {
        let check = "check --profile quick --results r --claim sec3_edges --templates";
        let (code, out, note) =
            run(folder.path(), &format!("{check} {} --format {form}", given.display()));
        assert!(
            code == 1 && note.contains("without an explanation that holds: sec3_edges"),
            "{note}"
        );
        assert!(out.contains(sign), "{sign}: {out}");
    }
}
