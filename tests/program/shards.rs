//! Work shared out to several machines gives the bytes of one, and nothing else is taken for it.

use crate::{
    EXPERIMENTS, Files, QUICK, TEMPLATES, files, forged, json, killed, program, put, refused, run,
};
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

const MERGE: &str = "merge --profile quick --results joined 1 2 3";

fn shard(folder: &Path, i: usize) -> (i32, String, String) {
    run(folder, &format!("run --profile quick --shard {i}/3 --out {i} --threads {i}"))
}

/// What three shards do, in another order and on other numbers of threads.
static SHARDS: LazyLock<[Files; 3]> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    for i in [3, 1, 2] {
        let (code, text, note) = shard(folder.path(), i);
        assert_eq!(code, 0, "{text}{note}");
    }
    [1, 2, 3].map(|i| files(&folder.path().join(i.to_string())))
});

/// A folder with the three shards, complete.
fn complete() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (i, shard) in SHARDS.iter().enumerate() {
        put(&folder.path().join((i + 1).to_string()), shard);
    }
    folder
}

fn plan(folder: &Path, more: &str) -> serde_json::Value {
    json(folder, &format!("plan --profile quick --json{more}"))
}

/// A run that succeeds, whatever it says.
fn fine(folder: &Path, arguments: &str) -> String {
    let (code, text, note) = run(folder, arguments);
    assert_eq!(code, 0, "{arguments}: {text}{note}");
    text + &note
}

#[test]
fn merged_shards_are_the_bytes_of_one_machine() {
    let folder = complete();
    let folder = folder.path();
    let (one, shards) = (&QUICK.results, &*SHARDS);
    // Each unit of the plan in its shard, and nothing else.
    let listed = plan(folder, " --shards 3");
    let units = listed["units"].as_array().unwrap();
    let (_, table, _) = run(folder, "plan --profile quick --shards 3");
    let head: Vec<&str> = table.lines().next().unwrap().split_whitespace().collect();
    assert_eq!(head, ["unit", "shard", "weight", "covers"]);
    assert_eq!(table.lines().count(), units.len() + 2, "{table}");
    for (i, shard) in shards.iter().enumerate() {
        let of = |unit: &&serde_json::Value| unit["shard"] == i + 1;
        let names =
            units.iter().filter(of).map(|u| format!("{}.json", u["unit"].as_str().unwrap()));
        let mut names: Vec<String> = names.collect();
        names.sort();
        assert_eq!(names, shard.keys().cloned().collect::<Vec<_>>());
        assert!(names.len() > 5, "{names:?}");
    }
    assert!(units.len() > 60 && units.iter().any(|unit| unit["experiment"] == "bias"));
    let (_, table, _) = run(folder, "plan --profile quick --experiment two_masses");
    assert!(table.contains("\n1 unit, about "), "{table}");
    // Logs beside the units are nobody's concern.
    fs::write(folder.join("2/array-7_2.log"), "a log").unwrap();
    fine(folder, MERGE);
    assert!(files(&folder.join("joined")) == *one);
    fine(folder, "status --profile quick --results joined");
    let paper = format!("paper --profile quick --out r --results joined --templates {TEMPLATES}");
    assert_eq!(fine(folder, &paper).matches(": fresh").count(), EXPERIMENTS);
    // All in one folder, by one shard of one.
    fine(folder, "run --profile quick --shard 1/1 --out all");
    fine(folder, "merge --profile quick --results again all");
    assert!(files(&folder.join("again")) == *one);
}

/// With one experiment changed, no other need be run again.
#[test]
fn experiments_that_are_named_are_run_and_joined_alone() {
    let folder = complete();
    let folder = folder.path();
    let own = plan(folder, " --experiment scale,bias");
    let units = own["units"].as_array().unwrap();
    let among =
        |unit: &serde_json::Value| unit["experiment"] == "scale" || unit["experiment"] == "bias";
    let all = plan(folder, "");
    let of_all = all["units"].as_array().unwrap().iter().filter(|unit| among(unit)).count();
    assert!(!units.is_empty() && units.iter().all(among) && units.len() == of_all, "{own:#}");
    // What is run alone is what a run of everything gives.
    let run_alone =
        "run --profile quick --shard 1/1 --out alone --experiment scale --experiment bias";
    let told = format!("alone: shard 1/1: {of_all} units run, 0 fresh\n");
    assert!(fine(folder, run_alone).starts_with(&told));
    let merge = "merge --profile quick --experiment bias,scale --results";
    fine(folder, &format!("{merge} alone-joined alone"));
    let joined = files(&folder.join("alone-joined"));
    assert_eq!(joined.keys().collect::<Vec<_>>(), ["bias-quick.json", "scale-quick.json"]);
    assert!(joined.iter().all(|(name, bytes)| *bytes == QUICK.results[name]));
    // Units of others are passed over; what is no unit at all is still refused.
    fine(folder, &format!("{merge} some 1 2 3"));
    assert!(files(&folder.join("some")) == joined);
    fs::write(folder.join("2/strange-quick.json"), "{}").unwrap();
    assert_eq!(run(folder, &format!("{merge} some 1 2 3")).0, 2);
    let (code, _, note) = run(folder, &format!("{merge} some 1"));
    assert_eq!(code, 3, "{note}");
    assert!(note.contains("plan --profile quick --experiment bias,scale --shards N"), "{note}");
    for verb in ["plan", "run --shard 1/1 --out x", "merge 1"] {
        let arguments = format!("{verb} --profile quick --experiment sweep,swoop");
        refused(folder, &arguments, &["no experiment \"swoop\"; give some of sweep, "]);
    }
}

#[test]
fn a_shard_goes_on_where_it_was() {
    let folder = complete();
    let folder = folder.path();
    let second = &SHARDS[1];
    assert_eq!(shard(folder, 2).1, format!("2: shard 2/3: no unit run, {} fresh\n", second.len()));
    let mut names = second.keys();
    let (gone, cut) = (names.next().unwrap(), names.next().unwrap());
    fs::remove_file(folder.join("2").join(gone)).unwrap();
    fs::write(folder.join("2").join(cut), &second[cut][..second[cut].len() / 2]).unwrap();
    let left = plan(folder, " --shards 3 --left 1 2 3 never-there");
    assert_eq!(left["units"].as_array().unwrap().len(), 2, "{left:#}");
    let array = "plan --profile quick --shards 3 --array --left";
    assert_eq!(run(folder, &format!("{array} 1 2 3")).1, "2\n");
    assert_eq!(run(folder, &format!("{array} 2")).1, "1-3\n");
    for verb in [format!("{array} ."), "merge --profile quick --results new .".into()] {
        refused(folder, &verb, &[".: units of work are in ./1 and not in it"]);
    }
    let (code, text, note) = shard(folder, 2);
    assert_eq!(text, format!("2: shard 2/3: 2 units run, {} fresh\n", second.len() - 2), "{note}");
    assert_eq!(code, 0);
    assert!(note.contains("cut short"), "{note}");
    assert!(files(&folder.join("2")) == *second);
    assert_eq!(run(folder, &format!("{array} 1 2 3")).1, "");
}

/// Killed without a chance to tidy up, at many moments, a shard loses no unit that it saved.
#[test]
fn a_killed_shard_leaves_whole_units() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let second = &SHARDS[1];
    let mut before = 0;
    for wait in [5, 30, 80, 150, 300, 300] {
        killed(&mut program(folder, "run --profile quick --shard 2/3 --out 2"), wait);
        let now = files(&folder.join("2"));
        assert!(now.iter().all(|(name, bytes)| *bytes == second[name]), "after {wait} ms");
        assert!(now.len() >= before, "after {wait} ms");
        before = now.len();
    }
    assert_eq!(shard(folder, 2).0, 0);
    assert!(files(&folder.join("2")) == *second);
}

/// The change of a unit, and what merge says.
type Case<'a> = (&'a dyn Fn(&Path, &[u8]), &'a str);

#[test]
fn what_is_not_one_whole_set_is_refused_by_name() {
    let folder = complete();
    let folder = folder.path();
    // A unit of the sweep, wherever it is.
    let name = "sweep-quick-0007.json";
    let place = SHARDS.iter().position(|shard| shard.contains_key(name)).unwrap();
    let whole = &SHARDS[place][name];
    let path = folder.join((place + 1).to_string()).join(name);
    let shown = format!("{}/{name}", place + 1);
    let other = folder.join(((place + 1) % 3 + 1).to_string());
    let forge = |line: usize, from: &'static str, to: &'static str| {
        move |path: &Path, bytes: &[u8]| {
            fs::write(path, forged(bytes, line, from, to)).unwrap();
        }
    };
    let simulation = "\"crates/impact-chain/src/simulation.rs\":\"";
    let other_simulation = "\"crates/impact-chain/src/simulation.rs\":\"0";
    let cut = |path: &Path, bytes: &[u8]| fs::write(path, &bytes[..bytes.len() - 9]).unwrap();
    let gone = |path: &Path, _: &[u8]| fs::remove_file(path).unwrap();
    let cases: [Case; 6] = [
        (&gone, "missing units of work: sweep-quick-0007;"),
        (&cut, "cut short"),
        (&forge(1, simulation, other_simulation), "crates/impact-chain/src/simulation.rs changed"),
        (&forge(1, "\"number\":7", "\"number\":8"), "another unit of work"),
        // One realisation less, and a count that no chain has: the parts would not join.
        (&forge(2, "\"distinct\":[", "\"distinct\":[3,"), "saved in another form"),
        (
            &|path, _| fs::write(path, "{}").unwrap(),
            "result; move away what is none, and run its shard again",
        ),
    ];
    for (change, says) in cases {
        change(&path, whole);
        let (code, text, note) = run(folder, MERGE);
        assert_eq!((code, text.as_str()), (3, ""), "{says}: {note}");
        assert_eq!(note.lines().count(), 1, "{note}");
        assert!(note.contains(says) && note.contains("; "), "{says}: {note}");
        assert!(!note.contains("overwritten"), "{note}");
        assert!(note.contains(&shown) || says.contains("missing"), "{note}");
        assert!(!folder.join("joined").exists(), "{says}");
        fs::write(&path, whole).unwrap();
    }
    // A unit twice, otherwise: which is right?
    let old = forged(whole, 1, simulation, other_simulation);
    fs::write(other.join(name), old).unwrap();
    let (code, _, note) = run(folder, MERGE);
    assert_eq!(code, 2, "{note}");
    assert!(note.contains("sweep-quick-0007 is in ") && note.contains(&shown), "{note}");
    assert_eq!(note.matches(name).count(), 2, "{note}");
    assert!(!folder.join("joined").exists());
    fs::remove_file(other.join(name)).unwrap();
    // A whole shard, and one of another number of shards.
    let (code, _, note) = run(folder, "merge --profile quick --results joined 1 3");
    assert_eq!(code, 3, "{note}");
    assert!(note.contains(" more; `impact-paper plan --profile quick"), "{note}");
    let lost = "merge --profile quick --results joined 1 2 3 never-there";
    refused(folder, lost, &["never-there: "]);
    assert!(!folder.join("joined").exists());
    fine(folder, MERGE);
    assert!(files(&folder.join("joined")) == QUICK.results);
}
