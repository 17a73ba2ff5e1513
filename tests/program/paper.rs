//! `impact-paper paper` and `check` as a user meets them: what runs, what is written, what is not.

use crate::{EXPERIMENTS, QUICK, TEMPLATES, answer, ended, files, program, tree};
use std::path::Path;
use std::process::Stdio;

/// The program in a folder of its own, with the templates of the project.
pub fn run(folder: &Path, arguments: &str) -> (i32, String, String) {
    crate::run(folder, &format!("{arguments} --templates {TEMPLATES}"))
}

/// Refuses the same.
pub fn refused(folder: &Path, arguments: &str, words: &[&str]) {
    crate::refused(folder, &format!("{arguments} --templates {TEMPLATES}"), words);
}

#[test]
fn a_figure_runs_no_more_than_it_needs() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    for number in [4, 11] {
        let (code, told, note) = run(here, &format!("paper --figure {number} --out f"));
        assert_eq!((code, note.as_str()), (0, ""), "{told}");
        assert!(told.starts_with("f: ") && told.contains(" in "), "{told}");
        assert!(!told.contains("1 files") && !told.contains(" 0.0 s"), "{told}");
        assert!(here.join(format!("f/figures/fig{number:02}.svg")).is_file());
    }
    assert!(!here.join("target").exists(), "nothing was run and saved");
}

#[test]
fn only_the_figure_that_was_asked_for_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (code, ..) = run(folder.path(), "paper --profile quick --figure 3 --out f --results r");
    assert_eq!(code, 0);
    let written = tree(&folder.path().join("f"));
    assert!(written.contains_key("figures/fig03.svg"), "{:?}", written.keys());
    let expected = |name: &String| name.contains("fig03") || name == "SHA256SUMS";
    assert!(written.keys().all(expected), "{:?}", written.keys());
    let saved: Vec<String> = tree(&folder.path().join("r")).into_keys().collect();
    assert!(saved.len() == 1 && saved[0].starts_with("sweep-"), "{saved:?}");
}

#[test]
fn threads_and_saved_results_change_no_byte_and_lesser_profiles_replace_no_full_report() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let paper = "paper --profile quick --out one --results r1";
    let (code, _, note) = run(folder.path(), &format!("{paper} --threads 1"));
    assert_eq!(code, 0, "{note}");
    let (report, saved) = (tree(&at("one")), files(&at("r1")));
    assert!(report.contains_key("report.md") && report.len() > 40, "{:?}", report.keys());
    assert_eq!(saved.len(), EXPERIMENTS);
    assert!(report == QUICK.report && saved == QUICK.results, "1 and 4 threads differ");

    // Again: nothing is run, nothing changes, not even the saved files' times.
    let times = |name: &str| -> Vec<_> {
        let files = std::fs::read_dir(at(name)).unwrap().map(|file| file.unwrap().path());
        let mut times: Vec<_> =
            files.map(|f| (f.clone(), f.metadata().unwrap().modified().unwrap())).collect();
        times.sort();
        times
    };
    let before = times("r1");
    let (code, told, _) = run(folder.path(), paper);
    assert_eq!((code, times("r1")), (0, before));
    assert!(told.contains("report.html") && told.contains(" statements of the paper: "), "{told}");
    assert!(report == tree(&at("one")));

    // A file that was lost comes back.
    std::fs::remove_file(at("one/ledger.json")).unwrap();
    assert_eq!(run(folder.path(), paper).0, 0);
    assert!(report == tree(&at("one")));

    // What was edited is refused at once by its name.
    let ledger = String::from_utf8(report["ledger.json"].clone()).unwrap();
    let edited = ledger.replace("\"verdict\": \"reproduced\"", "\"verdict\": \"differs\"");
    std::fs::write(at("one/ledger.json"), &edited).unwrap();
    refused(folder.path(), paper, &["ledger.json", "--force"]);
    assert_eq!(std::fs::read_to_string(at("one/ledger.json")).unwrap(), edited);
    let (code, _, note) = run(folder.path(), &format!("{paper} --force"));
    assert_eq!(code, 0, "{note}");
    assert!(note.contains("--force: wrote over ledger.json"), "{note}");
    assert!(report == tree(&at("one")));

    // check takes the same saved results.
    let (code, told, note) = run(folder.path(), "check --profile quick --results r1");
    assert_eq!(code, i32::from(told.contains("FAILS")), "{note}");
    assert!(told.contains(" statements of the paper: "), "{told}");
    assert!(saved == files(&at("r1")));

    // What would spoil a report is refused before anything is run: over one of the full profile a lesser one, and a figure
    // of it too.
    let values = String::from_utf8(report["values.json"].clone()).unwrap();
    let full = values.replace("\"text\": \"quick\"", "\"text\": \"full\"");
    assert_ne!(full, values);
    std::fs::write(at("one/values.json"), full).unwrap();
    let before = tree(&at("one"));
    for arguments in ["--profile quick --force", "--profile quick --figure 4 --force"] {
        refused(folder.path(), &format!("paper {arguments} --out one"), &["full profile"]);
    }
    assert!(before == tree(&at("one")));
}

#[test]
fn ctrl_c_leaves_nothing_half_written() {
    let folder = tempfile::tempdir().unwrap();
    let paper = "paper --figure 3 --out paper --results r --threads 2 --templates";
    let mut command = program(folder.path(), &format!("{paper} {TEMPLATES}"));
    ended(command.stderr(Stdio::null()), "-TERM");
    assert!(!folder.path().join("paper").exists());
    let saved = tree(&folder.path().join("r"));
    assert!(saved.keys().all(|name| name.starts_with("sweep-full-")), "whole units are kept");
}

/// What is no module of WebAssembly is none of the pages'.
#[test]
fn a_module_is_looked_at() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("r"), &QUICK.results);
    std::fs::create_dir(here.join("target")).unwrap();
    for (bytes, taken) in [("garbage", false), ("\0asm", true)] {
        std::fs::write(here.join("target/page.wasm"), bytes).unwrap();
        let (code, _, note) = run(here, "paper --profile quick --out p --results r");
        let said = note.contains("target/page.wasm is not there or no module");
        assert_eq!((code, said, here.join("p/lab.js").exists()), (0, !taken, taken), "{note}");
    }
}

/// --quiet hides progress and no error.
#[test]
fn quiet_work_says_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let sweep = "sweep --sigma 0.1 --masses 4 --realisations 2";
    let (code, quiet, note) = crate::run(here, &format!("-q {sweep}"));
    assert_eq!((code, note.as_str()), (0, ""));
    assert_eq!(quiet, answer(here, sweep));
    let (code, _, note) = run(here, "paper --profile quick --figure 3 --out f --results r --quiet");
    assert_eq!((code, note.as_str()), (0, ""));
    crate::refused(here, "sweep --sigma nan --quiet", &["sigma"]);
}
