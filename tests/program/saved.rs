//! Saved results: never stale, never half, whatever happens to the program or the disk.

use crate::{
    EXPERIMENTS, Files, PROGRAM, QUICK, TEMPLATES, files, forged, killed, outcome, program, put,
    run,
};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// Needs every experiment that is saved.
const PAPER: &str = concat!(
    "paper --profile quick --out report --results results --templates ",
    env!("CARGO_MANIFEST_DIR"),
    "/templates"
);

/// Saved results by name.
fn saved(folder: &Path) -> Files {
    files(&folder.join("results"))
}

fn status(folder: &Path) -> serde_json::Value {
    let (code, text, _) = run(folder, "status --profile quick --results results --json");
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(code, if json["fresh"] == true { 0 } else { 3 }, "{text}");
    json
}

/// Names of the experiments for which this reason is given.
fn with(json: &serde_json::Value, reason: &str) -> Vec<String> {
    let all = json["experiments"].as_array().unwrap();
    let named = |line: &serde_json::Value| line["experiment"].as_str().unwrap().to_string();
    all.iter().filter(|line| line[reason] == true).map(named).collect()
}

/// A folder with all results of the quick profile.
fn whole() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    put(&folder.path().join("results"), &QUICK.results);
    folder
}

#[test]
fn status_gives_each_reason_and_audit_compares_bytes() {
    let empty = tempfile::tempdir().unwrap();
    let json = status(empty.path());
    assert_eq!((with(&json, "missing").len(), with(&json, "fresh").len()), (EXPERIMENTS, 0));
    assert!(!empty.path().join("results").exists(), "status makes nothing");
    let (code, _, note) = run(empty.path(), "audit --profile quick --results results");
    assert_eq!(code, 3, "{note}");
    assert!(note.contains("nothing to audit"), "{note}");

    let (folder, results) = (whole(), &QUICK.results);
    let folder = folder.path();
    assert_eq!(with(&status(folder), "fresh").len(), EXPERIMENTS);
    let (_, _, note) = run(folder, PAPER);
    assert_eq!(note.matches(": fresh").count(), EXPERIMENTS, "{note}");
    assert_eq!(saved(folder), *results);
    let audit = "audit --profile quick --results results --sample";
    let (code, text, note) = run(folder, &format!("{audit} 100%"));
    assert_eq!((code, text.matches(": identical").count()), (0, EXPERIMENTS), "{text}{note}");
    let (_, text, _) = run(folder, &format!("{audit} 0.1"));
    assert_eq!(text.lines().count(), EXPERIMENTS.div_ceil(10), "{text}");
    assert_eq!(run(folder, &format!("{audit} 0%")).0, 2);
    assert_eq!(saved(folder), *results, "an audit saves nothing");

    // What another program, another Cargo.lock and other parameters would have left here. The
    // checksum is right, so only what the result was made of tells.
    let forge = |name: &str, line: usize, from: &str, to: &str| {
        let text = forged(&results[name], line, from, to);
        fs::write(folder.join("results").join(name), text).unwrap();
    };
    let simulation = "\"crates/impact-chain/src/simulation.rs\":\"";
    forge("horizon-quick.json", 1, simulation, "\"crates/impact-chain/src/simulation.rs\":\"0");
    forge("starts-quick.json", 1, "\"lock\":\"", "\"lock\":\"0");
    forge("scale-quick.json", 1, "\"seed\":", "\"seed\":1");
    forge("race-quick.json", 1, "\"schema\":", "\"schema\":9");
    let protocol = folder.join("results/protocol-quick.json");
    fs::write(&protocol, &results["protocol-quick.json"][..1000]).unwrap();
    fs::remove_file(folder.join("results/trials-quick.json")).unwrap();
    let json = status(folder);
    for (reason, experiment) in [
        ("code", "horizon"),
        ("dependency", "starts"),
        ("parameters", "scale"),
        ("schema", "race"),
        ("damaged", "protocol"),
        ("missing", "trials"),
    ] {
        assert_eq!(with(&json, reason), [experiment], "{json:#}");
    }
    let horizon =
        json["experiments"].as_array().unwrap().iter().find(|e| e["code"] == true).unwrap();
    assert_eq!(horizon["changed"], serde_json::json!(["crates/impact-chain/src/simulation.rs"]));
    // The next run says why, runs these six and no other, and all is as before.
    let (_, _, note) = run(folder, PAPER);
    assert_eq!(note.matches(": fresh").count(), EXPERIMENTS - 6, "{note}");
    for line in [
        "horizon: run (crates/impact-chain/src/simulation.rs changed)",
        "starts: run (Cargo.lock changed)",
        "scale: run (other parameters)",
        "race: run (saved in another form)",
        "protocol: run (the saved result is cut short or has lines too many)",
        "trials: run (no saved result)",
    ] {
        assert!(note.contains(line), "{line}: {note}");
    }
    assert!(saved(folder) == *results);

    // With the line ends of another system one is damaged and run again; what was never one is left, as both say.
    let path = folder.join("results/two_masses-quick.json");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace('\n', "\r\n")).unwrap();
    assert_eq!(with(&status(folder), "damaged"), ["two_masses"]);
    assert_eq!(run(folder, PAPER).0, 0);
    assert!(saved(folder) == *results);
    fs::write(&path, "{}\n").unwrap();
    let (_, told, _) = run(folder, "status --profile quick --results results");
    let (code, _, note) = run(folder, PAPER);
    for text in [told, note] {
        assert!(text.contains("this is no saved result"), "{text}");
    }
    assert_eq!((code, fs::read_to_string(&path).unwrap().as_str()), (2, "{}\n"));
    fs::write(&path, text).unwrap();

    // A result that the code does not give, with everything else right: only an audit finds it.
    let text = std::str::from_utf8(&results["analytic-quick.json"]).unwrap();
    let number = text
        .rsplit([',', ':'])
        .find_map(|end| end.split(|c: char| !c.is_ascii_digit()).find(|digits| digits.len() > 9))
        .unwrap();
    let other = format!("{}{}", if number.starts_with('1') { 2 } else { 1 }, &number[1..]);
    forge("analytic-quick.json", 2, number, &other);
    assert_eq!(status(folder)["fresh"], true);
    let (code, text, note) = run(folder, &format!("{audit} 100%"));
    assert_eq!(code, 1, "{text}{note}");
    assert!(text.contains("analytic: differs") && note.contains("analytic"), "{text}{note}");
}

/// What the deep profile gave is committed: carried over as long as its audit finds no fault.
#[test]
fn a_committed_result_is_carried_over_until_its_audit_fails() {
    let (folder, results) = (whole(), &QUICK.results);
    let folder = folder.path();
    let deep = folder.join("deep");
    let committed = files(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/deep")));
    put(&deep, &committed);
    let name = "long_protocol-deep.json";
    let change = |from: &str, to: &str| {
        fs::write(deep.join(name), forged(&committed[name], 1, from, to)).unwrap();
    };
    let asked = || {
        let (code, text, _) = run(folder, "status --profile deep --results deep --json");
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        let lines = json["experiments"].as_array().unwrap();
        assert_eq!(lines.len(), committed.len());
        (code, lines.iter().find(|line| line["experiment"] == "long_protocol").unwrap().clone())
    };
    // Other code is no reason against it; other parameters are, and damage.
    change("engine.rs\":\"", "engine.rs\":\"0");
    let (code, line) = asked();
    assert_eq!((code, &line["carried"], &line["code"]), (0, &true.into(), &true.into()), "{line}");
    change("\"seed\":", "\"seed\":1");
    let (code, line) = asked();
    let told = (&line["carried"], &line["parameters"]);
    assert_eq!((code, told), (3, (&false.into(), &true.into())), "{line}");
    fs::write(deep.join(name), &committed[name][..1000]).unwrap();
    let (code, line) = asked();
    assert_eq!((code, &line["damaged"]), (3, &true.into()), "{line}");

    // A sample that gave other counts than were committed makes it stale, and the check red.
    let name = "long_protocol-quick.json";
    let audit = forged(&results[name], 2, "\"identical\"", "\"failed\"");
    fs::write(folder.join("results").join(name), audit).unwrap();
    assert_eq!(with(&status(folder), "failed"), ["long_protocol"]);
    let check = format!("check --profile quick --results results --templates {TEMPLATES}");
    let (code, text, note) = run(folder, &check);
    assert_eq!(code, 1, "{note}");
    assert!(
        text.contains(
            "FAILS relation carried_results_audited: the committed result long_protocol is stale"
        ),
        "{text}"
    );
}

/// Killed without a chance to tidy up, at many moments.
#[test]
fn a_killed_run_leaves_nothing_that_is_read() {
    let results = &QUICK.results;
    let folder = tempfile::tempdir().unwrap();
    for wait in [5, 20, 60, 150, 400, 900] {
        killed(&mut program(folder.path(), PAPER), wait);
        for (name, bytes) in saved(folder.path()) {
            assert!(bytes == results[&name], "{name} after {wait} ms");
        }
        assert_eq!(with(&status(folder.path()), "damaged"), Vec::<String>::new());
    }
    run(folder.path(), PAPER);
    assert!(saved(folder.path()) == *results);
}

/// A disk on which no file can grow beyond a kilobyte.
#[test]
fn a_full_disk_is_told_and_leaves_nothing_half() {
    let results = &QUICK.results;
    let folder = tempfile::tempdir().unwrap();
    let limited = format!("ulimit -f 1; exec {PROGRAM} {PAPER}");
    let mut bash = Command::new("bash");
    let (code, _, note) = outcome(bash.args(["-c", &limited]).current_dir(folder.path()));
    assert_eq!(code, 4, "{note}");
    let last = note.lines().last().unwrap();
    assert!(last.contains("results/") && last.contains("ulimit -f"), "{note}");
    let names: Vec<_> = fs::read_dir(folder.path().join("results")).unwrap().collect();
    assert!(names.is_empty(), "{names:?}");
    run(folder.path(), PAPER);
    assert!(saved(folder.path()) == *results);
}

#[test]
fn two_runs_at_once_do_not_disturb_each_other() {
    let results = &QUICK.results;
    let folder = tempfile::tempdir().unwrap();
    let start = || {
        let mut command = program(folder.path(), PAPER);
        command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
    };
    let (mut one, mut other) = (start(), start());
    let codes = [one.wait().unwrap().code(), other.wait().unwrap().code()];
    assert_eq!(codes, [Some(0), Some(0)]);
    assert!(saved(folder.path()) == *results);
}

/// Results in a folder that cannot be written are used; what is missing there is told before it
/// is run.
#[test]
fn a_read_only_folder_is_read() {
    use std::os::unix::fs::PermissionsExt;
    let (folder, results) = (whole(), &QUICK.results);
    let folder = folder.path();
    let set = |path: &Path, mode: u32| {
        fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
    };
    // Who may do anything may write everywhere: the program runs as nobody then.
    let mine = Command::new("id").arg("-u").output().unwrap().stdout == b"0\n";
    let as_reader = || {
        let mut command = if mine {
            let mut command = Command::new("setpriv");
            command.args(["--reuid=65534", "--regid=65534", "--clear-groups"]);
            let program = folder.join("program");
            if !program.exists() {
                fs::copy(PROGRAM, &program).unwrap();
            }
            command.arg(program);
            command
        } else {
            Command::new(PROGRAM)
        };
        command.current_dir(folder);
        outcome(command.args(PAPER.replace("report", "open/report").split(' ')))
    };
    // What the program reads when it runs, for one that lies in no checkout.
    let benches = concat!(env!("CARGO_MANIFEST_DIR"), "/benches");
    let status = Command::new("cp").args(["-r", benches, "."]).current_dir(folder).status();
    assert!(status.unwrap().success());
    fs::create_dir(folder.join("open")).unwrap();
    set(&folder.join("open"), 0o777);
    set(folder, 0o755);
    set(&folder.join("results"), 0o555);
    let (code, _, note) = as_reader();
    assert_eq!(code, 0, "{note}");
    assert_eq!(note.matches(": fresh").count(), EXPERIMENTS, "{note}");
    set(&folder.join("results"), 0o755);
    fs::remove_file(folder.join("results/second_seed-quick.json")).unwrap();
    set(&folder.join("results"), 0o555);
    let (code, _, note) = as_reader();
    assert_eq!(code, 2, "{note}");
    assert!(note.contains("--results") && !note.contains("second seed:"), "{note}");
    set(&folder.join("results"), 0o755);
    run(folder, PAPER);
    assert!(saved(folder) == *results);
}
