//! `impact-paper verify`: what a folder says of itself, held against what stands in it.

use crate::{QUICK, TEMPLATES, answer, digest, put, run};
use std::fs;

/// The unit tests of `report::folder` have the faults.
#[test]
fn a_rerun_finds_what_the_list_cannot() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let templates = format!("--templates {TEMPLATES}");
    put(&here.join("r"), &QUICK.report);
    put(&here.join("saved"), &QUICK.results);

    // Without saved results, by the profile that the report names, on another number of threads.
    let (code, told, note) = run(here, &format!("verify r --rerun --threads 1 {templates}"));
    assert_eq!(code, 0, "{told}{note}");
    assert!(note.contains("sweep: run\n"), "{note}");
    assert!(told.contains("made again with the quick profile, the same bytes"), "{told}");

    // A forger who keeps the list right.
    let edit = |name: &str, change: &dyn Fn(String) -> String| {
        let path = here.join("r").join(name);
        fs::write(&path, change(fs::read_to_string(&path).unwrap())).unwrap();
    };
    let before = fs::read_to_string(here.join("r/data/fig02.csv")).unwrap();
    edit("data/fig02.csv", &|text| format!("{text}9\n"));
    edit("report.html", &|text| format!("{text} "));
    fs::write(here.join("r/data/more.csv"), "").unwrap();
    let (old, new) = (digest(&before), digest(format!("{before}9\n")));
    let more = format!("{}  data/more.csv\n", digest(""));
    edit("SHA256SUMS", &|list| list.replace(&old, &new) + &more);
    assert!(answer(here, "verify r").ends_with(" files, all as SHA256SUMS lists them\n"));
    let (code, told, note) = run(here, &format!("verify r --rerun --results saved {templates}"));
    assert_eq!(code, 1, "{told}{note}");
    assert!(note.contains("4 files; `paper --out r --force`"), "{note}");
    let lines: Vec<&str> = told.lines().skip(1).collect();
    let names = ["differs  SHA256SUMS", "differs  data/fig02.csv", "differs  report.html"];
    let names = names.into_iter().chain(["unlisted data/more.csv"]);
    assert_eq!(lines, names.map(|name| format!("rerun: {name}")).collect::<Vec<_>>());
}
