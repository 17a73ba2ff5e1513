//! Runs the verbs that this paper adds to the program: `eval`, `sweep` and `trace`.

use crate::*;
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::{counting, jump};
use impact_paper::params::{Chain, MethodName};
use serde_json::{Value, json};
use std::io::Write;
use std::process::Stdio;

fn eval(arguments: &str) -> String {
    answer(Path::new("."), &format!("eval {arguments}"))
}

fn object(arguments: &str) -> Value {
    let json = eval(arguments);
    assert!(json.ends_with('\n') && json.lines().count() == 1);
    serde_json::from_str(&json).unwrap()
}

#[test]
fn every_quantity_prints_what_the_library_computes() {
    let [spacing, natural_frequency, forcing_frequency] = [1.5, 1.1, 0.6];
    let chain = Chain { spacing, natural_frequency, forcing_frequency, ..Chain::default() };
    let relation = ImpactProbability::new(0.2, &chain).unwrap();
    let given = "--sigma 0.2 --spacing 1.5 --omega 1.1 --forcing-frequency 0.6";
    let mut expected = vec![
        ("p-crit --vertices 41".to_string(), json!(jump::p_crit(41).unwrap())),
        ("log-circuits --vertices 41 --k 7".into(), json!(counting::log_phi(41, 7).unwrap())),
        (format!("p-of-sigma {given}"), json!(relation.p().unwrap())),
        (format!("log-p-of-sigma {given}"), json!(relation.log_p().unwrap())),
    ];
    for (prefix, space) in [("", SampleSpace::Simple), ("higher-", SampleSpace::FiveClasses)] {
        let (law, leap) = (Law::new(space, 41, 0.07).unwrap(), jump::p_jump(space, 41).unwrap());
        expected.extend([
            (format!("{prefix}p-jump --vertices 41"), json!(leap.p)),
            (format!("{prefix}k-after-jump --vertices 41"), json!(leap.k_after)),
            (format!("{prefix}k-star --vertices 41 --p 0.07"), json!(law.k_star())),
            (format!("{prefix}mean-impacts --vertices 41 --p 0.07"), json!(law.mean())),
        ]);
        let probability = format!("{prefix}probability --vertices 41 --p 0.07 --k 7");
        expected.push((probability, json!(law.probability(7).unwrap())));
    }
    for (arguments, expected) in expected {
        assert_eq!(object(&arguments)["value"], expected, "{arguments}");
    }
}

#[test]
fn the_answer_is_one_object_with_the_inputs_and_their_defaults() {
    let mean = Law::new(SampleSpace::Simple, 41, 1.0).unwrap().mean();
    let expected = format!(
        "{{\"quantity\":\"mean-impacts\",\"value\":{mean:?},\
         \"inputs\":{{\"masses\":40,\"vertices\":41,\"p\":1.0}}}}\n"
    );
    assert_eq!(eval("mean-impacts --masses 40 --p 1"), expected);
    let root = std::f64::consts::SQRT_2;
    let expected = json!({"sigma": 0.15, "omega": 1.0, "forcing_frequency": root, "spacing": 1.0});
    assert_eq!(object("p-of-sigma --sigma 0.15")["inputs"], expected);
    assert_eq!(object("p-crit")["inputs"], json!({"vertices": 100}));
    ends(Path::new("."), "eval p-crit --vertices 2", 0, &["no probability"]);
    // A million are answered at once, and zero has no sign.
    assert_eq!(object("k-star --vertices 1000000 --p 0.3")["value"], 999_997);
    assert_eq!(object("k-star --p -0.0")["inputs"]["p"].to_string(), "0.0");
    let list = eval("--list");
    assert_eq!(list.lines().count(), 14);
    assert!(list.lines().all(|line| line.contains("Eq") || line.contains("Sec.")));
}

const SMALL: &str = "--masses 30 --realisations 24 --transient 60 --window 40";

/// A million masses have room in a gigabyte.
#[test]
fn a_sweep_takes_no_more_memory_than_it_says() {
    let sweep = "ulimit -v 1000000; exec \"$0\" sweep --sigma 0.3 --masses 1000000 --realisations 1 --transient 0 \
                 --window 1 --threads 1";
    let mut command = Command::new("bash");
    let (code, table, note) = crate::outcome(command.args(["-c", sweep, crate::PROGRAM]));
    assert!(code == 0 && table.contains("0.3,"), "{note}");
}

fn table(arguments: &str) -> String {
    answer(Path::new("."), &format!("sweep {arguments} {SMALL}"))
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let tables =
        [1, 4, 7].map(|threads| table(&format!("--sigma 0.12..0.2:0.02 --threads {threads}")));
    assert_eq!(tables[0].lines().count(), 6);
    assert!(tables.iter().all(|table| *table == tables[0]), "{tables:#?}");
    // A row depends on the seed, and neither on other rows nor on how σ was written.
    let [alone, other] = ["", " --seed 1"]
        .map(|seed| table(&format!("--sigma 0.16{seed}")).lines().nth(1).unwrap().to_string());
    assert!(tables[0].lines().any(|row| row == alone) && alone != other, "{alone}\n{other}");
}

#[test]
fn columns_and_rows() {
    let table = table("--sigma 0.01,0.2");
    let lines: Vec<&str> = table.lines().collect();
    let header = "sigma,realisations,kept,rejected,mean_distinct,standard_error,mode_distinct,\
                  impacts_per_time,impacts,near_simultaneous,slow,contact_phases,mean_all,\
                  standard_error_all,simultaneous,undecided,transient,window";
    assert_eq!(lines[0], header);
    // At σ = 0.01 nothing can hit: the gap closes only for a 25-σ force. Empty, not zero or NaN.
    assert!(lines[1].starts_with("0.01,24,0,0,,,,,0,0,0,0"), "{table}");
    assert!(lines[2].starts_with("0.2,24,"));
}

/// Parts add up to the whole, windows are those of several runs, each option has an effect.
#[test]
fn parts_windows_and_parameters_of_a_sweep() {
    let cells = |options: &str| -> Vec<Vec<String>> {
        let small = [("realisations", "24"), ("transient", "60"), ("window", "40")];
        let mut line = format!("sweep --sigma 0.3 --masses 30{options}");
        for (option, value) in small.into_iter().filter(|(option, _)| !options.contains(option)) {
            line += &format!(" --{option} {value}");
        }
        let row = |line: &str| line.split(',').map(String::from).collect();
        answer(Path::new("."), &line).lines().skip(1).map(row).collect()
    };
    let impacts = |options: &str| cells(options)[0][8].parse::<u64>().unwrap();
    let parts = ["0..10", "10..24"].map(|part| impacts(&format!(" --realisations {part}")));
    assert_eq!(impacts(""), parts.iter().sum::<u64>());
    for (transient, row) in ["10", "50"].into_iter().zip(&cells(" --transient 10,50 --window 40")) {
        let alone = cells(&format!(" --transient {transient} --window 40"));
        assert_eq!((&row[1..8], &row[16..]), (&alone[0][1..8], &alone[0][16..]), "{transient}");
    }
    let plain = cells("");
    for option in [" --forcing-frequency 1.3", " --natural-frequency 1.1", " --spacing 1.2"] {
        assert_ne!(plain, cells(option), "{option}");
    }
}

#[test]
fn overlapping_starts_are_rejected_counted_and_named() {
    // σ = 0.3: 99 % of the random starts overlap, none of those from rest.
    let random = format!("sweep --sigma 0.3 --initial random {SMALL}");
    let [random, _] = ends(Path::new("."), &random, 0, &["not comparable"]);
    let rejected = |table: &str| -> usize {
        table.lines().nth(1).unwrap().split(',').nth(3).unwrap().parse().unwrap()
    };
    assert!(rejected(&random) > 12, "{random}");
    assert_eq!(rejected(&table("--sigma 0.3")), 0);
}

#[test]
fn impacts_are_listed_in_order_from_a_file_or_a_pipe() {
    let folder = folder(SCENARIO);
    let table = answer(folder.path(), "trace s.json --until 30");
    assert!(table.starts_with("time,gap,closing_speed\n") && table.lines().count() > 5, "{table}");
    let mut command = program(folder.path(), "trace - --until 30");
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(SCENARIO.as_bytes()).unwrap();
    assert_eq!(child.wait_with_output().unwrap().stdout, table.as_bytes());
    let mut last = 0.0;
    for line in table.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert!(cells[0] >= last && cells[1] <= 3.0 && cells[2] >= 0.0, "{line}");
        last = cells[0];
    }
}

/// States at given times, and many scenarios in one run, each line answered for itself.
#[test]
fn states_and_many_scenarios() {
    let folder = folder(SCENARIO);
    let plain = answer(folder.path(), "trace s.json --until 9");
    let states = answer(folder.path(), "trace s.json --at 0..9:4.5");
    assert!(states.starts_with("time,mass,position,velocity\n0.0,1,1.0,0.0\n"), "{states}");
    assert_eq!(states.lines().count(), 1 + 3 * 3);
    let one_line = SCENARIO.replace('\n', " ");
    std::fs::write(folder.path().join("s.json"), format!("{one_line}\n{one_line}\n\n[]\n"))
        .unwrap();
    let trace = "trace s.json --lines --until 9";
    let [text, _] = ends(folder.path(), trace, 2, &["s.json, line 4: scenario: "]);
    let expected = |cells: [&str; 2], last: &str| {
        let rows = |cell: &str| -> String {
            plain.lines().skip(1).map(|row| format!("{cell},{row}\n")).collect()
        };
        let [first, second] = cells.map(rows);
        first + &second + last
    };
    let header = "scenario,time,gap,closing_speed\n";
    assert_eq!(text, header.to_string() + &expected(["1", "2"], ""));
    let notes = ["line 4: scenario: ", "lines refused or stopped: 1"];
    let [text, _] = ends(folder.path(), &format!("{trace} --keep-going"), 1, &notes);
    let header = "scenario,status,time,gap,closing_speed\n";
    assert_eq!(text, header.to_string() + &expected(["1,ok", "2,ok"], "4,refused,,,\n"));
}

/// The events of two halves are those of the whole run, and samples are taken once in a period.
#[test]
fn a_run_goes_on_from_what_was_saved() {
    let folder = folder(SCENARIO);
    let rows = |options: &str| -> Vec<(f64, String)> {
        let table = answer(folder.path(), &format!("trace s.json {options}"));
        let cells = table.lines().skip(1).map(|row| row.split_once(',').unwrap());
        cells.map(|(time, rest)| (time.parse().unwrap(), rest.to_string())).collect()
    };
    let whole = rows("--until 30 --events");
    let halves =
        ["--until 12 --events --save half.json", "--from half.json --until 30 --events"].map(rows);
    let [half, after] = halves.each_ref().map(Vec::len);
    assert!(half > 2 && after > 2 && half + after == whole.len(), "{half}, {after}");
    for ((time, event), (expected, same)) in halves.concat().iter().zip(&whole) {
        let event_and_gap = |row: &str| row.rsplit_once(',').unwrap().0.to_string();
        assert!((time - expected).abs() < 1e-10, "{time} {expected}");
        assert_eq!(event_and_gap(event), event_and_gap(same));
    }
    let samples = rows("--at period --until 20");
    assert_eq!(samples.len(), 5 * 3);
    assert!((samples[3].0 - std::f64::consts::TAU / 2.0_f64.sqrt()).abs() < 1e-14);
    assert_eq!(rows("--from half.json --at period --until 20").len(), 2 * 3);
    assert_eq!(rows("--at 0..9:4.5 --until 5").len(), 2 * 3);
    assert_eq!(rows("--at 1,2,2,3").len(), 3 * 3);
    let short = r#"{"time":1,"positions":[],"velocities":[]}"#;
    std::fs::write(folder.path().join("short.json"), short).unwrap();
    for (arguments, says) in [
        ("--from half.json --until 11", "--until: 11.0 is before the state, at 12.0"),
        ("--from half.json --at 11,13", "--at: 11.0 is before the state, at 12.0"),
        ("--from short.json --until 11", "--from: short.json: positions: it has 0"),
    ] {
        refused(folder.path(), &format!("trace s.json {arguments}"), &[says]);
    }
}

#[test]
fn the_method_that_is_named_is_run() {
    let folder = folder(SCENARIO);
    let by = |method: &str| answer(folder.path(), &format!("trace s.json --until 10{method}"));
    let plain = by("");
    for method in MethodName::ALL.map(MethodName::id).into_iter().chain(["truth"]) {
        let impacts = by(&format!(" --method {method}"));
        assert!(impacts.lines().count() > 5, "{impacts}");
        assert_eq!(impacts == plain, method == "certified", "{method}");
    }
    for (method, option) in [("verlet", "--step 0.01"), ("runge-kutta", "--tolerance 1e-4")] {
        let method = format!(" --method {method}");
        assert_ne!(by(&method), by(&format!("{method} {option}")));
    }
}

/// Ties, contact, rounding where a run is stopped, and rounding near resonance.
#[test]
fn standard_error_says_what_a_run_did() {
    let near = r#"{"forcing":[[0.9,-0.4]],"forcing_frequency":1.0000001}"#;
    // A fast mass between walls has more impacts in 1/w than a run may have.
    let fast = r#"{"natural_frequency":0.001,"forcing_frequency":1000,"restitution":1,"forcing":[[0,1e6]]}"#;
    let tied = r#"{"forcing":[[0.9,0.8],[0,0],[-0.9,-0.8]]}"#;
    let stuck = r#"{"restitution":0.2,"forcing":[[5.88,-4.94]]}"#;
    for (scenario, run, code, note, lines, rows) in [
        (tied, "--until 12", 0, ": 3 of 15; ", 1, 15),
        (stuck, "--until 100 --method truth", 2, "does not support contact; use another", 1, 0),
        (fast, "--until 1e4", 1, "may move each impact", 2, 1000),
        (near, "--until 20", 0, "closing speed v by 2.9e-7/v", 1, 2),
    ] {
        let folder = folder(scenario);
        let [out, said] = ends(folder.path(), &format!("trace s.json {run}"), code, &[note]);
        assert_eq!(said.lines().count(), lines, "{said}");
        assert!(out.lines().count() > rows || rows == 0, "{scenario}: {out}");
    }
}
