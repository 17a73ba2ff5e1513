//! The paper of the manual's first page, made as its reader would make it.

#[allow(dead_code)]
#[path = "../examples/walk/main.rs"]
mod walk;

use literate::cli::whole;
use literate::experiments::{Profile, Progress, Session, Store};
use std::path::Path;

#[test]
fn the_paper_of_the_manual_is_what_it_says() {
    let paper = walk::paper();
    let prose = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/walk/prose");
    let (store, progress) = (Store::nowhere(), Progress::silent());
    let session = Session::of(&paper, Some(&prose), Profile::Quick, store, progress).unwrap();
    let (report, checks) = whole(&session, Path::new("paper")).unwrap();
    assert!(checks.len() == 1 && !checks[0].fails(), "{checks:?}");
    for file in ["report.md", "report.tex", "figures/spread.svg", "data/walk-reached.csv"] {
        assert!(report.committed.contains_key(file), "{file}");
    }

    let manual = include_str!("../src/manual.md");
    let code = include_str!("../examples/walk/main.rs").replace("examples/walk", "src");
    let prose = include_str!("../examples/walk/prose/report.md");
    for part in [code.as_str(), prose, include_str!("../examples/walk/prose/published.toml")] {
        assert!(manual.contains(part), "the manual differs from the example: {part}");
    }
    assert!(code.lines().count() <= 60, "as the manual says");
}
