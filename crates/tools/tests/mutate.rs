//! `impact-paper-tools mutate`: a number that is wrong is noticed by the check that should.

use std::process::Command;
use std::sync::LazyLock;
use tempfile::TempDir;

/// The checkout.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// Results of the quick profile, for all tests of this file.
static RESULTS: LazyLock<TempDir> = LazyLock::new(|| tempfile::tempdir().unwrap());

fn mutate(arguments: &[&str]) -> (i32, String, String) {
    let results = RESULTS.path().to_str().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_impact-paper-tools"));
    command.current_dir(ROOT);
    command.args(["mutate", "--profile", "quick", "--results", results]).args(arguments);
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap_or(-1), text(output.stdout), text(output.stderr))
}

/// What `--json` says of some values: place, red above, red below.
fn red(ids: &[&str]) -> Vec<(String, String, String)> {
    let asked: Vec<&str> = ids.iter().flat_map(|id| ["--value", *id]).chain(["--json"]).collect();
    let (code, text, note) = mutate(&asked);
    let all: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(code, i32::from(all["counts"]["unguarded"] != 0), "{note}");
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
        // Counts of audits, and what they are held against.
        ("carried.units_sizes", "report", "guard carried_results_audited"),
        // Computed on the way to the report.
        ("score.total", "report", "guard scores_add_up"),
        // What the paper printed.
        ("printed.sec3_edges", "published.toml", "claim sec3_edges"),
        ("printed.sec2_onset", "published.toml", "report: published.toml:"),
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
fn all_are_guarded() {
    let (code, text, note) = mutate(&[]);
    assert_eq!(code, 0, "{note}");
    // Each number that is used has its line.
    let lines = text.lines().filter(|line| line.starts_with("guarded ")).count();
    assert!(text.contains(&format!("\n{lines} numbers: {lines} guarded, 0 not")), "{text}");
    assert!(lines > 50, "{text}");
    let (code, text, note) = mutate(&["--value", "nobody"]);
    assert_eq!((code, text.as_str()), (2, ""), "{note}");
}
