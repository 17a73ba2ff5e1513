//! `impact-paper trace`: its table, its methods, and what it says of ties.

use crate::{SCENARIO, answer, program, refused, run};
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
    let certified = trace(joint, " --certify");
    assert_eq!(certified.1, together.1);
    assert!(certified.2.contains("all at once") && certified.2.contains("can be trusted"));
    let (code, out, note) = trace(joint, " --method verlet");
    assert_eq!((code, out.as_str(), note.lines().count()), (2, "", 1), "{note}");
    assert!(note.contains("simultaneous") && note.contains("verlet"), "{note}");
    let help = answer(std::path::Path::new("."), "trace --help");
    assert!(help.contains(r#""simultaneous": "sequential""#) && help.contains(r#""joint" takes"#));
}

#[test]
fn derivatives_are_a_column_and_end_where_there_are_none() {
    let sensitivity = |scenario: &str, more: &str| {
        let folder = folder(scenario);
        run(folder.path(), &format!("trace s.json --until 10 --sensitivity sigma{more}"))
    };
    let plain = answer(folder(SCENARIO).path(), "trace s.json --until 10");
    let (code, own, note) = sensitivity(SCENARIO, "");
    assert!(code == 0 && note.is_empty() && own.lines().count() > 5, "{note}");
    assert!(own.starts_with("time,gap,closing_speed,dtime_dlnsigma\n"), "{own}");
    let without = own.lines().map(|line| format!("{}\n", line.rsplit_once(',').unwrap().0));
    assert_eq!(without.collect::<String>(), plain);
    let (code, out, note) = sensitivity(SCENARIO, " --method verlet");
    assert!((code, out.as_str()) == (2, "") && note.contains("--sensitivity"), "{note}");
    let tie = r#"{"forcing":[[0.9,0.8],[0,0],[-0.9,-0.8]]}"#;
    let (code, out, note) = sensitivity(tie, "");
    assert_eq!((code, out.lines().count(), note.lines().count()), (2, 2, 1), "{note}");
    assert!(note.contains("impact 2 at") && note.contains("--max-impacts 1"), "{note}");
    // What the message advises.
    assert_eq!(sensitivity(tie, " --max-impacts 1").0, 0);
    // It closes at 5e-8, where the derivative would be wrong by half of itself.
    let graze = r#"{"forcing_frequency":1.5,"initial":"zero","forcing":[[0,-1.2500000000000003]]}"#;
    let (code, _, note) = sensitivity(graze, "");
    assert!(code != 0 && note.contains("impact 1") && note.contains("grazes"), "{note}");
    assert!(!note.contains("--max-impacts") && note.contains("leave out --sensitivity"), "{note}");
}

#[test]
fn certificates_stand_on_stderr_and_the_output_is_the_same() {
    let folder = folder(SCENARIO);
    let trace = |more: &str| run(folder.path(), &format!("trace s.json --until 300{more}"));
    let (plain, (code, out, note)) = (trace(""), trace(" --certify"));
    assert_eq!((plain.0, plain.2.as_str(), code, &plain.1), (0, "", 0, &out));
    let words = format!(" of {} impacts can be trusted, before t = ", out.lines().count() - 1);
    assert!(note.contains(&words) && note.contains("errors grow as exp(0."), "{note}");
    assert_eq!(note.lines().count(), 1, "{note}");
    let (_, out, note) = trace(" --certify --max-impacts 5");
    let words = "5 impacts can be trusted, to the end";
    assert!(out.lines().count() == 6 && note.contains(words), "{out}{note}");
    let (_, _, note) = trace(" --certify --max-impacts 0");
    assert!(note.starts_with("impact-paper: there is no impact to trust; "), "{note}");
    for method in ["verlet", "sampled"] {
        let arguments = format!("trace s.json --until 300 --certify --method {method}");
        refused(folder.path(), &arguments, &["--certify", method]);
    }
}

#[test]
fn a_run_that_is_stopped_tells_its_rounding_and_has_no_certificate() {
    // A fast mass between walls has more impacts in 1/w than a run may have.
    let fast = r#"{"natural_frequency":0.001,"forcing_frequency":1000,"restitution":1,"forcing":[[0,1e6]]}"#;
    let folder = folder(fast);
    let trace = |more: &str| run(folder.path(), &format!("trace s.json --until 1e4{more}"));
    let (code, plain, note) = trace("");
    assert!(code == 4 && plain.lines().count() > 1000 && note.lines().count() == 2, "{note}");
    assert!(note.contains("may move each impact") && !note.contains("certificate"), "{note}");
    let (code, out, note) = trace(" --certify");
    assert!(code == 4 && out == plain && note.contains("no certificate"), "{note}");
}
