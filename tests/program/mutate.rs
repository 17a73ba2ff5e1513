//! `impact-paper mutate`: a number that is wrong is noticed by the check that should, and a number that
//! nobody would miss needs a reason.

use crate::{PROGRAM, QUICK, outcome, put};
use impact_paper::claims::{self, Published};
use impact_paper::experiments::{Need, Progress, Store, run::run};
use impact_paper::params::Profile;
use impact_paper::report::claims::scorecard;
use impact_paper::report::{contents, guards};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use std::sync::LazyLock;
use tempfile::TempDir;

/// Results of the quick profile, for all tests of this file.
static RESULTS: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    put(folder.path(), &QUICK.results);
    folder
});

fn mutate(arguments: &[&str]) -> (i32, String, String) {
    let results = RESULTS.path().to_str().unwrap();
    let mut command = Command::new(PROGRAM);
    command.args(["mutate", "--profile", "quick", "--results", results]).args(arguments);
    outcome(&mut command)
}

/// The project's templates with one file changed, in a folder of its own.
fn templates(name: &str, change: impl Fn(&str) -> String) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    crate::templates(&folder.path().join("t"), name, |text| {
        let changed = change(text);
        assert_ne!(text, changed);
        changed
    });
    folder
}

fn with(folder: &TempDir, more: &[&str]) -> (i32, String, String) {
    let own = folder.path().join("t");
    mutate(&[&["--templates", own.to_str().unwrap()], more].concat())
}

/// What `--json` says of some values: place, red above, red below.
fn red(ids: &[&str]) -> Vec<(String, String, String)> {
    let asked: Vec<&str> = ids.iter().flat_map(|id| ["--value", *id]).chain(["--json"]).collect();
    let (code, text, note) = mutate(&asked);
    let all: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(code, i32::from(all["counts"]["without_a_reason"] != 0), "{note}");
    let list = all["values"].as_array().unwrap();
    assert_eq!(list.len(), ids.len(), "{text}");
    let of = |id: &&str| {
        let found = list.iter().find(|value| value["id"] == **id).unwrap();
        let names = |side: &str| found[side].to_string();
        (found["at"].to_string(), names("above"), names("below"))
    };
    ids.iter().map(of).collect()
}

#[test]
fn the_check_that_should_notice_does() {
    let expected = [
        // Leaves of results, and what is held against them.
        ("graph_edges", "theory/graph_edges", "claim sec3_edges"),
        ("p_crit", "theory/", "claim sec7_p_crit"),
        ("p_jump", "theory/", "guard equal_weights_at_jump"),
        ("sigma_jump", "theory/scalars/sigma_jump", "guard sigmas_of_jumps"),
        ("onset", "sweep/rise/onset/value", "guard places_on_curves"),
        ("sweep.s0_22_mean", "sweep/rows/", "guard means_of_counts"),
        ("horizon_order", "horizon/order/value", "guard means_of_twins"),
        ("large_k_jump", "theory/large/jumps", "guard jump_at_large_n"),
        ("large_rule", "theory/large/jumps", "guard rule_of_large_jumps"),
        ("poisson.d1_4", "theory/large/poisson", "guard distances_from_poisson"),
        ("orders.p4", "theory/orders/jumps", "guard jumps_of_orders"),
        ("all_p_jump", "theory/orders/jump", "guard jump_of_all_orders"),
        ("five_at_jump", "theory/orders/remarks", "guard five_of_all_orders"),
        ("first_maximum_numerator", "theory/slips/", "guard first_maximum"),
        // Computed on the way to the report.
        ("kept_above", "report", "guard rows_named"),
        ("run_silence", "report", "guard silence_of_the_run"),
        ("score.total", "report", "guard scores_add_up"),
        // What the paper printed.
        ("printed.sec3_edges", "published.toml", "claim sec3_edges"),
        ("printed.sec2_onset", "published.toml", "guard printed_as_it_reads"),
        ("paper.fig8_p_a", "published.toml", "guard probabilities_printed"),
    ];
    let found = red(&expected.map(|(id, ..)| id));
    for ((id, place, check), (at, above, below)) in expected.iter().zip(&found) {
        assert!(at.contains(place), "{id} is moved at {at}");
        for red in [above, below] {
            assert!(red.contains(check), "{id}: {red}");
        }
    }
}

#[test]
fn a_number_that_nobody_would_miss_is_listed() {
    let (code, text, note) = mutate(&["--value", "own_work", "--value", "graph_edges"]);
    assert_eq!(code, 1, "{text}");
    assert!(
        text.contains("UNGUARDED own_work") && text.contains("guarded   graph_edges"),
        "{text}"
    );
    assert!(text.contains("2 numbers: 1 guarded, 1 not, 1 of these without a reason"), "{text}");
    assert!(note.contains("own_work; guard them, or give a reason in unguarded.toml"), "{note}");
    let (code, text, note) = mutate(&["--value", "nobody"]);
    assert_eq!((code, text.as_str()), (2, ""), "{note}");
}

#[test]
fn all_are_guarded_or_have_a_reason_that_they_need() {
    let (code, text, note) = mutate(&[]);
    assert_eq!(code, 0, "{note}");
    assert!(!text.contains("UNGUARDED") && text.contains("excused, counted work: "), "{text}");
    // Each number that is used has its line.
    let lines = text.lines().filter(|line| line.contains(" ± ")).count();
    assert!(text.contains(&format!("\n{lines} numbers: ")) && lines > 300, "{text}");
    assert_eq!(mutate(&[]).1, text, "the same twice");

    // A reason is taken away: its number is told.
    let missing = templates("unguarded.toml", |text| text.replacen("\"own_work\", ", "", 1));
    let (code, text, note) = with(&missing, &[]);
    assert_eq!(code, 1, "{note}");
    assert!(text.contains("UNGUARDED own_work") && note.contains(": own_work;"), "{note}");

    // Reasons without need: of a number that is guarded, and of one that is not there.
    let needless = templates("unguarded.toml", |text| {
        text.replacen("\"own_work\", ", "\"own_work\", \"p_crit\", \"p_krit\", ", 1)
    });
    let (code, _, note) = with(&needless, &[]);
    assert_eq!(code, 1, "{note}");
    assert!(note.contains("\"p_crit\" (guarded)"), "{note}");
    assert!(note.contains("\"p_krit\" (there is no such value)"), "{note}");
    let empty = templates("unguarded.toml", |text| text.replacen("why = \"", "why = \"\" #", 1));
    let (code, _, note) = with(&empty, &[]);
    assert!(code == 2 && note.contains("unguarded.toml: no reason for"), "{note}");
}

/// Guards have names of their own, and relate values that there are.
#[test]
fn guards_relate_values_of_the_report() {
    let scenario = |file: &str| {
        std::fs::read_to_string(Path::new("templates").join(file)).map_err(|e| e.to_string())
    };
    let (store, quiet) = (Store::open(RESULTS.path()).unwrap(), Progress::silent());
    let results = run(&Need::ALL, Profile::Quick, scenario, &store, &quiet).unwrap();
    let published = Published::committed().unwrap();
    let mut values = contents::registry(&results, &published).unwrap();
    values.extend(scorecard(&claims::all(&results, &published).unwrap())).unwrap();
    let mut names = BTreeSet::new();
    for guard in guards::all() {
        assert!(names.insert(guard.name), "two guards are {}", guard.name);
        for id in guard.ids {
            let mut known = values.iter().map(|value| value.id.as_str());
            let known = known.any(|own| guards::fits(id, own))
                || values.names().any(|(name, _)| guards::fits(id, name));
            assert!(known, "{} has no {id}", guard.name);
        }
    }
    assert!(names.len() > 40, "{names:?}");
}

/// What is wrong in what is read makes `check` fail by the name of the guard, in every form.
#[test]
fn check_names_a_guard_that_fails() {
    let folder = templates("published.toml", |text| text.replacen("σ ≈ 0.12", "σ ≈ 0.13", 1));
    let check = |form: &str| {
        let mut command = Command::new(PROGRAM);
        command.args(["check", "--profile", "quick", "--format", form]);
        command.arg("--results").arg(RESULTS.path());
        outcome(command.arg("--templates").arg(folder.path().join("t")))
    };
    for (form, sign) in [
        ("text", "FAILS guard printed_as_it_reads: "),
        ("json", "\"guard\": \"printed_as_it_reads\""),
        ("github", "::error title=guard printed_as_it_reads::"),
        ("markdown", "| printed_as_it_reads | "),
    ] {
        let (code, out, note) = check(form);
        assert_eq!(code, 1, "{note}");
        assert!(out.contains(sign), "{sign}: {out}");
        assert!(note.contains("do not hold: printed_as_it_reads"), "{note}");
    }
}
