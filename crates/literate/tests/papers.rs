//! The papers of `examples/`, made as their readers would make them.

#[allow(dead_code)]
#[path = "../examples/feigenbaum/main.rs"]
mod feigenbaum;

use literate::experiments::{Profile, Progress, Store};
use literate::input::sha256;
use literate::make_report;
use std::path::Path;
use std::process::Command;

#[test]
fn the_second_paper_is_made_and_its_run_is_used_again() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path());
    let paper = feigenbaum::paper();
    let prose = Some(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/feigenbaum"));
    let quiet = Progress::silent();
    let session = paper.session(prose.as_deref(), Profile::Full, store, quiet).unwrap();
    let (report, checks) = make_report(&paper, &session, Path::new("paper")).unwrap();
    assert!(checks.iter().all(|check| !check.fails()));
    let saved = folder.path().join("cascade-full.json");
    let written = || std::fs::metadata(&saved).unwrap().modified().unwrap();
    let first = written();
    assert!(report == make_report(&paper, &session, Path::new("paper")).unwrap().0);
    assert_eq!(written(), first, "it is run once");

    let text = |path: &str| String::from_utf8(report[path].clone()).unwrap();
    let markdown = text("report.md");
    for part in [
        "2 of 3 statements are reproduced, 1 differs and is",
        "| 1 | 3.236067977 | – | – |",
        "**Listing 1.** The search for the orbits.",
        "[convergence.csv](data/convergence.csv). Code: [main.rs](../examples/feigenbaum/main.rs)",
    ] {
        assert!(markdown.contains(part), "{part}: {markdown}");
    }
    // Where the two ratios are those of the last orbit, no logarithm has their distance.
    let data = text("data/convergence.csv");
    assert!(data.starts_with("series (text),n (1),distance from the last ratio (1)\ndelta,2,"));
    assert_eq!(data.lines().count(), 1 + 2 * 14, "{data}");
    assert!(text("data/cascade-orbits.csv").starts_with("n (1),parameter (1),delta (1),"));
    let ledger = text("ledger.json");
    assert_eq!(ledger.matches("\"reproduced\"").count(), 2, "{ledger}");
    assert_eq!(ledger.matches("\"differs and explained\"").count(), 1, "{ledger}");
    assert!(report.contains_key("report.html"));

    // The constants to the digits that the literature has: 4.669 201 609 102… and 2.502 907 875
    // 095….
    let cascade = feigenbaum::CASCADE.get(&session).unwrap();
    let tables = (feigenbaum::CASCADE.tables)(&cascade);
    let limit = |column: &str| tables[1].distinct(column).unwrap()[0];
    assert!((limit("delta") - 4.669_201_609_102_99).abs() < 1e-10, "{}", limit("delta"));
    assert!((limit("alpha") - 2.502_907_875_095_892).abs() < 1e-10, "{}", limit("alpha"));
    assert!((limit("onset") - 3.569_945_671_870_945).abs() < 1e-12, "{}", limit("onset"));
}

#[test]
#[ignore = "is a program that the next test starts"]
fn a_program() {
    let Ok(line) = std::env::var("LITERATE_LINE") else { return };
    let code = feigenbaum::paper().run(line.split(' ').map(Into::into).collect());
    std::process::exit(code.into());
}

/// The example as a program in a folder: exit code, standard output and standard error.
fn run(folder: &Path, line: &str) -> (i32, String, String) {
    let mut program = Command::new(std::env::current_exe().unwrap());
    program.args(["--ignored", "--exact", "a_program"]).current_dir(folder);
    let output = program.env("LITERATE_LINE", format!("feigenbaum {line}")).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

#[test]
fn the_advice_of_verify_works_as_it_is_printed() {
    let folder = tempfile::tempdir().unwrap();
    // The way to the project may have blanks.
    let prose = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/feigenbaum");
    std::fs::create_dir(folder.path().join("prose")).unwrap();
    for file in prose.read_dir().unwrap().map(Result::unwrap) {
        std::fs::copy(file.path(), folder.path().join("prose").join(file.file_name())).unwrap();
    }
    let made = |line: &str| run(folder.path(), &format!("{line} --templates prose"));
    assert_eq!(made("paper").0, 0);
    // A saved result that is wrong, and looks fresh.
    let saved = folder.path().join("target/results/cascade-full.json");
    let text = std::fs::read_to_string(&saved).unwrap();
    let [_, made_of, body, ""] = text.split('\n').collect::<Vec<_>>()[..] else { panic!("{text}") };
    let made_of = format!("{made_of}\n{}\n", body.replacen("3.2", "3.3", 1));
    std::fs::write(&saved, format!("{}\n{made_of}", sha256(&made_of))).unwrap();
    assert_eq!(made("paper").0, 0);
    let (code, out, note) = made("verify --rerun");
    assert!(code == 1 && out.contains("rerun: "), "{out}{note}");
    let advice = "paper --force --rerun all";
    assert!(note.contains(advice), "{note}");
    let (code, _, note) = made(advice);
    assert_eq!(code, 0, "{note}");
    let (code, out, note) = made("verify --rerun");
    assert_eq!(code, 0, "{out}{note}");
    let (code, _, note) = made("paper --rerun cascade");
    assert!(code == 0 && note.contains("cascade: run\n"), "{note}");
    let (code, _, note) = made("paper --rerun cascades");
    assert!(code == 2 && note.contains("no experiment \"cascades\"; nearest: cascade"), "{note}");
}
