//! `impact-paper paper` and `check` as a user meets them: what runs, what is written, what is not.

mod program;

use program::{TEMPLATES, told};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The program in a folder of its own, with the templates of the project.
fn program(folder: &Path, arguments: &str) -> Command {
    program::program(folder, &format!("{arguments} --templates {TEMPLATES}"))
}

fn run(folder: &Path, arguments: &str) -> (i32, String, String) {
    told(&program(folder, arguments).output().unwrap())
}

/// All files below a folder, hidden ones included.
fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    fn walk(root: &Path, folder: &Path, into: &mut BTreeMap<String, Vec<u8>>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(root, &path, into);
            } else {
                let name = path.strip_prefix(root).unwrap().to_str().unwrap().to_string();
                into.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    let mut files = BTreeMap::new();
    walk(folder, folder, &mut files);
    files
}

#[test]
fn a_schematic_and_a_closed_form_run_no_simulation() {
    let folder = tempfile::tempdir().unwrap();
    for number in [4, 11] {
        let (code, told, note) = run(folder.path(), &format!("paper --figure {number} --out f"));
        assert_eq!((code, note.as_str()), (0, ""), "{told}");
        assert!(told.starts_with("f: ") && told.contains(" files in "), "{told}");
        let picture = folder.path().join(format!("f/figures/fig{number:02}.svg"));
        assert!(picture.is_file());
        assert!(!folder.path().join("target").exists(), "nothing was run and saved");
    }
}

#[test]
fn only_the_figure_that_was_asked_for_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (code, ..) = run(folder.path(), "paper --profile quick --figure 3 --out f --results r");
    assert_eq!(code, 0);
    let written = tree(&folder.path().join("f"));
    assert!(written.contains_key("figures/fig03.svg"), "{:?}", written.keys());
    assert!(written.keys().all(|name| name.contains("fig03")), "{:?}", written.keys());
    let saved: Vec<String> = tree(&folder.path().join("r")).into_keys().collect();
    assert!(saved.len() == 1 && saved[0].starts_with("sweep-"), "{saved:?}");
}

#[test]
fn threads_and_saved_results_change_no_byte_and_lesser_profiles_replace_no_full_report() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for (out, results, threads) in [("one", "r1", 1), ("four", "r4", 4)] {
        let (code, _, note) = run(
            folder.path(),
            &format!("paper --profile quick --out {out} --results {results} --threads {threads}"),
        );
        assert_eq!(code, 0, "{note}");
    }
    let report = tree(&at("one"));
    assert!(report.contains_key("report.md") && report.len() > 40, "{:?}", report.keys());
    assert!(report == tree(&at("four")), "1 and 4 threads differ");
    let saved = tree(&at("r1"));
    assert_eq!(saved, tree(&at("r4")));

    // Again: nothing is run, nothing changes, not even the saved files' times.
    let times = |name: &str| -> Vec<_> {
        let files = std::fs::read_dir(at(name)).unwrap().map(|file| file.unwrap().path());
        let mut times: Vec<_> =
            files.map(|f| (f.clone(), f.metadata().unwrap().modified().unwrap())).collect();
        times.sort();
        times
    };
    let before = times("r1");
    let (code, told, _) = run(folder.path(), "paper --profile quick --out one --results r1");
    assert_eq!((code, times("r1")), (0, before));
    assert!(told.contains("no value differs from"), "{told}");
    assert!(report == tree(&at("one")));

    // A damaged result is told and run again, to the same bytes.
    let name = saved.keys().find(|name| name.starts_with("protocol-")).unwrap();
    std::fs::write(at("r1").join(name), &saved[name][..saved[name].len() / 2]).unwrap();
    let (code, _, note) = run(folder.path(), "paper --profile quick --out one --results r1");
    assert_eq!(code, 0);
    assert!(note.contains("cut short"), "{note}");
    assert!(report == tree(&at("one")) && saved == tree(&at("r1")));

    // check takes the same saved results.
    let (code, told, note) = run(folder.path(), "check --profile quick --results r1");
    assert_eq!(code, i32::from(told.contains("FAILS")), "{note}");
    assert!(told.contains(" statements of the paper: "), "{told}");
    assert!(saved == tree(&at("r1")));

    // Over a report of the full profile a lesser one is refused, a figure of it too.
    let values = String::from_utf8(report["values.json"].clone()).unwrap();
    let full = values.replace("\"text\": \"quick\"", "\"text\": \"full\"");
    assert_ne!(full, values);
    std::fs::write(at("one/values.json"), full).unwrap();
    let before = tree(&at("one"));
    for arguments in ["--profile quick", "--profile ci", "--profile quick --figure 4"] {
        let (code, told, note) = run(folder.path(), &format!("paper {arguments} --out one"));
        assert_eq!((code, told.as_str()), (2, ""), "{note}");
        assert!(note.contains("full profile") && note.trim_end().lines().count() == 1, "{note}");
    }
    assert!(before == tree(&at("one")));
}

#[test]
fn ctrl_c_leaves_nothing_half_written() {
    let folder = tempfile::tempdir().unwrap();
    let mut child = program(folder.path(), "paper --figure 3 --out paper --results r --threads 2")
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    assert_eq!(child.try_wait().unwrap(), None, "the full profile takes minutes");
    let asked = Instant::now();
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(kill.success());
    let code = child.wait().unwrap().code();
    assert_eq!(code, Some(130));
    assert!(asked.elapsed() < Duration::from_secs(10), "{:?}", asked.elapsed());
    assert!(!folder.path().join("paper").exists());
    assert_eq!(tree(&folder.path().join("r")).len(), 0);
}

#[test]
fn bad_input_gets_one_line_and_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("file"), "").unwrap();
    for (arguments, field) in [
        ("paper --figure 16", "--figure"),
        ("paper --figure 0", "--figure"),
        ("paper --figure x", "--figure"),
        ("paper --profile deep", "--profile"),
        ("paper --threads 0 --figure 4", "--threads"),
        ("paper --figure 4 --out file", "--out"),
        ("paper --figure 4 --out file/below", "--out"),
        ("paper --profile quick --figure 3 --results file", "--results"),
        ("check --claim no-such-claim", "--claim"),
        ("check --profile quick --results file", "--results"),
    ] {
        let (code, told, note) = run(folder.path(), arguments);
        assert_eq!((code, told.as_str()), (2, ""), "{arguments}: {note}");
        assert_eq!(note.trim_end().lines().count(), 1, "{arguments}: {note}");
        assert!(note.contains(field), "{arguments}: {note}");
    }
    let missing = Command::new(env!("CARGO_BIN_EXE_impact-paper"))
        .current_dir(folder.path())
        .args(["paper", "--templates", "nowhere"])
        .output()
        .unwrap();
    assert_eq!(missing.status.code(), Some(2));
    assert!(String::from_utf8(missing.stderr).unwrap().contains("nowhere"));
}

#[test]
fn one_claim_runs_no_more_than_it_needs() {
    let folder = tempfile::tempdir().unwrap();
    let templates = concat!(env!("CARGO_MANIFEST_DIR"), "/templates/published.toml");
    let published = std::fs::read_to_string(templates).unwrap();
    let published = impact_paper::claims::Published::parse(&published).unwrap();
    let exact = published
        .statements
        .iter()
        .find(|statement| impact_paper::claims::needs(&statement.id).is_empty())
        .unwrap();
    let (code, told, _) = run(folder.path(), &format!("check --claim {}", exact.id));
    assert_eq!(code, 0, "{told}");
    assert!(told.contains(&exact.id) && told.contains("1 claim: "), "{told}");
    assert!(!folder.path().join("target").exists());
}
