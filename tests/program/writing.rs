//! What `impact-paper` writes over, and what it leaves as it is.

use crate::paper::{refused, run};
use crate::{QUICK, TEMPLATES, digest, templates, tree};

/// Whatever writes, writes over nothing that it did not make itself.
#[test]
fn what_others_made_is_left_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::create_dir_all(here.join("t/figures")).unwrap();
    for results in ["r", "s", "u"] {
        std::fs::create_dir(here.join(results)).unwrap();
    }
    let listed = format!("{}  report.md\n", "0".repeat(64));
    // Its first line is as long as a digest.
    let notes = format!("{:.<64}\nof worth", "# Notes of March");
    for (name, text) in [
        ("README.md", "by hand"),
        ("t/report.md", "by hand"),
        ("t/figures/fig04.svg", "by hand"),
        ("t/SHA256SUMS", listed.as_str()),
        ("r/sweep-quick.json", "{\"by\": \"hand\"}"),
        ("s/sweep-quick.json", notes.as_str()),
        ("u/sweep-quick.json", "12345"),
    ] {
        std::fs::write(here.join(name), text).unwrap();
    }
    let before = tree(here);
    for (arguments, says) in [
        ("paper --profile quick --out .", "--out: ."),
        ("paper --figure 4 --out t", "--out: t"),
        ("paper --figure 4 --out t/figures", "fig04.svg"),
        ("paper --profile quick --out t", "did not make"),
    ] {
        refused(here, arguments, &[says]);
    }
    for results in ["r", "s", "u"] {
        let foreign = format!("{results}/sweep-quick.json: it stands where a saved result belongs");
        let paper = format!("paper --profile quick --figure 3 --out f --results {results}");
        let (code, _, note) = crate::run(here, &paper);
        assert!(code == 2 && note.contains(&foreign) && note.lines().count() == 1, "{note}");
    }
    assert!(tree(here) == before, "{:?}", tree(here).keys());
    // Forced, it says what it wrote over, and a folder of its own is written again without.
    let (code, _, note) = run(here, "paper --figure 4 --out t --force");
    assert!(code == 0 && note.contains("wrote over figures/fig04.svg"), "{note}");
    assert_eq!(run(here, "paper --figure 4 --figure 5 --out t").0, 0);
    assert_eq!(std::fs::read_to_string(here.join("t/report.md")).unwrap(), "by hand");
}

/// Who edits the list of a report makes no file of somebody else the program's; what goes with a report is named.
#[test]
fn lists_by_hand_take_no_file_away() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("p"), &QUICK.report);
    crate::put(&here.join("r"), &QUICK.results);
    crate::put(here, &[("outside".into(), Vec::new())].into());
    crate::put(&here.join("p"), &[(".git/config".into(), Vec::new())].into());
    let list = String::from_utf8(QUICK.report["SHA256SUMS"].clone()).unwrap();
    let paper = "paper --profile quick --out p --results r";
    for path in [".git/config", "../outside", "/outside", "data/../.git/config"] {
        let more = format!("{list}{}  {path}\n", digest(""));
        std::fs::write(here.join("p/SHA256SUMS"), more).unwrap();
        let before = tree(here);
        refused(here, paper, &["--out: p/SHA256SUMS: ", &format!("{path:?}"), "--force"]);
        assert!(tree(here) == before, "{path}");
    }
    let more = format!("{list}{}  old.md\n", digest(""));
    crate::put(
        &here.join("p"),
        &[("SHA256SUMS".into(), more.into()), ("old.md".into(), Vec::new())].into(),
    );
    let (code, _, note) = run(here, paper);
    assert!(code == 0 && note.contains("removed 1 file of the report before: old.md"), "{note}");
    assert!(here.join("p/.git/config").exists() && !here.join("p/old.md").exists());
}

/// A report without readable values is written anew by whom asks for it, as `verify` advises.
#[test]
fn a_report_without_values_is_written_anew_when_forced() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("r"), &QUICK.results);
    crate::put(&here.join("v"), &QUICK.report);
    let paper = "paper --profile quick --out v --results r";
    let values = here.join("v/values.json");
    std::fs::write(&values, "{}").unwrap();
    refused(here, paper, &["values.json cannot be read; --force writes the report anew"]);
    let (code, _, note) = run(here, &format!("{paper} --force"));
    assert!(code == 0 && note.contains("--force: wrote over values.json"), "{note}");
    assert!(tree(&here.join("v")) == QUICK.report);
    std::fs::remove_file(&values).unwrap();
    refused(here, paper, &["values.json cannot be read; --force writes the report anew"]);
    assert_eq!(run(here, &format!("{paper} --force")).0, 0);
    assert!(tree(&here.join("v")) == QUICK.report);
}

/// What is written among the templates would be read as prose.
#[test]
fn nothing_is_written_among_the_templates() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    templates(&here.join("t"), "front.md", |text| text.into());
    // Also from within, where nobody names them.
    for within in [here.join("t"), here.join("t/methods")] {
        crate::refused(&within, "paper --profile quick", &["change to the checkout"]);
    }
    for (verb, among) in [
        ("paper --figure 4 --templates t --out", "t"),
        ("paper --profile quick --templates t --out new --results", "t"),
        ("run --profile quick --shard 1/1 --results", TEMPLATES),
    ] {
        let (code, _, note) = crate::run(here, &format!("{verb} {among}"));
        let what = format!("{among} is the folder of the templates, or lies in it");
        assert!(code == 2 && note.contains(&what) && note.lines().count() == 1, "{verb}: {note}");
    }
}
