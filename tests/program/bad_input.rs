//! Gives the program what people get wrong: one line names the field and the remedy.

use crate::*;
use std::process::Stdio;

/// Holds the program to refuse a scenario with one line that has all of `words`.
fn refused(scenario: impl AsRef<[u8]>, words: &[&str]) {
    crate::refused(folder(scenario).path(), "trace s.json --until 5", words);
}

fn with(field: &str) -> String {
    format!(r#"{{"forcing":[[0.9,-0.4]],{field}}}"#)
}

/// The table has texts, or a field with values between bars, and words of what is said.
#[test]
fn text_that_is_no_scenario() {
    refused([0xff, 0xfe, 0x00, 0x9f], &[]);
    refused("[".repeat(100_000), &[]);
    for line in include_str!("no_scenarios.txt").lines() {
        let (scenario, words) = line.split_once(" =>").unwrap();
        let words: Vec<&str> = words.trim().split("; ").collect();
        if !scenario.starts_with('"') {
            refused(scenario, &words);
            continue;
        }
        let (field, values) = scenario.split_once(':').unwrap();
        for value in values.split('|') {
            refused(with(&format!("{field}:{value}")), &words);
        }
    }
}

/// Where rounding leaves nothing of the motion, a small difference of large parts, it is refused.
#[test]
fn nothing_is_left_near_resonance() {
    let near = with(r#""forcing_frequency":0.9999999999"#);
    refused(near, &["forcing: ", "rounding may move a gap by", "1e-6", "further from"]);
}

/// The table has what verbs refuse, for each value between bars, and words of what is said.
#[test]
fn options_out_of_range() {
    let folder = folder(SCENARIO);
    let here = folder.path();
    fs::write(here.join("ring.json"), with(r#""boundary":"ring""#)).unwrap();
    fs::write(here.join("file"), "").unwrap();
    fs::create_dir(here.join("empty")).unwrap();
    crate::refused(here, "trace --until 1 no\nsuch", &["no such: "]);
    for line in include_str!("refused.txt").lines() {
        let (arguments, words) = line.split_once(" => ").unwrap();
        let words: Vec<&str> = words.split("; ").collect();
        let group = arguments.split(' ').find(|word| word.contains('|')).unwrap_or(arguments);
        let option = group.find('=').filter(|_| group != arguments).map_or(0, |sign| sign + 1);
        for value in group[option..].split('|') {
            let value = format!("{}{value}", &group[..option]);
            crate::refused(here, &arguments.replace(group, &value), &words);
        }
    }
    assert!(!here.join("d").exists() && !here.join("SHA256SUMS").exists(), "nothing is made");
}

/// A full device is refused, and said so; a reader that goes away, as `head` does, is a quiet end.
#[cfg(target_os = "linux")]
#[test]
fn outputs_that_cannot_be_written() {
    let folder = folder(SCENARIO);
    for arguments in ["trace s.json --until 1e5", "eval p-crit"] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = program(folder.path(), arguments).stdout(full).output().unwrap();
        let (code, _, note) = crate::ended_with(&output);
        assert_eq!((code, note.lines().count()), (2, 1), "{note}");
        assert!(note.contains("standard output"), "{note}");
    }
    let mut command = program(folder.path(), "trace s.json --until 1e5");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let (code, _, note) = crate::ended_with(&child.wait_with_output().unwrap());
    assert!(note.is_empty() && code != -1, "{note}");
}

#[test]
fn files_without_end_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (path, verb) in [("s.json", "trace s.json --until 5"), ("values.json", "explain --paper .")]
    {
        fs::File::create(folder.join(path)).unwrap().set_len((64 << 20) + 1).unwrap();
        crate::refused(folder, verb, &[path, "64 MiB"]);
    }
}
