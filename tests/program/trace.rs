//! `impact-paper trace`: its table, its methods, and what it says of ties.

use crate::{SCENARIO, answer, program, run};
use impact_paper::params::MethodName;
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
    for method in MethodName::ALL.map(MethodName::id) {
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
    let folder = folder(r#"{"forcing":[[0.9,0.8],[0,0],[-0.9,-0.8]]}"#);
    let (code, _, note) = run(folder.path(), "trace s.json --until 12");
    assert!(code == 0 && note.contains("lowest gap first") && note.lines().count() == 1, "{note}");
}

#[test]
fn the_truth_shows_from_where_on_a_run_is_off_and_refuses_what_it_does_not_know() {
    let chain = r#"{"forcing":[[1.9,-0.5],[0.3,0.1],[0.7,-1.1],[-0.3,-0.6],[-0.9,-0.7],[-0.4,-0.2],[-0.7,0.3],[-0.4,-2.6]]}"#;
    let folder = folder(chain);
    let times = |method: &str| -> Vec<[f64; 2]> {
        let text = answer(folder.path(), &format!("trace s.json --until 200 --method {method}"));
        let cells = |line: &str| -> Vec<f64> {
            line.split(',').map(|cell| cell.parse().unwrap()).collect()
        };
        text.lines().skip(1).map(cells).map(|cells| [cells[0], cells[1]]).collect()
    };
    let (truth, own) = (times("truth"), times("certified"));
    for (a, b) in truth.iter().zip(&own).take(20) {
        assert!(a[1] == b[1] && (a[0] - b[0]).abs() < 1e-12, "{a:?} {b:?}");
    }
    let apart = |(a, b): (&[f64; 2], &[f64; 2])| a[1] != b[1] || (a[0] - b[0]).abs() > 1e-3;
    assert!(truth.iter().zip(&own).any(apart), "{} impacts", truth.len());
    for (scenario, words) in [
        (r#"{"boundary":"ring","forcing":[[1,0],[0,0]]}"#, "walls only"),
        (r#"{"restitution":0.2,"forcing":[[5.88,-4.94]]}"#, "no contact"),
    ] {
        std::fs::write(folder.path().join("s.json"), scenario).unwrap();
        let (code, _, note) = run(folder.path(), "trace s.json --until 100 --method truth");
        assert_eq!((code, note.lines().count()), (2, 1), "{note}");
        assert!(note.contains(words) && note.contains("another method"), "{note}");
    }
}

#[test]
fn a_run_that_is_stopped_tells_its_rounding() {
    // A fast mass between walls has more impacts in 1/w than a run may have.
    let fast = r#"{"natural_frequency":0.001,"forcing_frequency":1000,"restitution":1,"forcing":[[0,1e6]]}"#;
    let folder = folder(fast);
    let (code, out, note) = run(folder.path(), "trace s.json --until 1e4");
    assert!(code == 1 && out.lines().count() > 1000 && note.lines().count() == 2, "{note}");
    assert!(note.contains("may move each impact"), "{note}");
}

/// Bodies that come to rest on one another do so by very many weak impacts: a line says why the table is long.
#[test]
fn a_chatter_that_makes_most_of_the_rows_is_named() {
    let chain = r#"{"restitution":0,"forcing":[[1.9,-0.5],[0.3,0.1],[0.7,-1.1],[-0.3,-0.6],[-0.9,-0.7],[-0.4,-0.2],[-0.7,0.3],[-0.4,-2.6]]}"#;
    let folder = folder(chain);
    let (code, out, note) = run(folder.path(), "trace s.json --until 4000");
    let slow = |line: &&str| line.split(',').next_back().unwrap().parse::<f64>().unwrap() < 1e-6;
    let found = out.lines().skip(1).filter(slow).count();
    assert!(
        code == 0 && note.contains(&format!("{found} of {} impacts", out.lines().count() - 1)),
        "{note}"
    );
    assert!(!run(folder.path(), "trace s.json --until 4").2.contains("chatter"));
}
