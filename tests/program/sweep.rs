//! `impact-paper sweep` as a user meets it.

use crate::{answer, run};
use std::path::Path;

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
    let json: serde_json::Value =
        serde_json::from_str(&table("--sigma 0.01,0.2 --format json")).unwrap();
    for (name, cell) in lines[0].split(',').zip(lines[2].split(',')) {
        assert_eq!(json[1][name].as_f64(), cell.parse::<f64>().ok(), "{name}");
    }
    assert!(json[0]["mean_distinct"].is_null(), "{json}");
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
