//! A job array on a real Slurm gives the bytes of one machine, even if a task is killed on its way.

use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

const PROGRAM: &str = env!("CARGO_BIN_EXE_impact-paper");
const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// SHA-256 of each saved result in a folder, by name; what is made of all of them is no result.
fn sums(folder: &Path) -> BTreeMap<String, String> {
    let sum = |bytes: Vec<u8>| Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect();
    std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.file_name() != "mutations-ci.json")
        .map(|entry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            (name, sum(std::fs::read(entry.path()).unwrap()))
        })
        .collect()
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
    let templates = format!("{ROOT}/templates");
    let local = Command::new(PROGRAM)
        .current_dir(folder.path())
        .args(["paper", "--profile", "ci", "--out", "report", "--results", "local"])
        .args(["--templates", &templates])
        .output()
        .unwrap();
    assert!(local.status.success(), "{}", String::from_utf8_lossy(&local.stderr));
    let merged = sums(&folder.path().join("results"));
    assert_eq!(merged.len(), 12);
    assert_eq!(merged, sums(&folder.path().join("local")));
}
