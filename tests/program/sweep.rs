//! `impact-paper sweep` as a user meets it, and the ensembles behind it.

use assert_cmd::Command;
use impact_paper::experiments::{Progress, sweep};
use impact_paper::params::{Profile, Start, SweepParams};
use std::io::Read;
use std::process::Stdio;
use std::time::{Duration, Instant};

fn program() -> Command {
    Command::cargo_bin("impact-paper").unwrap()
}

/// Runs `sweep` with arguments split at spaces; returns exit code, stdout and stderr.
fn run(arguments: &str) -> (i32, String, String) {
    let output = program().arg("sweep").args(arguments.split(' ')).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

const SMALL: &str = "--masses 30 --realisations 24 --transient 60 --window 40";

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let tables: Vec<String> = [1, 4, 7]
        .map(|threads| {
            let arguments = format!("--sigma 0.12..0.2:0.02 {SMALL} --threads {threads}");
            let (code, table, _) = run(&arguments);
            assert_eq!(code, 0);
            table
        })
        .into();
    assert_eq!(tables[0].lines().count(), 6);
    assert!(tables.iter().all(|table| *table == tables[0]), "{tables:#?}");
}

#[test]
fn columns_rows_and_both_formats() {
    let (code, table, _) = run(&format!("--sigma 0.01,0.2 {SMALL}"));
    assert_eq!(code, 0);
    let mut lines = table.lines();
    assert_eq!(
        lines.next().unwrap(),
        "sigma,realisations,kept,rejected,mean_distinct,standard_error,mode_distinct,\
         impacts_per_time,impacts,near_simultaneous,slow,contact_phases"
    );
    // At σ = 0.01 nothing can hit: the gap closes only for a 25-σ force. Empty, not zero or NaN.
    assert!(lines.next().unwrap().starts_with("0.01,24,0,0,,,,,0,0,0,0"), "{table}");
    assert!(lines.next().unwrap().starts_with("0.2,24,"));
    let (code, json, _) = run(&format!("--sigma 0.01,0.2 {SMALL} --format json"));
    assert_eq!(code, 0);
    let rows: Vec<serde_json::Map<String, serde_json::Value>> =
        serde_json::from_str(&json).unwrap();
    let reader = csv::Reader::from_reader(table.as_bytes()).into_records().flatten();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    for (row, record) in rows.iter().zip(reader) {
        assert_eq!(row.len(), header.len());
        for (name, cell) in header.iter().zip(&record) {
            match &row[*name] {
                serde_json::Value::Null => assert_eq!(cell, ""),
                value => assert_eq!(value.as_f64().unwrap(), cell.parse::<f64>().unwrap()),
            }
        }
    }
    assert_eq!(rows.len(), 2);
    assert!(rows[0]["mean_distinct"].is_null());
}

#[test]
fn realisations_are_common_to_all_sigma_and_all_lists() {
    // A row does not depend on the other rows, nor on how σ was written.
    let (_, alone, _) = run(&format!("--sigma 0.16 {SMALL}"));
    let (_, among, _) = run(&format!("--sigma 0.1..0.2:0.02 {SMALL}"));
    let row = alone.lines().nth(1).unwrap();
    assert!(among.lines().any(|other| other == row), "{row}\n{among}");
    // The same normals at every σ: scaled by 2^1 the amplitudes are exactly doubled.
    use impact_paper::{dynamics::Scenario, numerics::random::NormalPairs, params::Chain};
    let draw = |sigma, index| {
        let mut normals = NormalPairs::new("sweep", 2007, index);
        Scenario::draw(&Chain::default(), sigma, &mut normals).forcing
    };
    let doubled: Vec<[f64; 2]> = draw(0.1, 5).iter().map(|pair| pair.map(|x| 2.0 * x)).collect();
    assert_eq!(draw(0.2, 5), doubled);
    assert_ne!(draw(0.1, 5), draw(0.1, 6));
    // And another seed is another ensemble.
    let (_, other, _) = run(&format!("--sigma 0.16 {SMALL} --seed 1"));
    assert_ne!(other.lines().nth(1).unwrap(), row);
}

#[test]
fn overlapping_starts_are_rejected_counted_and_named() {
    // σ = 0.3: 99 % of the random starts overlap, none of those from rest.
    let (code, table, note) = run(&format!("--sigma 0.3 --initial random {SMALL}"));
    assert_eq!(code, 0);
    let cells: Vec<&str> = table.lines().nth(1).unwrap().split(',').collect();
    assert!(cells[3].parse::<usize>().unwrap() > 12, "{table}");
    assert!(note.contains("not comparable"), "{note}");
    let (_, table, note) = run(&format!("--sigma 0.3 {SMALL}"));
    assert_eq!(table.lines().nth(1).unwrap().split(',').nth(3), Some("0"));
    assert_eq!(note, "");
}

#[test]
fn bad_input_gets_one_line_and_exit_code_2() {
    for (arguments, field) in [
        ("--sigma -0.1", "--sigma"),
        ("--sigma NaN", "--sigma"),
        ("--sigma x", "--sigma"),
        ("--sigma 0.2..0.1:0.01", "--sigma"),
        ("--sigma 0.1..0.2:0", "--sigma"),
        ("--sigma 1e300", "--sigma"),
        ("--sigma 0.1 --masses 0", "--masses"),
        ("--sigma 0.1 --masses -3", "--masses"),
        ("--sigma 0.1 --realisations 0", "--realisations"),
        ("--sigma 0.1 --transient -1", "--transient"),
        ("--sigma 0.1 --transient NaN", "--transient"),
        ("--sigma 0.1 --transient 1e13", "--transient"),
        ("--sigma 0.1 --window 0", "--window"),
        ("--sigma 0.1 --window inf", "--window"),
        ("--sigma 0.1 --restitution 1.1", "--restitution"),
        ("--sigma 0.1 --restitution -0.1", "--restitution"),
        ("--sigma 0.1 --restitution NaN", "--restitution"),
        ("--sigma 0.1 --initial moving", "--initial"),
        ("--sigma 0.1 --boundary none", "--boundary"),
        ("--sigma 0.1 --seed -1", "--seed"),
        ("--sigma 0.1 --threads 0", "--threads"),
        ("--sigma 0.1 --format xml", "--format"),
        ("--sigma 0.1 --unknown 1", "--unknown"),
        ("--masses 5", "--sigma"),
    ] {
        let (code, out, note) = run(arguments);
        assert_eq!((code, out.as_str()), (2, ""), "{arguments}: {note}");
        assert_eq!(note.trim_end().lines().count(), 1, "{arguments}: {note}");
        assert!(note.contains(field), "{arguments}: {note}");
    }
}

/// A sweep that a signal ends: by its code, within two seconds (one, and what a busy machine adds), without
/// a table; what it said.
#[cfg(unix)]
fn ended(signal: &str, arguments: &[&str]) -> String {
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_impact-paper"))
        .arg("sweep")
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(700));
    assert_eq!(child.try_wait().unwrap(), None, "it must still be running");
    let asked = Instant::now();
    let kill = std::process::Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let code = child.wait().unwrap().code();
    assert!(asked.elapsed() < Duration::from_secs(2), "{:?}", asked.elapsed());
    assert_eq!(code, Some(130));
    let [mut out, mut note] = [String::new(), String::new()];
    child.stdout.take().unwrap().read_to_string(&mut out).unwrap();
    assert_eq!(out, "");
    child.stderr.take().unwrap().read_to_string(&mut note).unwrap();
    note
}

/// Where messages cannot be written, they are lost and nothing else: codes stay, and signals end what runs.
#[cfg(target_os = "linux")]
#[test]
fn messages_that_cannot_be_written_change_nothing() {
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let sweep = |arguments: &[&str]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_impact-paper"));
        command.arg("sweep").args(arguments).stdout(Stdio::null()).stderr(full());
        command
    };
    assert_eq!(sweep(&["--sigma", "x"]).status().unwrap().code(), Some(2));
    assert_eq!(sweep(&["--sigma", "0.3", "--realisations", "2"]).status().unwrap().code(), Some(0));
    let mut child = sweep(&["--sigma", "0.3", "--realisations", "1000000"]).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(700));
    let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let asked = Instant::now();
    while child.try_wait().unwrap().is_none() && asked.elapsed() < Duration::from_secs(5) {
        std::thread::sleep(Duration::from_millis(20));
    }
    let code = child.try_wait().unwrap().map(|status| status.code());
    let _ = child.kill();
    assert_eq!(code, Some(Some(130)));
}

#[cfg(unix)]
#[test]
fn signals_end_a_sweep_of_any_size_within_a_second() {
    for signal in ["-INT", "-TERM"] {
        let many = ["--sigma", "0.3,0.4", "--realisations", "1000000", "--threads", "2"];
        let note = ended(signal, &many);
        assert!(note.contains("interrupted"), "{note}");
        // One chain that is long to set up, and one in which nothing happens for very long.
        let one = ["--realisations", "1", "--sigma"];
        ended(signal, &[&one[..], &["0.3", "--masses", "2000000", "--transient", "1e11"]].concat());
        ended(signal, &[&one[..], &["0.085", "--masses", "1000", "--transient", "9e11"]].concat());
    }
}

#[test]
fn the_rise_lies_where_it_was_measured_elsewhere() {
    // An independent simulator, 1000 realisations, rest start, T = 500, W = 200: 0.1165(4).
    let parameters = SweepParams {
        sigmas: (18..=28).map(|i| f64::from(i) / 200.0).collect(),
        realisations: 60,
        ..SweepParams::main(Profile::Full)
    };
    assert_eq!(parameters.chain.start, Start::Rest);
    let found = sweep::run(&parameters, "test", &Progress::silent()).unwrap();
    let half = found.rise.half_height.unwrap();
    // Four standard errors of both together; a wrong law of impact moves it by ten.
    let error = (half.error * half.error + 4e-4 * 4e-4).sqrt();
    assert!(half.error < 2e-3, "{half:?}");
    assert!((half.value - 0.1165).abs() < 4.0 * error, "{half:?}");
    let onset = found.rise.kept_half.unwrap().value;
    assert!(onset < half.value, "half of the chains impact long before half of the gaps: {onset}");
}
