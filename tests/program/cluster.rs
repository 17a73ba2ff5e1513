//! A job array on a real Slurm gives the bytes of one machine, even if a task is killed on its way.

use crate::{EXPERIMENTS, PROGRAM, TEMPLATES, digest, files, run};
use std::path::Path;
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Starts munged, slurmctld and slurmd on this machine (root installs them when missing), and stops
/// them. Some minutes, most of it the full profile twice.
#[test]
#[ignore = "starts a Slurm, and runs the full profile twice"]
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
    assert!(output.status.success() && text.contains("killed task 2"), "{text}{note}");
    let made = |results: &str| -> Vec<_> {
        let paper = format!("paper --out report --results {results} --templates {TEMPLATES}");
        let (code, _, said) = run(folder.path(), &paper);
        assert_eq!(code, 0, "{said}");
        assert!(results == "local" || !said.contains("run again"), "{said}");
        let sum = |(name, bytes): (String, Vec<u8>)| (name, digest(bytes));
        files(&folder.path().join(results)).into_iter().map(sum).collect()
    };
    let joined = made("results");
    assert_eq!(joined.len(), EXPERIMENTS);
    assert_eq!(joined, made("local"));
}
