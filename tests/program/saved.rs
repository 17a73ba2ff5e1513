//! Saved results: never stale, never half, whatever happens to the program or the disk.

use crate::{
    EXPERIMENTS, Files, PROGRAM, QUICK, TEMPLATES, files, forged, killed, outcome, program, put,
    run,
};
use std::fs;
use std::path::Path;
use std::process::Command;

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
    // The next run says why, runs these six and no other, and all is as before.
    let json = status(folder);
    let (_, _, note) = run(folder, PAPER);
    assert_eq!(note.matches(": fresh").count(), EXPERIMENTS - 6, "{note}");
    for (reason, experiment, told) in [
        ("code", "horizon", "crates/impact-chain/src/simulation.rs changed"),
        ("dependency", "starts", "Cargo.lock changed"),
        ("parameters", "scale", "other parameters"),
        ("schema", "race", "saved in another form"),
        ("damaged", "protocol", "the saved result is cut short or has lines too many"),
        ("missing", "trials", "no saved result"),
    ] {
        assert_eq!(with(&json, reason), [experiment], "{json:#}");
        assert!(note.contains(&format!("{experiment}: run ({told})")), "{told}: {note}");
    }
    assert!(saved(folder) == *results);

    // A result that the code does not give, with everything else right: only an audit finds it.
    let text = std::str::from_utf8(&results["horizon-quick.json"]).unwrap();
    let number = text
        .rsplit([',', ':'])
        .find_map(|end| end.split(|c: char| !c.is_ascii_digit()).find(|digits| digits.len() > 9))
        .unwrap();
    let other = format!("{}{}", if number.starts_with('1') { 2 } else { 1 }, &number[1..]);
    forge("horizon-quick.json", 2, number, &other);
    assert_eq!(status(folder)["fresh"], true);
    let (code, text, note) = run(folder, &format!("{audit} 100%"));
    assert_eq!(code, 1, "{text}{note}");
    assert!(text.contains("horizon: differs") && note.contains("horizon"), "{text}{note}");
}

/// What the deep profile gave is committed: carried over as long as its audit finds no fault. Why one is not is told by
/// the unit tests of `deep`.
#[test]
fn a_committed_result_is_carried_over_until_its_audit_fails() {
    let (folder, results) = (whole(), &QUICK.results);
    let folder = folder.path();
    let deep = folder.join("deep");
    put(&deep, &files(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/deep"))));
    let name = "long_protocol-deep.json";
    let committed = fs::read(deep.join(name)).unwrap();
    // Other code is no reason against it; other parameters are.
    for (from, to, carried) in
        [("engine.rs\":\"", "engine.rs\":\"0", true), ("\"seed\":", "\"seed\":1", false)]
    {
        fs::write(deep.join(name), forged(&committed, 1, from, to)).unwrap();
        let (code, text, _) = run(folder, "status --profile deep --results deep --json");
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(code, if carried { 0 } else { 3 }, "{text}");
        assert_eq!(with(&json, "carried").contains(&"long_protocol".into()), carried, "{text}");
        assert_eq!(with(&json, "parameters").is_empty(), carried, "{text}");
    }

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
    let paper = PAPER.replace(TEMPLATES, &format!("'{TEMPLATES}'"));
    let limited = format!("ulimit -f 1; exec '{PROGRAM}' {paper}");
    let mut bash = Command::new("bash");
    let (code, _, note) = outcome(bash.args(["-c", &limited]).current_dir(folder.path()));
    assert_eq!(code, 4, "{note}");
    let last = note.lines().last().unwrap();
    assert!(last.contains("results/") && last.contains("ulimit -f"), "{note}");
    assert!(!folder.path().join("results").exists());
    run(folder.path(), PAPER);
    assert!(saved(folder.path()) == *results);
}

#[test]
fn two_runs_at_once_do_not_disturb_each_other() {
    let folder = tempfile::tempdir().unwrap();
    std::thread::scope(|scope| {
        for one in [(); 2].map(|()| scope.spawn(|| run(folder.path(), PAPER))) {
            assert_eq!(one.join().unwrap().0, 0);
        }
    });
    assert!(saved(folder.path()) == QUICK.results);
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
    fs::copy(PROGRAM, folder.join("program")).unwrap();
    // Who may do anything may write everywhere: the program runs as nobody then.
    let root = Command::new("id").arg("-u").output().unwrap().stdout == b"0\n";
    let nobody = if root { "setpriv --reuid=65534 --regid=65534 --clear-groups" } else { "env" };
    let as_reader = || {
        let paper = PAPER.replace("report", "open/report").replace(TEMPLATES, "templates");
        let line = format!("exec {nobody} ./program {paper}");
        outcome(Command::new("bash").args(["-c", &line]).current_dir(folder))
    };
    // What the program reads when it runs: the checkout may lie where nobody else may go.
    let benches = concat!(env!("CARGO_MANIFEST_DIR"), "/benches");
    let status =
        Command::new("cp").args(["-r", benches, TEMPLATES, "."]).current_dir(folder).status();
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
