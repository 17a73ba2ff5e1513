//! `impact-paper diff`: two reports, by folder or by revision of git.

use crate::{PROGRAM, outcome, put, tree};
use std::fs;
use std::path::Path;
use std::process::Command;

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(PROGRAM);
    command.current_dir(folder).arg("diff").args(arguments);
    command
}

fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    outcome(&mut command(folder, arguments))
}

/// What the commands print that must not fail.
fn fine(folder: &Path, arguments: &[&str]) -> String {
    let (code, out, note) = run(folder, arguments);
    assert_eq!((code, note.as_str()), (0, ""), "{arguments:?}: {out}");
    out
}

/// The committed report twice, as `a` and as `b`.
fn twice() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a", "b"] {
        copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("paper"), &folder.path().join(name));
    }
    folder
}

fn copy(from: &Path, to: &Path) {
    put(to, &tree(from));
}

/// Replaces the first occurrence in a file.
fn edit(path: &Path, from: &str, to: &str) {
    let before = fs::read_to_string(path).unwrap();
    let after = before.replacen(from, to, 1);
    assert_ne!(before, after, "{from}");
    fs::write(path, after).unwrap();
}

/// Another number, verdict and datum, a lost file and a new one.
fn changed() -> tempfile::TempDir {
    let folder = twice();
    let at = |path: &str| folder.path().join("b").join(path);
    let json = |path: &str| -> serde_json::Value {
        serde_json::from_str(&fs::read_to_string(at(path)).unwrap()).unwrap()
    };
    let mut values = json("values.json");
    let error =
        values["sweep.rise.half_height"]["kind"]["ensemble"]["standard_error"].as_f64().unwrap();
    let value = &mut values["sweep.rise.half_height"]["number"]["real"]["value"];
    *value = (value.as_f64().unwrap() + 3.0 * error * 2f64.sqrt()).into();
    fs::write(at("values.json"), format!("{values:#}\n")).unwrap();
    let mut ledger = json("ledger.json");
    let claims = ledger["claims"].as_array_mut().unwrap();
    let claim = claims.iter_mut().find(|claim| claim["id"] == "sec2_half_height").unwrap();
    claim["verdict"] = "differs".into();
    claim["tolerance"] = "± 0.0001 | more".into();
    fs::write(at("ledger.json"), format!("{ledger:#}\n")).unwrap();
    edit(&at("data/fig12.csv"), "\ntheory,0.021,1\n", "\ntheory,0.021,0.75\n");
    fs::remove_file(at("data/fig07.csv")).unwrap();
    fs::write(at("data/new.csv"), "a\n1\n").unwrap();
    fs::write(at("report.html"), "built beside").unwrap();
    folder
}

#[test]
fn the_same_report_twice_differs_in_nothing() {
    let folder = twice();
    fs::write(folder.path().join("b/report.pdf"), "built beside").unwrap();
    assert_eq!(fine(folder.path(), &["a", "b"]), "a and b: nothing differs\n");
    assert!(fine(folder.path(), &["a", "b", "--markdown"]).contains("Nothing: "));
    let json: serde_json::Value =
        serde_json::from_str(&fine(folder.path(), &["a", "b", "--json"])).unwrap();
    assert_eq!(json["same"], true);
    assert_eq!(run(folder.path(), &["a", "b", "--exit-code"]).0, 0);
}

#[test]
fn number_verdict_and_files_are_told() {
    let folder = changed();
    let out = fine(folder.path(), &["a", "b"]);
    for line in [
        "  sec2_half_height: reproduced -> differs; tolerance: ± 0.005 -> ± 0.0001 | more\n",
        ", +3 σ\n",
        "  differs data/fig12.csv\n",
        "  new     data/new.csv\n",
        "  gone    data/fig07.csv\n",
        "  differs values.json\n",
    ] {
        assert!(out.contains(line), "{line}: {out}");
    }
    assert!(out.contains("1 claim changed\n") && out.contains("1 number changed\n"), "{out}");
    assert!(!out.contains("report.html"), "{out}");
    let (code, _, note) = run(folder.path(), &["a", "b", "--exit-code"]);
    assert_eq!((code, note.as_str()), (1, "impact-paper: a and b differ\n"));

    let markdown = fine(folder.path(), &["a", "b", "--markdown"]);
    assert_eq!(markdown, fine(folder.path(), &["a", "b", "--format", "markdown"]));
    for part in [
        "reproduced → differs",
        "| sweep.rise.half_height |",
        "± 0.005 → ± 0.0001 \\| more",
        "+3 |",
    ] {
        assert!(markdown.contains(part), "{part}: {markdown}");
    }
    let json: serde_json::Value =
        serde_json::from_str(&fine(folder.path(), &["a", "b", "--json"])).unwrap();
    let diff = &json["diff"];
    assert_eq!((&json["same"], &json["old"]), (&false.into(), &"a".into()));
    assert_eq!(diff["differing"][0], "data/fig12.csv");
    assert_eq!(diff["verdicts"][0]["after"], "differs");
    assert!((diff["numbers"][0]["sigmas"].as_f64().unwrap() - 3.0).abs() < 1e-9, "{diff}");
    assert_eq!(diff["lost"], serde_json::json!(["data/fig07.csv"]));
}

#[test]
fn words_are_told_and_moved_numbers_counted() {
    let folder = twice();
    let here = folder.path();
    let at = |path: &str| here.join("b").join(path);
    edit(&at("report.md"), "simulated a row of forced masses", "simulated a ~chain~ of masses");
    edit(&at("report.md"), "0.1159(4); the paper", "0.1162(5); the paper");
    fs::remove_file(at("beyond.md")).unwrap();
    let out = fine(here, &["a", "b"]);
    let told = "prose\n  1 sentence with other words, 1 with other numbers alone\n  Edition, Abstract\n    ";
    assert!(out.contains(told) && out.contains("  gone    beyond.md\n"), "{out}");
    assert!(out.contains(" simulated a [-row-]{+~chain~+} of [-forced-] masses that "), "{out}");

    let markdown = fine(here, &["a", "b", "--markdown"]);
    let told = "<summary>1 sentence with other words, 1 with other numbers alone</summary>\n\n- Edition, Abstract: ";
    assert!(markdown.contains(told) && markdown.contains("\n</details>\n"), "{markdown}");
    let words = " simulated a ~~row~~ **\\~chain\\~** of ~~forced~~ masses that ";
    assert!(markdown.contains(words), "{markdown}");
    let json: serde_json::Value =
        serde_json::from_str(&fine(here, &["a", "b", "--json", "--document", "edition"])).unwrap();
    let prose = &json["diff"]["prose"][0];
    assert_eq!((&prose["document"], &prose["numbers_alone"]), (&"Edition".into(), &1.into()));
    let pieces = &prose["sentences"][0]["pieces"];
    assert_eq!(pieces[1]["changed"], serde_json::json!(["row", "~chain~"]));

    fs::write(at("report.md"), [0xff]).unwrap();
    let (code, out, note) = run(here, &["a", "b"]);
    assert_eq!((code, out.as_str(), note.lines().count()), (2, "", 1), "{note}");
    assert!(note.starts_with("impact-paper: b: report.md: invalid utf-8"), "{note}");
}

#[test]
fn revisions_of_git_are_compared() {
    let folder = changed();
    let here = folder.path();
    let git = |arguments: &[&str]| {
        let mut command = Command::new("git");
        command.current_dir(here).args(["-c", "user.name=a", "-c", "user.email=a@b"]);
        assert!(command.args(arguments).output().unwrap().status.success(), "{arguments:?}");
    };
    git(&["init", "--quiet"]);
    for (tag, name) in [("v1", "a"), ("v2", "b")] {
        let _ = fs::remove_dir_all(here.join("sub/paper"));
        copy(&here.join(name), &here.join("sub/paper"));
        git(&["add", "--force", "sub"]);
        git(&["commit", "--quiet", "--message", tag]);
        git(&["tag", tag]);
    }
    // The folder paper/ is that of the folder where the program runs, wherever git's top is.
    let sub = here.join("sub");
    let strip = |text: String| text.replace("v1", "a").replace("v2", "b");
    let json = strip(fine(&sub, &["v1", "v2", "--json"]));
    assert_eq!(json, fine(here, &["a", "b", "--json"]));
    assert_eq!(fine(&sub, &["HEAD", "paper"]), "HEAD and paper: nothing differs\n");
    assert!(fine(&sub, &["HEAD~1", "../a"]).contains("nothing differs"));

    let (code, _, note) = run(here, &["v1", "a"]);
    assert_eq!(code, 2);
    assert!(note.contains("v1: this revision has no folder paper/"), "{note}");
    // What git itself says, where it knows better.
    let mut broken = command(&sub, &["v1", "paper"]);
    let (code, _, note) = outcome(broken.env("GIT_DIR", "nowhere"));
    assert!(code == 2 && note.contains("not a git repository: 'nowhere'"), "{note}");
    for odd in ["nothing", "v1:sub", "v1..v2", "", "v1 v2", "-v", "--output=x", "a/report.md"] {
        let (code, out, note) = run(&sub, &["--", odd, "paper"]);
        assert_eq!((code, out.as_str()), (2, ""), "{odd}: {note}");
        assert!(note.contains("neither a folder nor a revision"), "{odd}: {note}");
        assert_eq!(note.lines().count(), 1, "{odd}: {note}");
    }
    let (code, _, note) = outcome(command(&sub, &["v1", "v2"]).env("PATH", ""));
    assert_eq!(code, 2);
    assert!(note.contains("no git to ask") && note.lines().count() == 1, "{note}");
}

#[test]
fn what_is_no_report_gets_one_line() {
    let folder = twice();
    let here = folder.path();
    let at = |path: &str| here.join("b").join(path);
    let refused = |named: &str| {
        let (code, out, note) = run(here, &["a", "b"]);
        assert_eq!((code, out.as_str()), (2, ""), "{note}");
        assert!(note.starts_with(&format!("impact-paper: b: {named}")), "{named}: {note}");
        assert_eq!(note.lines().count(), 1, "{note}");
    };
    let keep = |path: &str| fs::read(at(path)).unwrap();
    for (path, bad) in [("values.json", "{\"a\": "), ("values.json", "[]"), ("ledger.json", "{}")] {
        let good = keep(path);
        fs::write(at(path), bad).unwrap();
        refused(path);
        fs::write(at(path), good).unwrap();
    }
    let good = keep("values.json");
    fs::remove_file(at("values.json")).unwrap();
    refused("values.json is missing");
    fs::write(at("values.json"), good).unwrap();
    std::os::unix::fs::symlink("/etc/passwd", at("data/link.csv")).unwrap();
    refused("data/link.csv: it is a link");
    for wrong in [&["a"][..], &["a", "b", "--json", "--markdown"], &["a", "b", "--format", "x"]] {
        assert_eq!(run(here, wrong).0, 2, "{wrong:?}");
    }
}
