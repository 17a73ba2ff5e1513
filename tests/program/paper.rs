//! Runs `impact-paper paper` and `verify`: what runs, what is written, what is left.

use crate::*;
use std::io::{BufRead, BufReader};
use std::process::{Child, Stdio};

#[test]
fn a_figure_alone_runs_and_writes_no_more_than_it_needs() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let paper = "paper --figure 4 --out f --results none --templates @";
    let [out, note] = ends(here, paper, 0, &[]);
    assert!(note.is_empty() && out.starts_with("f: 1 file in "), "{out}{note}");
    assert!(here.join("f/figures/fig04.svg").is_file() && !here.join("none").exists());
    let paper = "paper --profile quick --figure 3 --out g --results r --templates @";
    ends(here, paper, 0, &[]);
    let written = tree(&here.join("g"));
    assert!(written.contains_key("figures/fig03.svg"), "{:?}", written.keys());
    assert!(written.keys().all(|name| name.contains("fig03") || name == "SHA256SUMS"));
    let name = "sweep-quick.json".to_string();
    assert_eq!(files(&here.join("r")), [(name.clone(), QUICK.results[&name].clone())].into());
}

#[test]
fn saved_results_change_no_byte_and_neither_edits_nor_full_reports_are_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    put(&path("r1"), &QUICK.results);
    put(&path("one"), &QUICK.report);
    fs::remove_file(path("one/values.json")).unwrap();
    let paper = "paper --profile quick --out one --results r1 --templates @";
    // Nothing is run, nothing changes, not even the saved files' times.
    let times = || -> Vec<_> {
        let files = QUICK.results.keys().map(|name| path("r1").join(name));
        files.map(|file| file.metadata().unwrap().modified().unwrap()).collect()
    };
    let before = times();
    let [out, note] = ends(folder.path(), paper, 0, &[]);
    assert_eq!(times(), before, "{note}");
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
        let paper = format!("paper {arguments} --out one --templates @");
        refused(folder.path(), &paper, &["full profile"]);
    }
    assert!(before == tree(&path("one")));
}

/// A program at work, and the first line on its standard error.
fn started(folder: &Path, arguments: &str) -> (Child, String) {
    let mut command = program(folder, arguments);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(child.stderr.as_mut().unwrap()).read_line(&mut line).unwrap();
    (child, line)
}

/// Ends a program at work by a signal, and holds it to exit code 130: its stdout, stderr.
fn ended(mut child: Child) -> [String; 2] {
    let early = child.try_wait().unwrap();
    let kill = Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
    assert!(early.is_none() && kill.success(), "it must still be running: {early:?}");
    let (code, out, note) = ended_with(&child.wait_with_output().unwrap());
    assert_eq!(code, 130, "{out}{note}");
    [out, note]
}

/// Runs of minutes say first how long they take; one that waits says after 5 s that it runs.
#[cfg(unix)]
#[test]
fn signals_end_the_work_and_leave_nothing_half_written() {
    let folder = crate::folder(SCENARIO);
    let paper = "paper --figure 3 --out paper --results r --threads 1 --templates @";
    let (child, line) = started(folder.path(), paper);
    assert!(line.starts_with("1 experiment to run, about "), "{line}");
    assert!(line.contains(" on 1 thread; `--profile quick` takes seconds"), "{line}");
    std::thread::sleep(std::time::Duration::from_millis(300));
    let [out, note] = ended(child);
    assert!(out.is_empty() && note.contains("interrupted"), "{out}{note}");
    assert!(!folder.path().join("paper").exists());
    let saved = tree(&folder.path().join("r"));
    assert!(saved.keys().all(|name| name.starts_with("sweep-full-")), "whole units are kept");

    let (child, line) = started(folder.path(), "check --results c --templates @");
    assert!(line.starts_with(&format!("{EXPERIMENTS} experiments to run, about ")), "{line}");
    assert!(line.contains("`--profile quick` takes seconds"), "{line}");
    ended(child);

    let (child, line) = started(folder.path(), "trace s.json --until 1e12");
    assert!(line.starts_with("trace: at t = ") && line.contains(", after 5 s"), "{line}");
    let [out, _] = ended(child);
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
    for (out, arguments) in [(".", "--profile quick"), ("t", "--figure 4")] {
        let says = format!("--out: {out}: it has files and no SHA256SUMS");
        refused(here, &format!("paper {arguments} --out {out} --templates @"), &[&says, "--force"]);
    }
    assert!(tree(here) == before, "{:?}", tree(here).keys());
    // Forced, it writes, and its folder is written again without.
    ends(here, "paper --figure 4 --out t --force --templates @", 0, &[]);
    ends(here, "paper --figure 4 --figure 5 --out t --templates @", 0, &[]);
    assert_eq!(fs::read_to_string(here.join("t/report.md")).unwrap(), "by hand");
}

#[test]
fn a_rerun_finds_what_the_list_cannot() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
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
    assert_eq!(ends(here, "verify r", 1, &[])[0], "differs  report.html\n");
    let page = fs::read_to_string(here.join("r/report.html")).unwrap();
    let [old, new] = [&page[..page.len() - 1], &page].map(sha256);
    edit("SHA256SUMS.built", &|list| list.replace(&old, &new));
    assert!(answer(here, "verify r").contains(" files, all as SHA256SUMS lists them\n"));
    let says = "5 files; with the same options `paper --force` writes";
    let [out, _] = ends(here, "verify r --rerun --results saved --templates @", 1, &[says]);
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
    let [out, _] = ends(here, "verify r", 1, &[]);
    assert_eq!(out, "missing  data/fig02a.csv\nunlisted data/strange.csv\n");
}
