//! `impact-paper trace`: its table, its methods, and what it says of ties.

use crate::{SCENARIO, answer, program, run};
use std::io::Write;
use std::process::Stdio;

/// A folder with a scenario.
fn folder(scenario: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.json"), scenario).unwrap();
    folder
}

#[test]
fn impacts_are_listed_in_order_from_a_file_or_a_pipe() {
    let folder = folder(SCENARIO);
    let text = answer(folder.path(), "trace s.json --until 30");
    assert!(text.starts_with("time,gap,closing_speed\n") && text.lines().count() > 5, "{text}");
    let mut command = program(folder.path(), "trace - --until 30");
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(SCENARIO.as_bytes()).unwrap();
    assert_eq!(child.wait_with_output().unwrap().stdout, text.as_bytes());
    let mut last = 0.0;
    for line in text.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert!(cells[0] >= last && cells[1] <= 3.0 && cells[2] >= 0.0, "{line}");
        last = cells[0];
    }
}

#[test]
fn the_method_that_is_named_is_run() {
    let folder = folder(SCENARIO);
    let by = |method: &str| answer(folder.path(), &format!("trace s.json --until 10{method}"));
    let plain = by("");
    for method in
        ["certified", "sampled", "newton", "runge-kutta", "moreau-jean", "verlet", "penalty"]
    {
        let out = by(&format!(" --method {method}"));
        assert!(out.lines().count() > 5, "{out}");
        assert_eq!(out == plain, method == "certified", "{method}");
    }
    for (method, option) in [("verlet", "--step 0.01"), ("runge-kutta", "--tolerance 1e-4")] {
        let method = format!(" --method {method}");
        assert_ne!(by(&method), by(&format!("{method} {option}")));
    }
}

#[test]
fn what_was_done_with_ties_is_said() {
    let trace = |law: &str, more: &str| {
        let folder = folder(&format!(r#"{{"forcing":[[0.9,0.8],[0,0],[-0.9,-0.8]]{law}}}"#));
        run(folder.path(), &format!("trace s.json --until 12{more}"))
    };
    let joint = r#","simultaneous":"joint""#;
    let (plain, together) = (trace("", ""), trace(joint, ""));
    assert_eq!(plain, trace(r#","simultaneous":"sequential""#, ""));
    for (run, words) in [(&plain, "lowest gap first"), (&together, "all at once")] {
        assert!(run.0 == 0 && run.2.contains(words) && run.2.lines().count() == 1, "{run:?}");
    }
    assert_ne!(plain.1, together.1);
    let (code, out, note) = trace(joint, " --method verlet");
    assert_eq!((code, out.as_str(), note.lines().count()), (2, "", 1), "{note}");
    assert!(note.contains("simultaneous") && note.contains("verlet"), "{note}");
    let help = answer(std::path::Path::new("."), "trace --help");
    assert!(help.contains(r#""simultaneous": "sequential""#) && help.contains(r#""joint" takes"#));
}

#[test]
fn a_run_that_is_stopped_tells_its_rounding() {
    // A fast mass between walls has more impacts in 1/w than a run may have.
    let fast = r#"{"natural_frequency":0.001,"forcing_frequency":1000,"restitution":1,"forcing":[[0,1e6]]}"#;
    let folder = folder(fast);
    let (code, out, note) = run(folder.path(), "trace s.json --until 1e4");
    assert!(code == 4 && out.lines().count() > 1000 && note.lines().count() == 2, "{note}");
    assert!(note.contains("may move each impact"), "{note}");
}
