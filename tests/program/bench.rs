//! `impact-paper bench`: the JSON that it prints.

use crate::answer;
use impact_paper::dynamics::{Engine, Scenario};
use impact_paper::experiments::Measured;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

fn bench(arguments: &str) -> String {
    answer(Path::new("."), &format!("-q bench {arguments}"))
}

fn json(arguments: &str) -> Value {
    serde_json::from_str(&bench(arguments)).unwrap()
}

const TINY: &str = "engine --masses 1,20 --until 20 --repetitions 3 --chains 2";

#[test]
fn a_case_has_every_field() {
    let report = json(TINY);
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    let cases = report["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 2);
    let case = &cases[1];
    for (field, value) in [("n", 20.0), ("sigma", 0.3), ("until", 20.0), ("chains", 2.0)] {
        assert_eq!(case[field].as_f64(), Some(value), "{field}");
    }
    let positive = |field: &str| {
        let x = case[field].as_f64().unwrap_or_else(|| panic!("no {field}"));
        assert!(x > 0.0, "{field}: {x}");
        x
    };
    // Two chains of 20 masses have some 3 impacts a unit of time each.
    let impacts = positive("impacts");
    assert!((40.0..400.0).contains(&impacts), "{impacts}");
    let best = positive("ns_per_impact");
    assert!(best <= positive("ns_per_impact_median"));
    assert!((best * impacts - positive("seconds") * 1e9).abs() < 1e-3 * best * impacts);
    // A search or more an impact and a piece or more a search; most pieces need no evaluation.
    assert!(positive("searches_per_impact") >= 1.0);
    assert!(positive("pieces_per_impact") >= positive("searches_per_impact"));
    assert!(positive("evaluations_per_impact") <= positive("pieces_per_impact"));
    positive("setup_seconds");
    // Counts are the same whatever the threads.
    let two = json(&format!("{TINY} --threads 2"));
    for field in ["impacts", "evaluations_per_impact", "searches_per_impact", "undecided"] {
        assert_eq!(case[field], two["cases"][1][field], "{field}");
    }
}

/// The scenario that is printed is the chain that is timed, and `trace` takes it.
#[test]
fn a_scenario_is_the_chain_that_is_timed() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = bench("scenario --masses 20 --chain 3");
    fs::write(folder.path().join("s.json"), scenario).unwrap();
    let impacts = answer(folder.path(), "trace s.json --until 20").lines().count() as u64 - 1;
    let timed = |more: &str| {
        let until = format!("engine --until 20 --repetitions 1 --masses 20{more}");
        json(&until)["cases"][0]["impacts"].as_u64()
    };
    assert_eq!(timed(" --chain 3"), Some(impacts));
    assert_ne!(timed(""), Some(impacts));
}

/// Rows of rivals are rows of measured.json, and judge what they are set against.
#[test]
fn methods_are_judged() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("reference.json");
    // One true impact, one segment at rest that it ends, and an impact that never comes.
    let options = "methods --masses 20 --until 3 --seconds 0";
    let free = json(options);
    let rows = free["rows"].as_array().unwrap();
    let certified = rows.iter().find(|row| row["name"] == "certified").unwrap();
    assert!(certified["impacts"].as_u64().unwrap() > 0 && certified["compared"].is_null());
    let scenario = Scenario::from_json(&bench("scenario --masses 20")).unwrap();
    let mut first = None;
    let mut engine = Engine::new(&scenario).unwrap();
    engine.run(3.0, |impact| first.replace(impact).is_some()).unwrap();
    let first = first.unwrap();
    let rest = vec![0.0; 20];
    let segment =
        |gap: usize| json!({"t": 0.0, "u": rest, "v": rest, "next_t": first.time, "next_gap": gap});
    let truth = json!({
        "impacts": [[first.time, first.gap], [first.time + 0.01, 99]],
        "segments": [segment(first.gap), segment(first.gap + 1)],
    });
    fs::write(&path, truth.to_string()).unwrap();
    let judged = json(&format!("{options} --reference {}", path.display()));
    let certified = &judged["rows"].as_array().unwrap()[0];
    for (field, value) in
        [("compared", 2), ("horizon_impact", 2), ("segments", 2), ("segment_misses", 1)]
    {
        assert_eq!(certified[field].as_u64(), Some(value), "{field}");
    }
    // Of another number of masses.
    let other = format!("-q bench methods --masses 19 --until 3 --reference {}", path.display());
    crate::refused(Path::new("."), &other, &["--reference", "segments[0]", "19 numbers"]);
    let machine = json!({"processor": "x", "cores": 1, "os": "x"});
    let file = json!({"date": "2007-01-01", "machine": machine, "rows": judged["rows"]});
    let measured = Measured::parse(&file.to_string()).unwrap();
    assert!(measured.rows.len() > 15);
}

/// A million masses need far less than 1 GiB: here a tenth of them, the start included.
#[test]
fn memory_grows_by_less_than_a_kibibyte_a_mass() {
    let peak = |n: &str| {
        let report = json(&format!("engine --masses {n} --until 1 --repetitions 1"));
        report["cases"][0]["peak_mib"].as_f64()
    };
    // Only Linux tells.
    let (Some(few), Some(many)) = (peak("10"), peak("100000")) else { return };
    let bytes_a_mass = (many - few) * 1024.0 * 1024.0 / 1e5;
    assert!((100.0..500.0).contains(&bytes_a_mass), "{bytes_a_mass} bytes a mass");
}
