//! `impact-paper sweep` as a user meets it.

use crate::{answer, ended, program, run};
use std::path::Path;
use std::process::{Command, Stdio};

const SMALL: &str = "--masses 30 --realisations 24 --transient 60 --window 40";

/// The table of a small sweep.
fn table(arguments: &str) -> String {
    answer(Path::new("."), &format!("sweep {arguments} {SMALL}"))
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let tables =
        [1, 4, 7].map(|threads| table(&format!("--sigma 0.12..0.2:0.02 --threads {threads}")));
    assert_eq!(tables[0].lines().count(), 6);
    assert!(tables.iter().all(|table| *table == tables[0]), "{tables:#?}");
    // A row does not depend on the other rows, nor on how σ was written; another seed is another ensemble.
    let [alone, other] = ["", " --seed 1"]
        .map(|seed| table(&format!("--sigma 0.16{seed}")).lines().nth(1).unwrap().to_string());
    assert!(tables[0].lines().any(|row| row == alone) && alone != other, "{alone}\n{other}");
}

#[test]
fn columns_rows_and_both_formats() {
    let text = table("--sigma 0.01,0.2");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "sigma,realisations,kept,rejected,mean_distinct,standard_error,mode_distinct,\
         impacts_per_time,impacts,near_simultaneous,slow,contact_phases"
    );
    // At σ = 0.01 nothing can hit: the gap closes only for a 25-σ force. Empty, not zero or NaN.
    assert!(lines[1].starts_with("0.01,24,0,0,,,,,0,0,0,0"), "{text}");
    assert!(lines[2].starts_with("0.2,24,"));
    let rows: Vec<serde_json::Map<String, serde_json::Value>> =
        serde_json::from_str(&table("--sigma 0.01,0.2 --format json")).unwrap();
    let reader = csv::Reader::from_reader(text.as_bytes()).into_records().flatten();
    let header: Vec<&str> = lines[0].split(',').collect();
    for (row, record) in rows.iter().zip(reader) {
        assert_eq!(row.len(), header.len());
        for (name, cell) in header.iter().zip(&record) {
            match &row[*name] {
                serde_json::Value::Null => assert_eq!(cell, ""),
                value => assert_eq!(value.as_f64().unwrap(), cell.parse::<f64>().unwrap()),
            }
        }
    }
    assert!(rows.len() == 2 && rows[0]["mean_distinct"].is_null());
}

#[test]
fn overlapping_starts_are_rejected_counted_and_named() {
    // σ = 0.3: 99 % of the random starts overlap, none of those from rest.
    let random = format!("sweep --sigma 0.3 --initial random {SMALL}");
    let (code, random, note) = run(Path::new("."), &random);
    assert!(code == 0 && note.contains("not comparable"), "{note}");
    let rejected = |table: &str| -> usize {
        table.lines().nth(1).unwrap().split(',').nth(3).unwrap().parse().unwrap()
    };
    assert!(rejected(&random) > 12, "{random}");
    assert_eq!(rejected(&table("--sigma 0.3")), 0);
}

fn sweep(arguments: &str) -> Command {
    let mut command = program(Path::new("."), &format!("sweep {arguments}"));
    command.stderr(Stdio::piped());
    command
}

#[cfg(unix)]
#[test]
fn signals_end_a_sweep_of_any_size() {
    for signal in ["-INT", "-TERM"] {
        for arguments in [
            "--sigma 0.3,0.4 --realisations 1000000 --threads 2",
            // One chain that is long to set up, and one in which nothing happens for very long.
            "--realisations 1 --sigma 0.3 --masses 2000000 --transient 1e11",
            "--realisations 1 --sigma 0.085 --masses 1000 --transient 9e11",
        ] {
            let [out, note] = ended(&mut sweep(arguments), signal);
            assert!(out.is_empty() && note.contains("interrupted"), "{out}{note}");
        }
    }
}
