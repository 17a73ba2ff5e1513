//! `impact-paper explain` as a user meets it, on the report of the quick profile.

use crate::{PROGRAM, QUICK, outcome, put, refused};
use std::path::Path;
use std::process::Command;

fn run(arguments: &[&str]) -> (i32, String, String) {
    outcome(Command::new(PROGRAM).args(arguments))
}

fn explain(arguments: &[&str]) -> (i32, String, String) {
    let folder = tempfile::tempdir().unwrap();
    put(folder.path(), &QUICK.report);
    run(&[&["explain", "--paper", folder.path().to_str().unwrap()], arguments].concat())
}

/// What is asked for, and parts of what is told.
const CARDS: &str = "\
sweep.rise.half_height => standard error; experiments::rise::find (src/experiments/rise.rs:; seed: 2007
sweep.rise.half_height => chain masses: 100; sweep-rise.csv
second_seed.rise.half_height => seed: 7002
theory.jump.p_jump => reproduced
theory.jump.p_crit => 0.0122099; circuits::jump::p_crit (crates/circuits/src/jump.rs:; (18)
printed.sec2_half_height => that the paper prints; Sec. 2
fig:3 => fig03.svg; figures::fig03 (src/figures/fig03.rs:1); seed: 2007
fig:s11 => experiments::accuracy::race (src/experiments/accuracy/race.rs:
eq:18 => circuits::jump::p_crit (crates/circuits/src/jump.rs:; theory.jump.p_crit, theory.jump.p_crit_walls
claim:sec7_jump => verdict; tolerance; theory.jump.p_jump
eq:12 => f_(N,p)(k)";

#[test]
fn values_figures_equations_and_claims_are_explained() {
    for line in CARDS.lines() {
        let (id, parts) = line.split_once(" => ").unwrap();
        let (code, told, note) = explain(&[id]);
        assert_eq!((code, note.as_str()), (0, ""), "{id}");
        assert!(!told.contains("\\mathrm") && !told.contains("\\Phi"), "{told}");
        for part in parts.split("; ") {
            assert!(told.contains(part), "{id}: {part:?} is not in\n{told}");
        }
    }
}

/// The line is that of the working copy, where the item is declared.
#[test]
fn the_line_is_that_of_the_item() {
    let (_, told, _) = explain(&["theory.jump.p_jump"]);
    let line =
        told.split("crates/circuits/src/jump.rs:").nth(1).unwrap().split(')').next().unwrap();
    let text = std::fs::read_to_string("crates/circuits/src/jump.rs").unwrap();
    let line = text.lines().nth(line.parse::<usize>().unwrap() - 1).unwrap();
    assert!(line.contains("fn p_jump"), "{line}");
}

#[test]
fn all_are_listed_and_as_json() {
    let (code, told, _) = explain(&[]);
    assert_eq!(code, 0);
    for id in ["sweep.rise.half_height ", "fig:15 ", "fig:s1 ", "eq:38 ", "claim:sec2_onset "] {
        assert!(told.lines().any(|line| line.starts_with(id)), "{id}");
    }
    let (_, told, _) = explain(&["--json", "sweep.rise.half_height", "eq:18"]);
    let cards: serde_json::Value = serde_json::from_str(&told).unwrap();
    assert_eq!(cards[0]["id"], "sweep.rise.half_height");
    let rows = cards[0]["rows"].as_array().unwrap();
    let computed = rows.iter().find(|row| row["name"] == "computed by").unwrap();
    assert_eq!(computed["file"], "src/experiments/rise.rs");
    assert!(computed["line"].as_u64().unwrap() > 1);
}

#[test]
fn an_unknown_id_is_one_line_with_the_nearest() {
    for (id, near) in [
        ("sweep.rise.half_hight", "sweep.rise.half_height"),
        ("eq:99", "eq:9"),
        ("sec7_jmp", "sec7_jump"),
    ] {
        let (code, told, note) = explain(&[id]);
        assert_eq!((code, told.as_str()), (2, ""), "{note}");
        assert!(note.contains(near) && note.trim_end().lines().count() == 1, "{note}");
    }
    let long = "a".repeat(20_000);
    for id in ["", "nope", long.as_str()] {
        let (code, _, note) = explain(&[id]);
        assert!(code == 2 && !note.contains("nearest") && note.len() < 200, "{note}");
        assert!(note.contains("without an id all are listed"), "{note}");
    }
    let (code, _, note) = run(&["explain", "--paper", "no-such-folder", "x"]);
    assert_eq!(code, 2);
    assert!(note.contains("--paper") && note.trim_end().lines().count() == 1, "{note}");
    assert!(!Path::new("no-such-folder").exists());
}

/// An origin names the function that computed the number: no constant, structure or module.
#[test]
fn every_origin_is_a_function() {
    let values: serde_json::Value = serde_json::from_slice(&QUICK.report["values.json"]).unwrap();
    let values = values.as_object().unwrap();
    let ids: Vec<&str> = values
        .iter()
        .filter(|(_, value)| value["source"].is_string())
        .map(|(id, _)| &**id)
        .collect();
    assert!(ids.len() > 900, "{}", ids.len());
    let (code, cards, note) = explain(&[&["--json"], ids.as_slice()].concat());
    assert_eq!((code, note.as_str()), (0, ""));
    let cards: serde_json::Value = serde_json::from_str(&cards).unwrap();
    for card in cards.as_array().unwrap() {
        let row = |name: &str| card["rows"].as_array().unwrap().iter().find(|r| r["name"] == name);
        let by = row("computed by").unwrap_or_else(|| panic!("{card}"));
        let source = std::fs::read_to_string(by["file"].as_str().unwrap()).unwrap();
        let line = by["line"].as_u64().unwrap() as usize - 1;
        let line = source.lines().nth(line).unwrap();
        assert!(line.contains("fn "), "{}: {line}", card["id"]);
    }
    let means = |id: &&String| id.starts_with("sweep.rows") && id.ends_with(".mean");
    let means: Vec<&String> = values.keys().filter(means).collect();
    assert!(means.len() > 1, "{means:?}");
    for mean in means {
        assert_eq!(values[mean]["source"], "experiments::sweep::reduce");
    }
}

/// Whoever opens a pipe waits for its other end, and a link may lead anywhere.
#[cfg(unix)]
#[test]
fn nothing_but_files_of_the_folder_is_read() {
    for name in ["values.json", "ledger.json"] {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        put(&here.join("r"), &QUICK.report);
        std::fs::rename(here.join("r").join(name), here.join("away")).unwrap();
        std::os::unix::fs::symlink("../away", here.join("r").join(name)).unwrap();
        refused(here, "explain --paper r fig:3", &[name, "it is a link"]);
        std::fs::remove_file(here.join("r").join(name)).unwrap();
        assert!(Command::new("mkfifo").arg(here.join("r").join(name)).status().unwrap().success());
        refused(here, "explain --paper r fig:3", &[name, "it is no regular file"]);
    }
}
