//! Saved results: never stale, never half, whatever happens to the program or the disk.

use crate::{EXPERIMENTS, Files, PROGRAM, QUICK, TEMPLATES, files, forged, outcome, put, run};
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

/// A folder with all results of the quick profile.
fn whole() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    put(&folder.path().join("results"), &QUICK.results);
    folder
}

#[test]
fn each_reason_is_told_and_nothing_else_is_run_again() {
    let (folder, results) = (whole(), &QUICK.results);
    let folder = folder.path();
    let (_, _, note) = run(folder, PAPER);
    assert_eq!(note.matches(": fresh").count(), EXPERIMENTS, "{note}");
    assert_eq!(saved(folder), *results);
    // What another program, another Cargo.lock and other parameters would have left here. The
    // checksum is right, so only what the result was made of tells.
    let forge = |name: &str, line: usize, from: &str, to: &str| {
        let text = forged(&results[name], line, from, to);
        fs::write(folder.join("results").join(name), text).unwrap();
    };
    let simulation = "\"crates/impact-chain/src/simulation.rs\":\"";
    forge("horizon-quick.json", 1, simulation, "\"crates/impact-chain/src/simulation.rs\":\"0");
    forge("starts-quick.json", 1, "\"Cargo.lock\":\"", "\"Cargo.lock\":\"0");
    forge("scale-quick.json", 1, "\"sigma\":", "\"sigma\":1");
    forge("race-quick.json", 1, "\"schema\":", "\"schema\":9");
    let protocol = folder.join("results/protocol-quick.json");
    fs::write(&protocol, &results["protocol-quick.json"][..1000]).unwrap();
    fs::remove_file(folder.join("results/trials-quick.json")).unwrap();
    let (_, _, note) = run(folder, PAPER);
    assert_eq!(note.matches(": fresh").count(), EXPERIMENTS - 6, "{note}");
    for (experiment, told) in [
        ("horizon", " again, crates/impact-chain/src/simulation.rs changed"),
        ("starts", " again, Cargo.lock changed"),
        ("scale", " again, other parameters"),
        ("race", " again, saved in another form"),
        ("protocol", " again, the saved result is cut short or has lines too many"),
        ("trials", ""),
    ] {
        assert!(note.contains(&format!("{experiment}: run{told}\n")), "{told}: {note}");
    }
    assert!(saved(folder) == *results);
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

/// Results in a folder that cannot be written are used.
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
    assert!(note.contains("--results"), "{note}");
    set(&folder.join("results"), 0o755);
    run(folder, PAPER);
    assert!(saved(folder) == *results);
}
