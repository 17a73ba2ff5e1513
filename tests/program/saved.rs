//! Saved results: never stale, never half, whatever happens to the program or the disk.

use crate::{EXPERIMENTS, Files, PROGRAM, TEMPLATES, files, program, run, told};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::LazyLock;
use std::time::Duration;

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

/// All results of the quick profile, as an undisturbed run saves them.
static RESULTS: LazyLock<Files> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let (code, _, note) = run(folder.path(), PAPER);
    let results = saved(folder.path());
    assert_eq!((code, results.len()), (0, EXPERIMENTS), "{note}");
    // Whom the umask allows may read them.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let plain = folder.path().join("plain");
        std::fs::write(&plain, "").unwrap();
        let mode = |path: &Path| path.metadata().unwrap().permissions().mode();
        let result = folder.path().join("results/sweep-quick.json");
        assert_eq!(mode(&result), mode(&plain));
    }
    results
});

/// A folder with all of them.
fn whole() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("results")).unwrap();
    for (name, bytes) in RESULTS.iter() {
        std::fs::write(folder.path().join("results").join(name), bytes).unwrap();
    }
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

    let (folder, results) = (whole(), &*RESULTS);
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
    let forge = |name: &str, from: &str, to: &str| {
        let text = String::from_utf8(results[name].clone()).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let identity = lines[1].replacen(from, to, 1);
        assert_ne!(identity, lines[1], "{name} has no {from}");
        let text = format!("{}\n{identity}\n{}\n", digest(&[&identity, lines[2]]), lines[2]);
        std::fs::write(folder.join("results").join(name), text).unwrap();
    };
    let simulation = "\"src/dynamics/simulation.rs\":\"";
    forge("horizon-quick.json", simulation, "\"src/dynamics/simulation.rs\":\"0");
    forge("starts-quick.json", "\"lock\":\"", "\"lock\":\"0");
    forge("scale-quick.json", "\"seed\":", "\"seed\":1");
    forge("race-quick.json", "\"schema\":", "\"schema\":9");
    let protocol = folder.join("results/protocol-quick.json");
    std::fs::write(&protocol, &results["protocol-quick.json"][..1000]).unwrap();
    std::fs::remove_file(folder.join("results/trials-quick.json")).unwrap();
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
    assert_eq!(horizon["changed"], serde_json::json!(["src/dynamics/simulation.rs"]));
    // The next run says why, runs these six and no other, and all is as before.
    let (_, _, note) = run(folder, PAPER);
    assert_eq!(note.matches(": fresh").count(), EXPERIMENTS - 6, "{note}");
    for line in [
        "horizon: run (src/dynamics/simulation.rs changed)",
        "starts: run (Cargo.lock changed)",
        "scale: run (other parameters)",
        "race: run (saved in another form)",
        "protocol: run (the saved result is cut short or has lines too many)",
        "trials: run (no saved result)",
    ] {
        assert!(note.contains(line), "{line}: {note}");
    }
    assert!(saved(folder) == *results);

    // A result that the code does not give, with everything else right: only an audit finds it.
    let text = String::from_utf8(results["analytic-quick.json"].clone()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let digit = lines[2].rfind(|c: char| c.is_ascii_digit()).unwrap();
    let other = if &lines[2][digit..=digit] == "1" { "2" } else { "1" };
    let body = format!("{}{other}{}", &lines[2][..digit], &lines[2][digit + 1..]);
    let text = format!("{}\n{}\n{body}\n", digest(&[lines[1], &body]), lines[1]);
    std::fs::write(folder.join("results/analytic-quick.json"), text).unwrap();
    assert_eq!(status(folder)["fresh"], true);
    let (code, text, note) = run(folder, &format!("{audit} 100%"));
    assert_eq!(code, 1, "{text}{note}");
    assert!(text.contains("analytic: differs") && note.contains("analytic"), "{text}{note}");
}

fn digest(lines: &[&str]) -> String {
    use sha2::{Digest, Sha256};
    let text: String = lines.iter().flat_map(|line| [*line, "\n"]).collect();
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// What the deep profile gave is committed: carried over as long as its audit finds no fault.
#[test]
fn a_committed_result_is_carried_over_until_its_audit_fails() {
    let (folder, results) = (whole(), &*RESULTS);
    let folder = folder.path();
    let deep = folder.join("deep");
    std::fs::create_dir(&deep).unwrap();
    let committed = files(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/deep")));
    for (name, bytes) in &committed {
        std::fs::write(deep.join(name), bytes).unwrap();
    }
    let text = String::from_utf8(committed["long_protocol-deep.json"].clone()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let put = |identity: &str, body: &str| {
        let text = format!("{}\n{identity}\n{body}\n", digest(&[identity, body]));
        std::fs::write(deep.join("long_protocol-deep.json"), text).unwrap();
    };
    let asked = || {
        let (code, text, _) = run(folder, "status --profile deep --results deep --json");
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        let lines = json["experiments"].as_array().unwrap();
        assert_eq!(lines.len(), committed.len());
        (code, lines.iter().find(|line| line["experiment"] == "long_protocol").unwrap().clone())
    };
    // Other code is no reason against it; other parameters are, and damage.
    put(&lines[1].replacen("engine.rs\":\"", "engine.rs\":\"0", 1), lines[2]);
    let (code, line) = asked();
    assert_eq!((code, &line["carried"], &line["code"]), (0, &true.into(), &true.into()), "{line}");
    put(&lines[1].replacen("\"seed\":", "\"seed\":1", 1), lines[2]);
    let (code, line) = asked();
    let told = (&line["carried"], &line["parameters"]);
    assert_eq!((code, told), (3, (&false.into(), &true.into())), "{line}");
    std::fs::write(deep.join("long_protocol-deep.json"), &text[..1000]).unwrap();
    let (code, line) = asked();
    assert_eq!((code, &line["damaged"]), (3, &true.into()), "{line}");

    // A sample that gave other counts than were committed makes it stale, and the check red.
    let name = "long_protocol-quick.json";
    let audit = String::from_utf8(results[name].clone()).unwrap();
    let lines: Vec<&str> = audit.lines().collect();
    let body = lines[2].replacen("\"identical\"", "\"failed\"", 1);
    assert_ne!(body, lines[2], "{body}");
    let audit = format!("{}\n{}\n{body}\n", digest(&[lines[1], &body]), lines[1]);
    std::fs::write(folder.join("results").join(name), audit).unwrap();
    assert_eq!(with(&status(folder), "failed"), ["long_protocol"]);
    let check = format!("check --profile quick --results results --templates {TEMPLATES}");
    let (code, text, note) = run(folder, &check);
    assert_eq!(code, 1, "{note}");
    assert!(
        text.contains(
            "FAILS guard carried_results_audited: the committed result long_protocol is stale"
        ),
        "{text}"
    );
}

/// Killed without a chance to tidy up, at many moments.
#[test]
fn a_killed_run_leaves_nothing_that_is_read() {
    let results = &*RESULTS;
    let folder = tempfile::tempdir().unwrap();
    for wait in [5, 20, 60, 150, 400, 900] {
        let mut child = program(folder.path(), PAPER)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(wait));
        let _ = child.kill();
        child.wait().unwrap();
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
    let results = &*RESULTS;
    let folder = tempfile::tempdir().unwrap();
    let limited = format!("trap '' XFSZ; ulimit -f 1; exec {PROGRAM} {PAPER}");
    let output = Command::new("bash").args(["-c", &limited]).current_dir(folder.path()).output();
    let (code, _, note) = told(&output.unwrap());
    assert_eq!(code, 4, "{note}");
    let last = note.lines().last().unwrap();
    assert!(last.contains("results/") && last.contains("--results"), "{note}");
    let names: Vec<_> = std::fs::read_dir(folder.path().join("results")).unwrap().collect();
    assert!(names.is_empty(), "{names:?}");
    run(folder.path(), PAPER);
    assert!(saved(folder.path()) == *results);
}

#[test]
fn two_runs_at_once_do_not_disturb_each_other() {
    let results = &*RESULTS;
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
    let (folder, results) = (whole(), &*RESULTS);
    let folder = folder.path();
    let set = |path: &Path, mode: u32| {
        std::fs::set_permissions(path, std::fs::Permissions::from_mode(mode)).unwrap();
    };
    // Who may do anything may write everywhere: the program runs as nobody then.
    let mine = Command::new("id").arg("-u").output().unwrap().stdout == b"0\n";
    let as_reader = || {
        let mut command = if mine {
            let mut command = Command::new("setpriv");
            command.args(["--reuid=65534", "--regid=65534", "--clear-groups"]);
            let program = folder.join("program");
            if !program.exists() {
                std::fs::copy(PROGRAM, &program).unwrap();
            }
            command.arg(program);
            command
        } else {
            Command::new(PROGRAM)
        };
        command.current_dir(folder).args(PAPER.replace("report", "open/report").split(' '));
        told(&command.output().unwrap())
    };
    // What the program reads when it runs, for one that lies in no checkout.
    let benches = concat!(env!("CARGO_MANIFEST_DIR"), "/benches");
    let status = Command::new("cp").args(["-r", benches, "."]).current_dir(folder).status();
    assert!(status.unwrap().success());
    std::fs::create_dir(folder.join("open")).unwrap();
    set(&folder.join("open"), 0o777);
    set(folder, 0o755);
    set(&folder.join("results"), 0o555);
    let (code, _, note) = as_reader();
    assert_eq!(code, 0, "{note}");
    assert_eq!(note.matches(": fresh").count(), EXPERIMENTS, "{note}");
    set(&folder.join("results"), 0o755);
    std::fs::remove_file(folder.join("results/second_seed-quick.json")).unwrap();
    set(&folder.join("results"), 0o555);
    let (code, _, note) = as_reader();
    assert_eq!(code, 2, "{note}");
    assert!(note.contains("--results") && !note.contains("second seed:"), "{note}");
    set(&folder.join("results"), 0o755);
    run(folder, PAPER);
    assert!(saved(folder) == *results);
}
