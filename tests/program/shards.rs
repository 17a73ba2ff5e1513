//! Work shared out to several machines gives the bytes of one, whatever happens to one of them.

use crate::{EXPERIMENTS, Files, QUICK, TEMPLATES, files, forged, killed, program, put, run};
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// One of three shards, into a folder of its own or a common one.
fn shard(folder: &Path, i: usize, results: &str) -> (String, String) {
    let line = format!("run --profile quick --shard {i}/3 --results {results} --threads {i}");
    let (code, text, note) = run(folder, &line);
    assert_eq!(code, 0, "{text}{note}");
    (text, note)
}

/// What three shards save, in another order and on other numbers of threads.
static SHARDS: LazyLock<[Files; 3]> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    for i in [3, 1, 2] {
        shard(folder.path(), i, &i.to_string());
    }
    [1, 2, 3].map(|i| files(&folder.path().join(i.to_string())))
});

/// All of them copied into the folder `results`.
fn together() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    SHARDS.iter().for_each(|shard| put(&folder.path().join("results"), shard));
    folder
}

/// Joins what is in `results`, which is then what one machine saves; what is said meanwhile.
fn joined(folder: &Path) -> String {
    let paper = "paper --profile quick --out report --results results --templates";
    let (code, text, note) = run(folder, &format!("{paper} {TEMPLATES}"));
    assert_eq!(code, 0, "{text}{note}");
    assert!(files(&folder.join("results")) == QUICK.results, "{note}");
    note
}

#[test]
fn shards_in_one_folder_give_the_bytes_of_one_machine() {
    let folder = together();
    let folder = folder.path();
    let units: usize = SHARDS.iter().map(Files::len).sum();
    assert!(units > 60 && SHARDS.iter().all(|shard| shard.len() > units / 6), "{units}");
    assert_eq!(files(&folder.join("results")).len(), units, "each in one shard");
    let note = joined(folder);
    assert!(!note.contains("run again") && note.contains("sweep: 18 of 18 units there"), "{note}");
    // Now all is joined, and no shard has anything to do.
    for verb in [1, 2, 3].map(|i| format!("run --shard {i}/3")).iter().chain(["run".into()].iter())
    {
        let (code, text, note) = run(folder, &format!("{verb} --profile quick --results results"));
        assert_eq!(code, 0, "{text}{note}");
        assert!(!note.contains(": run"), "{text}{note}");
    }
    assert!(files(&folder.join("results")) == QUICK.results);
    // The same by `run` alone.
    run(folder, "run --profile quick --results alone");
    assert!(files(&folder.join("alone")) == QUICK.results);
}

#[test]
fn a_unit_that_is_missing_or_not_to_be_used_is_run_again() {
    let folder = together();
    let folder = folder.path();
    let path = folder.join("results/sweep-quick-0007.json");
    let whole = fs::read(&path).unwrap();
    let simulation = "\"crates/impact-chain/src/simulation.rs\":\"";
    let other = "\"crates/impact-chain/src/simulation.rs\":\"0";
    for (bytes, says) in [
        (None, None),
        (Some(whole[..whole.len() - 9].into()), Some("the saved result is cut short")),
        (Some(forged(&whole, 1, simulation, other)), Some("crates/impact-chain/src/simulation.rs")),
        (Some(forged(&whole, 1, "\"number\":7", "\"number\":8")), Some("another unit of work")),
        (Some(forged(&whole, 2, "[", "[[")), Some("saved in another form")),
    ] {
        match bytes {
            Some(bytes) => fs::write(&path, bytes).unwrap(),
            None => fs::remove_file(&path).unwrap(),
        }
        let place = SHARDS.iter().position(|shard| shard.contains_key("sweep-quick-0007.json"));
        let (i, there) = (place.unwrap() + 1, SHARDS[place.unwrap()].len() - 1);
        let (text, note) = shard(folder, i, "results");
        assert_eq!(text, format!("results: shard {i}/3: 1 unit run, {there} there before\n"));
        let line = says.map(|says| format!("sweep: 1 unit run again, {says}"));
        assert!(line.is_none_or(|line| note.contains(&line)), "{says:?}: {note}");
        assert!(fs::read(&path).unwrap() == whole);
    }
    fs::write(&path, &whole[..100]).unwrap();
    let note = joined(folder);
    assert_eq!(note.matches("run again").count(), 1, "{note}");
}

/// Killed without a chance to tidy up, at many moments, a shard loses no unit that it saved, nor does a whole run.
#[test]
fn a_killed_run_goes_on_where_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for verb in ["run --shard 2/3", "run"] {
        for wait in [5, 30, 80, 150, 300, 300] {
            killed(
                &mut program(folder, &format!("{verb} --profile quick --results results")),
                wait,
            );
            for (name, bytes) in files(&folder.join("results")) {
                let unit = SHARDS.iter().find_map(|shard| shard.get(&name));
                assert!(
                    unit.or(QUICK.results.get(&name)) == Some(&bytes),
                    "{name} after {wait} ms"
                );
            }
        }
    }
    let note = joined(folder);
    assert!(!note.contains("run again"), "{note}");
}

#[test]
fn a_dry_run_says_what_would_be_run() {
    let folder = together();
    let folder = folder.path();
    let dry = |results: &str| {
        let (code, text, _) =
            run(folder, &format!("paper --profile quick --dry-run --results {results}"));
        assert_eq!(code, if text.is_empty() { 0 } else { 1 }, "{text}");
        text
    };
    assert_eq!(dry("nowhere").lines().count(), EXPERIMENTS);
    assert!(dry("results").contains("sweep: run; 18 of 18 units there\n"));
    joined(folder);
    assert_eq!(dry("results"), "");
    assert!(!folder.join("nowhere").exists());
}
