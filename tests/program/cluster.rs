//! A job array on a real Slurm gives the bytes of one machine, even if a task is killed on its way.

use crate::{EXPERIMENTS, Files, PROGRAM, TEMPLATES, files, run};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// SHA-256 of each saved result, by name.
fn sums(files: Files) -> BTreeMap<String, String> {
    let sum = |bytes: Vec<u8>| Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect();
    files.into_iter().map(|(name, bytes)| (name, sum(bytes))).collect()
}

/// Starts munged, slurmctld and slurmd on this machine (root installs them when missing), and stops
/// them. Half a minute in a release build, most of it the profile ci twice.
#[test]
#[ignore = "starts a Slurm, and runs the profile ci twice"]
fn a_job_array_with_a_killed_task_gives_the_bytes_of_one_machine() {
    let folder = tempfile::tempdir().unwrap();
    let cluster = Path::new(ROOT).join("benches/cluster");
    let output = Command::new(cluster.join("with-slurm"))
        .arg(cluster.join("trial"))
        .arg(PROGRAM)
        .arg(folder.path())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let note = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}{note}");
    for line in ["killed task 2 of job", "missing units of work", "resubmitted task 2 alone"] {
        assert!(text.contains(line), "{text}{note}");
    }
    let paper = "paper --profile ci --out report --results local --templates";
    let (code, _, note) = run(folder.path(), &format!("{paper} {TEMPLATES}"));
    assert_eq!(code, 0, "{note}");
    let made = |name: &str| sums(files(&folder.path().join(name)));
    let merged = made("results");
    assert_eq!(merged.len(), EXPERIMENTS);
    assert_eq!(merged, made("local"));
}
