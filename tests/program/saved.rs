//! Tests that saved results are never stale or half, and that shared work has the same bytes.

use crate::*;
use std::collections::BTreeSet;
use std::time::Duration;

fn together() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    QUICK.shards.iter().for_each(|shard| put(&folder.path().join("results"), shard));
    folder
}

/// Joins what is in `results`, and returns standard error.
fn joined(folder: &Path) -> String {
    let [_, note] = ends(folder, "run --profile quick --results results", 0, &[]);
    assert!(files(&folder.join("results")) == QUICK.results, "{note}");
    note
}

/// What `paper --dry-run` says of results, a line for each experiment that would be run.
fn stale(folder: &Path, results: &str) -> String {
    let dry = format!("paper --profile quick --dry-run --results {results}");
    let (code, text, _) = outcome(&mut program(folder, &dry));
    assert_eq!(code, i32::from(!text.is_empty()), "{text}");
    text
}

#[test]
fn each_reason_is_told_and_nothing_else_is_run_again() {
    let (folder, results) = (tempfile::tempdir().unwrap(), &QUICK.results);
    let folder = folder.path();
    assert_eq!(stale(folder, "nowhere").lines().count(), EXPERIMENTS);
    assert!(!folder.join("nowhere").exists());
    put(&folder.join("results"), results);
    // What another program, another Cargo.lock and other parameters would have left here. The
    // checksum is right, so only what the result was made of tells.
    let code = "\"code\":{";
    let mut expected = Vec::new();
    for (name, from, more, reason) in [
        ("race", "\"schema\":", "9", "saved in an older format"),
        ("two_masses", code, "\"Cargo.loc\":\"0\",", "Cargo.loc changed"),
        ("horizon", code, "\"src/gone.rs\":\"0\",", "src/gone.rs changed"),
        ("scale", "\"sigma\":", "1", "other parameters"),
    ] {
        let file = format!("{name}-quick.json");
        let forgery = forged(&results[&file], 1, from, &format!("{from}{more}"));
        fs::write(folder.join("results").join(file), forgery).unwrap();
        expected.push(format!("{name}: run again, {reason}"));
    }
    let trials = folder.join("results/trials-quick.json");
    fs::write(trials, &results["trials-quick.json"][..1000]).unwrap();
    expected.push("trials: run again, the saved result is cut short or has extra lines".into());
    fs::remove_file(folder.join("results/seeds-quick.json")).unwrap();
    expected.push("seeds: run".into());
    let message = stale(folder, "results");
    let reasons: BTreeSet<&str> = message.lines().collect();
    assert_eq!(reasons, expected.iter().map(String::as_str).collect());
    // One of them is run again, and no other.
    for (name, bytes) in results.iter().filter(|(name, _)| !name.starts_with("horizon")) {
        fs::write(folder.join("results").join(name), bytes).unwrap();
    }
    let note = joined(folder);
    assert_eq!(note.matches(": fresh").count(), EXPERIMENTS - 1, "{note}");
    assert!(note.contains(&expected[2]), "{note}");
}

#[test]
fn shards_in_one_folder_are_joined_once() {
    let folder = together();
    let folder = folder.path();
    let units: usize = QUICK.shards.iter().map(Files::len).sum();
    assert!(units > 60 && QUICK.shards.iter().all(|shard| shard.len() > units / 6), "{units}");
    assert_eq!(files(&folder.join("results")).len(), units, "each in one shard");
    assert!(stale(folder, "results").contains("sweep: run; 18 of 18 units there\n"));
    let note = joined(folder);
    assert!(!note.contains("run again") && note.contains("sweep: 18 of 18 units there"), "{note}");
    // Now all is joined, and neither a shard nor a whole run has anything to do.
    assert_eq!(stale(folder, "results"), "");
    let [_, note] = shard(folder, 1, "results");
    assert!(!note.contains(": run"), "{note}");
    let note = joined(folder);
    assert!(!note.contains(": run") && !note.contains("to run"), "{note}");
}

#[test]
fn a_unit_that_is_missing_or_not_to_be_used_is_run_again() {
    let folder = together();
    let folder = folder.path();
    let path = folder.join("results/sweep-quick-0007.json");
    let whole = fs::read(&path).unwrap();
    for (bytes, says) in [
        (None, None),
        (Some(whole[..whole.len() - 9].into()), Some("the saved result is cut short")),
        (Some(forged(&whole, 1, "\"number\":7", "\"number\":8")), Some("another unit of work")),
        (Some(forged(&whole, 2, "[", "[[")), Some("saved in an older format")),
    ] {
        match bytes {
            Some(bytes) => fs::write(&path, bytes).unwrap(),
            None => fs::remove_file(&path).unwrap(),
        }
        let has = |shard: &Files| shard.contains_key("sweep-quick-0007.json");
        let i = QUICK.shards.iter().position(has).unwrap() + 1;
        let there = QUICK.shards[i - 1].len() - 1;
        let [out, note] = shard(folder, i, "results");
        assert_eq!(out, format!("results: shard {i}/3: 1 unit run, {there} already saved\n"));
        let line = says.map(|says| format!("sweep: 1 unit run again, {says}"));
        assert!(line.is_none_or(|line| note.contains(&line)), "{says:?}: {note}");
        assert!(fs::read(&path).unwrap() == whole);
    }
    fs::write(&path, &whole[..100]).unwrap();
    let note = joined(folder);
    assert_eq!(note.matches("run again").count(), 1, "{note}");
}

/// Killed at several moments, a run loses no unit that it saved, and goes on in `verify`.
#[test]
fn a_killed_run_goes_on_to_the_bytes_of_shards() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for wait in [100, 700] {
        let mut command = program(folder, "-q run --profile quick --results results");
        let mut child = command.spawn().unwrap();
        std::thread::sleep(Duration::from_millis(wait));
        let _ = child.kill();
        child.wait().unwrap();
        for (name, bytes) in files(&folder.join("results")) {
            let unit = QUICK.shards.iter().find_map(|shard| shard.get(&name));
            assert!(unit.or(QUICK.results.get(&name)) == Some(&bytes), "{name} after {wait} ms");
        }
    }
    // By the profile that the report names, on one thread.
    put(&folder.join("report"), &QUICK.report);
    let verify = "verify report --rerun --threads 1 --results results --templates @";
    let [out, note] = ends(folder, verify, 0, &[": run"]);
    assert!(!note.contains("run again"), "{note}");
    assert!(out.contains("made again with the quick profile, the same bytes"), "{out}");
    assert!(files(&folder.join("results")) == QUICK.results);
}

/// Starts a Slurm on this machine (root installs it when missing), and stops it.
#[test]
#[ignore = "starts a Slurm, and runs the full profile twice"]
fn a_job_array_with_a_killed_task_gives_the_bytes_of_one_machine() {
    let folder = tempfile::tempdir().unwrap();
    let cluster = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/cluster");
    let mut command = Command::new(cluster.join("with-slurm"));
    command.arg(cluster.join("trial")).arg(PROGRAM).arg(folder.path());
    let (code, text, note) = ended_with(&command.output().unwrap());
    assert!(code == 0 && text.contains("killed task 2"), "{text}{note}");
    let made = |results: &str| -> Vec<_> {
        let paper = format!("paper --out report --results {results} --templates @");
        let [_, note] = ends(folder.path(), &paper, 0, &[]);
        assert!(results == "local" || !note.contains("run again"), "{note}");
        let sum = |(name, bytes): (String, Vec<u8>)| (name, sha256(bytes));
        files(&folder.path().join(results)).into_iter().map(sum).collect()
    };
    let joined = made("results");
    assert_eq!(joined.len(), EXPERIMENTS);
    assert_eq!(joined, made("local"));
}
