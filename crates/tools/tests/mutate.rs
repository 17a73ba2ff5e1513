//! `impact-paper-tools mutate`: a number that is wrong is noticed by the check that should, and a number that
//! nobody would miss needs a reason.

use std::path::Path;
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

/// The project's templates with one file changed, in a folder of its own.
fn templates(name: &str, change: impl Fn(&str) -> String) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let source = Path::new(ROOT).join("templates");
    let status = Command::new("cp").arg("-r").arg(source).arg(folder.path().join("t")).status();
    assert!(status.unwrap().success());
    let file = folder.path().join("t").join(name);
    let text = std::fs::read_to_string(&file).unwrap();
    let changed = change(&text);
    assert_ne!(text, changed);
    std::fs::write(&file, changed).unwrap();
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
fn a_number_that_nobody_would_miss_is_listed() {
    let (code, text, note) =
        mutate(&["--value", "printed.sec5_masses_of_circuit", "--value", "score.total"]);
    assert_eq!(code, 1, "{text}");
    assert!(
        text.contains("UNGUARDED printed.sec5_masses_of_circuit")
            && text.contains("guarded   score.total"),
        "{text}"
    );
    assert!(text.contains("2 numbers: 1 guarded, 1 not, 1 of these without a reason"), "{text}");
    assert!(
        note.contains(
            "printed.sec5_masses_of_circuit; guard them, or give a reason in unguarded.toml"
        ),
        "{note}"
    );
    let (code, text, note) = mutate(&["--value", "nobody"]);
    assert_eq!((code, text.as_str()), (2, ""), "{note}");
}

#[test]
fn all_are_guarded_or_have_a_reason_that_they_need() {
    let (code, text, note) = mutate(&[]);
    assert_eq!(code, 0, "{note}");
    assert!(!text.contains("UNGUARDED") && text.contains("excused, readings of words: "), "{text}");
    // Each number that is used has its line.
    let lines = text.lines().filter(|line| line.contains(" ± ")).count();
    assert!(text.contains(&format!("\n{lines} numbers: ")) && lines > 50, "{text}");

    // A reason is taken away: its number is told.
    let missing = templates("unguarded.toml", |text| {
        text.replacen("\"printed.sec5_masses_of_circuit\"", "", 1)
    });
    let (code, text, note) = with(&missing, &[]);
    assert_eq!(code, 1, "{note}");
    assert!(
        text.contains("UNGUARDED printed.sec5_masses_of_circuit")
            && note.contains(": printed.sec5_masses_of_circuit;"),
        "{note}"
    );

    // Reasons without need: of a number that is guarded, and of one that is not there.
    let needless = templates("unguarded.toml", |text| {
        text.replacen(
            "\"printed.sec5_masses_of_circuit\"",
            "\"printed.sec5_masses_of_circuit\", \"printed.sec3_vertices\", \"printed.sec3_vertix\"",
            1,
        )
    });
    let (code, _, note) = with(&needless, &[]);
    assert_eq!(code, 1, "{note}");
    assert!(note.contains("\"printed.sec3_vertices\" (guarded)"), "{note}");
    assert!(note.contains("\"printed.sec3_vertix\" (there is no such value)"), "{note}");
    let empty = templates("unguarded.toml", |text| text.replacen("why = \"", "why = \"\" #", 1));
    let (code, _, note) = with(&empty, &[]);
    assert!(code == 2 && note.contains("unguarded.toml: no reason for"), "{note}");
}
