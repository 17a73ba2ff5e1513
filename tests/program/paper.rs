//! Runs `impact-paper paper` and `verify`: what runs, what is written, what is left.

use crate::{
    EXPERIMENTS, QUICK, SCENARIO, TEMPLATES, answer, ended_with, files, program, put, sha256, tree,
};
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// The program in a new folder, with the templates of the project.
fn run(folder: &Path, arguments: &str) -> (i32, String, String) {
    crate::run(folder, &format!("{arguments} --templates {TEMPLATES}"))
}

fn refused(folder: &Path, arguments: &str, words: &[&str]) {
    crate::refused(folder, &format!("{arguments} --templates {TEMPLATES}"), words);
}

#[test]
fn a_figure_alone_runs_and_writes_no_more_than_it_needs() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let (code, out, note) = run(here, "paper --figure 4 --out f --results none");
    assert_eq!((code, note.as_str()), (0, ""), "{out}");
    assert!(out.starts_with("f: 1 file in "), "{out}");
    assert!(here.join("f/figures/fig04.svg").is_file() && !here.join("none").exists());
    let paper = "paper --profile quick --figure 3 --out g --results r";
    assert_eq!(run(here, paper).0, 0);
    let written = tree(&here.join("g"));
    assert!(written.contains_key("figures/fig03.svg"), "{:?}", written.keys());
    assert!(written.keys().all(|name| name.contains("fig03") || name == "SHA256SUMS"));
    let saved = files(&here.join("r"));
    assert_eq!(
        saved.into_iter().collect::<Vec<_>>(),
        [("sweep-quick.json".to_string(), QUICK.results["sweep-quick.json"].clone())]
    );
}

#[test]
fn saved_results_change_no_byte_and_neither_edits_nor_full_reports_are_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    put(&path("r1"), &QUICK.results);
    put(&path("one"), &QUICK.report);
    fs::remove_file(path("one/values.json")).unwrap();
    let paper = "paper --profile quick --out one --results r1";
    // Nothing is run, nothing changes, not even the saved files' times.
    let times = || -> Vec<_> {
        let files = QUICK.results.keys().map(|name| path("r1").join(name));
        files.map(|file| file.metadata().unwrap().modified().unwrap()).collect()
    };
    let before = times();
    let (code, out, note) = run(folder.path(), paper);
    assert_eq!((code, times()), (0, before), "{note}");
    assert!(out.contains("report.html") && out.contains(" statements of the paper: "), "{out}");
    assert_eq!(note.matches(": fresh").count(), EXPERIMENTS, "{note}");
    assert!(QUICK.report == tree(&path("one")));

    // A file that was lost has come back, one that was edited is refused by its name.
    fs::write(path("one/ledger.json"), "{}").unwrap();
    refused(folder.path(), paper, &["ledger.json", "--force"]);
    assert_eq!(fs::read(path("one/ledger.json")).unwrap(), b"{}");

    // What would spoil a report of the full profile is refused before anything is run.
    let values = fs::read_to_string(path("one/values.json")).unwrap();
    let full = values.replace("\"text\": \"quick\"", "\"text\": \"full\"");
    assert_ne!(full, values);
    fs::write(path("one/values.json"), full).unwrap();
    let before = tree(&path("one"));
    for arguments in ["--profile quick --force", "--profile quick --figure 4 --force"] {
        refused(folder.path(), &format!("paper {arguments} --out one"), &["full profile"]);
    }
    assert!(before == tree(&path("one")));
}

/// Sends a signal to a program at work, and holds it to exit code 130: its stdout, stderr.
fn ended(mut child: Child, signal: &str) -> [String; 2] {
    let early = child.try_wait().unwrap();
    let kill = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(early.is_none() && kill.success(), "it must still be running: {early:?}");
    let (code, out, note) = ended_with(&child.wait_with_output().unwrap());
    assert_eq!(code, 130, "{out}{note}");
    [out, note]
}

/// The first line on the standard error of a program that is at work.
fn first_line(child: &mut Child) -> String {
    let mut line = String::new();
    BufReader::new(child.stderr.as_mut().unwrap()).read_line(&mut line).unwrap();
    line
}

/// Runs of minutes, which say first how long they take, and one that waits for its reader and says
/// after some seconds that it is still there.
#[cfg(unix)]
#[test]
fn signals_end_the_work_and_leave_nothing_half_written() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.json"), SCENARIO).unwrap();
    let paper = "paper --figure 3 --out paper --results r --threads 1 --templates";
    let mut command = program(folder.path(), &format!("{paper} {TEMPLATES}"));
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let line = first_line(&mut child);
    assert!(line.starts_with("1 experiment to run, about "), "{line}");
    assert!(line.contains(" on 1 thread; `--profile quick` takes seconds"), "{line}");
    std::thread::sleep(std::time::Duration::from_millis(300));
    let [out, note] = ended(child, "-TERM");
    assert!(out.is_empty() && note.contains("interrupted"), "{out}{note}");
    assert!(!folder.path().join("paper").exists());
    let saved = tree(&folder.path().join("r"));
    assert!(saved.keys().all(|name| name.starts_with("sweep-full-")), "whole units are kept");

    let mut command = program(folder.path(), &format!("check --results c --templates {TEMPLATES}"));
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let line = first_line(&mut child);
    assert!(line.starts_with(&format!("{EXPERIMENTS} experiments to run, about ")), "{line}");
    assert!(line.contains("`--profile quick` takes seconds"), "{line}");
    ended(child, "-TERM");

    let mut command = program(folder.path(), "trace s.json --until 1e12");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let line = first_line(&mut child);
    assert!(line.starts_with("trace: at t = ") && line.contains(", after 5 s"), "{line}");
    let [out, _] = ended(child, "-TERM");
    assert!(out.ends_with('\n'), "whole lines");
}

/// Whatever writes, writes over nothing that it did not make itself.
#[test]
fn what_others_made_is_left_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::create_dir_all(here.join("t/figures")).unwrap();
    for name in ["README.md", "t/report.md", "t/figures/fig04.svg"] {
        fs::write(here.join(name), "by hand").unwrap();
    }
    let before = tree(here);
    for (arguments, says) in [
        ("paper --profile quick --out .", "--out: .: it has files and no SHA256SUMS"),
        ("paper --figure 4 --out t", "--out: t: it has files and no SHA256SUMS"),
    ] {
        refused(here, arguments, &[says, "--force"]);
    }
    assert!(tree(here) == before, "{:?}", tree(here).keys());
    // Forced, it writes, and its folder is written again without.
    assert_eq!(run(here, "paper --figure 4 --out t --force").0, 0);
    assert_eq!(run(here, "paper --figure 4 --figure 5 --out t").0, 0);
    assert_eq!(fs::read_to_string(here.join("t/report.md")).unwrap(), "by hand");
}

#[test]
fn a_rerun_finds_what_the_list_cannot() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let templates = format!("--templates {TEMPLATES}");
    put(&here.join("r"), &QUICK.report);
    put(&here.join("saved"), &QUICK.results);

    // A forger who keeps the list right.
    let edit = |name: &str, change: &dyn Fn(String) -> String| {
        let path = here.join("r").join(name);
        fs::write(&path, change(fs::read_to_string(&path).unwrap())).unwrap();
    };
    let before = fs::read_to_string(here.join("r/data/fig02a.csv")).unwrap();
    edit("data/fig02a.csv", &|text| format!("{text}9\n"));
    edit("report.html", &|text| format!("{text} "));
    fs::write(here.join("r/data/more.csv"), "").unwrap();
    let (old, new) = (sha256(&before), sha256(format!("{before}9\n")));
    let more = format!("{}  data/more.csv\n", sha256(""));
    edit("SHA256SUMS", &|list| list.replace(&old, &new) + &more);
    let (code, out, _) = crate::run(here, "verify r");
    assert_eq!((code, &*out), (1, "differs  report.html\n"));
    let page = fs::read_to_string(here.join("r/report.html")).unwrap();
    let [old, new] = [&page[..page.len() - 1], &page].map(sha256);
    edit("SHA256SUMS.built", &|list| list.replace(&old, &new));
    assert!(answer(here, "verify r").contains(" files, all as SHA256SUMS lists them\n"));
    let (code, out, note) =
        crate::run(here, &format!("verify r --rerun --results saved {templates}"));
    assert_eq!(code, 1, "{out}{note}");
    assert!(note.contains("5 files; with the same options `paper --force` writes"), "{note}");
    let lines: Vec<&str> = out.lines().skip(1).collect();
    let names = [
        "differs  SHA256SUMS",
        "differs  SHA256SUMS.built",
        "differs  data/fig02a.csv",
        "differs  report.html",
        "unlisted data/more.csv",
    ];
    assert_eq!(lines, names.map(|name| format!("rerun: {name}")));

    // What is lost or new is named without a rerun.
    fs::remove_file(here.join("r/data/fig02a.csv")).unwrap();
    fs::write(here.join("r/data/strange.csv"), "").unwrap();
    let (code, out, _) = crate::run(here, "verify r");
    assert_eq!((code, &*out), (1, "missing  data/fig02a.csv\nunlisted data/strange.csv\n"));
}
