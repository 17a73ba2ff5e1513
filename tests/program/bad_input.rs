//! Gives the program what people get wrong: one line names the field and the remedy.

use crate::{SCENARIO, folder, program};
use std::fs;
use std::process::Stdio;

/// Holds the program to refuse a scenario with one line that has all of `words`.
fn refused(scenario: impl AsRef<[u8]>, words: &[&str]) {
    crate::refused(folder(scenario).path(), "trace s.json --until 5", words);
}

fn with(field: &str) -> String {
    format!(r#"{{"forcing":[[0.9,-0.4]],{field}}}"#)
}

/// Texts, or a field with values between bars, and what is said.
const NO_SCENARIOS: &str = r##"{ => line 1
[] => scenario; a JSON object
[1,1,1.4] => scenario; a JSON object
{"a\nb":1} => a b
{"forcing":[[1,2]],"forcing":[[1,2]]} => forcing; duplicate
{"forcing":[[nan,1]]} => forcing[0][0]
{"forcing_frequencies":[1.4],"forcing":[[1,2]]} => forcing: its lists
{} => forcing; mass
{"forcing":[[1,2]]} {"forcing":[[1,2]]} => scenario; --lines
{"forcing":[[1,2,3]]} => forcing; [alpha, beta]
{"forcing":[[0,0],[0,-1e300]]} => forcing[1]
{"forcing":[[0,0],[0,0]],"initial":{"free":[[0.75,0],[-0.75,0]]}} => initial; gap 1; overlap
"sigma":1 => sigma; unknown
"restitution":NaN => line 1
"restitution":1e999|"1"|null|{} => 
"restitution":-1e-300|1.0000001 => restitution
"spacing":0|1e300|5e-324 => spacing
"natural_frequency":-1 => natural_frequency
"forcing_frequency":0|1 => forcing_frequency
"boundary":"wall"|null => boundary
"initial":"start"|{"free":3}|[] => initial
"initial":{"random":{"sigma":0.1,"seed":-1}} => seed
"damping":0.1 => damping; not in the model; restitution
"masses":3 => masses; not in the model; forcing
"gravity":9.8 => gravity; not in the model; places
"stiffness":2 => stiffness; not in the model; natural_frequency
"places":[1,2]|[] => places; give one for each mass
"initial":{"at":[[1],[0]]} => initial.at; a JSON object
"initial":{"at":{"positions":[1,2],"velocities":[0]}} => initial.at.positions; 2 values for 1 mass
"initial":{"at":{"positions":[1]}} => initial.at; missing field `velocities`
"initial":{"free":[]} => initial.free; 0 pairs for 1 mass
"initial":{"free":[[0,1e300]]} => initial.free[0]"##;

#[test]
fn text_that_is_no_scenario() {
    refused([0xff, 0xfe, 0x00, 0x9f], &[]);
    refused("[".repeat(100_000), &[]);
    for line in NO_SCENARIOS.lines() {
        let (scenario, words) = line.split_once(" => ").unwrap();
        let words: Vec<&str> = words.split("; ").collect();
        if !scenario.starts_with('"') {
            refused(scenario, &words);
            continue;
        }
        let (field, values) = scenario.split_once(':').unwrap();
        for value in values.split('|') {
            refused(with(&format!("{field}:{value}")), &words);
        }
    }
}

/// Where rounding leaves nothing of the motion, a small difference of large parts, it is refused.
#[test]
fn nothing_is_left_near_resonance() {
    let near = with(r#""forcing_frequency":0.9999999999"#);
    refused(near, &["forcing: ", "rounding may move a gap by", "1e-6", "further from"]);
}

/// What the verbs refuse, for each value between bars, and words of what is said.
const REFUSED: &str = "
trace s.json => --until
trace missing.json --until 5 => missing.json:
trace empty --until 5 => empty:
trace s.json --until soon => --until; give a number from 0.0 to
trace s.json --until=-1|NaN|inf => --until
trace s.json --at 2,1 => --at; give rising
trace s.json --at 1 --method verlet => --at; certified
trace s.json --at period => --at: period; give --until
trace s.json --until 5 --save file/below => --save: file/below; another file
trace s.json --until 5 --save - => --save: standard output has the rows; give a file
trace s.json --until 5 --from s.json => --from: s.json: ; that --save wrote
trace s.json --until 5 --max-impacts=-1|1.5|99999999999999999999 => --max-impacts
trace s.json --until 5 --step 0.1 => --step; certified takes neither; leave it out
trace s.json --until 5 --method verlet --step 0 => --step: 0.0; give a number
trace s.json --until 5 --method verlet --tolerance 0.1 => --tolerance; --step
trace ring.json --until 9 --method truth => walls only; another method
trace s.json --until 5 --method euler => euler; verlet; certified
sweep --masses 5 => --sigma
sweep --sigma -0.1|NaN|x|0.2..0.1:0.01|0.1..0.2:0|0.1..0.2|0..1e6:1 => --sigma
sweep --sigma 0.1 --masses 0|x => --masses
sweep --sigma 0.1 --masses 1000000000000 => --masses, --realisations: about
sweep --sigma 0.1 --realisations 1000000000000000000 => --masses, --realisations: about
sweep --sigma 0.1 --realisations 0|5..5|9..3 => --realisations; whole number
sweep --sigma 0.1 --forcing-frequency 1 => --forcing-frequency; resonance
sweep --sigma 0.1 --window 1e-4 => --window; give a number from 0.001
sweep --sigma 0.1 --restitution 1.1 => --restitution
sweep --sigma 0.1 --threads 0|10000 => --threads; give 1 
paper --figure 16|x => --figure
paper --profile deep => --profile
paper --figure 4 --out file/below => --out
paper --profile quick --out file => --out: file: ; a file is in the way
paper --profile quick --figure 3 --results file => --results: file: 
paper --templates nowhere => nowhere
check --templates empty => empty: no prose is there; front
check --profile quick --results r no-such => no statement or relation no-such; check -v
verify => paper/SHA256SUMS: 
run --profile quick --shard 0/3|4/3 --results d => 1 <= i <= N
explain --paper nowhere x => --paper
eval => QUANTITY
eval pjump => pjump; similar; 'p-jump'
eval p-crit --no-such-option => --no-such-option
eval k-star --p -0.1|nan|abc => --p; give a number from 0.0 to 1.0
eval p-of-sigma --sigma 0 => --sigma
eval p-of-sigma --sigma 0.1 --omega 0 => --omega; from 0.001 to 1000
eval p-crit --vertices 0|100000001 => --vertices; give
eval p-jump --masses 100 --vertices 101 => --masses; --vertices; cannot be used with
eval mean-impacts --p 0.1 --masses 10000000 => --masses (N = n + 1):
eval probability --p 0.5 --k 0|101 => --k:; from 1 to 100
eval k-star => --p: k-star needs it
eval p-jump --vertices 3 => --vertices:; no jump; N ≥ 4
eval p-of-sigma --sigma 0.01 => sigma:; below the range; log-p-of-sigma
eval p-of-sigma --sigma 0.1 --omega 2 --forcing-frequency 2 => forcing-frequency:; ω
eval p-crit --p 0.1 => --p:; leave it out";

#[test]
fn options_out_of_range() {
    let folder = folder(SCENARIO);
    let here = folder.path();
    fs::write(here.join("ring.json"), with(r#""boundary":"ring""#)).unwrap();
    fs::write(here.join("file"), "").unwrap();
    fs::create_dir(here.join("empty")).unwrap();
    crate::refused(here, "trace --until 1 no\nsuch", &["no such: "]);
    for line in REFUSED.lines().skip(1) {
        let (arguments, words) = line.split_once(" => ").unwrap();
        let words: Vec<&str> = words.split("; ").collect();
        let group = arguments.split(' ').find(|word| word.contains('|')).unwrap_or(arguments);
        let option = group.find('=').filter(|_| group != arguments).map_or(0, |sign| sign + 1);
        for value in group[option..].split('|') {
            let value = format!("{}{value}", &group[..option]);
            crate::refused(here, &arguments.replace(group, &value), &words);
        }
    }
    assert!(!here.join("d").exists() && !here.join("SHA256SUMS").exists(), "nothing is made");
}

/// A full device is refused, and said so; a reader that goes away, as `head` does, is a quiet end.
#[cfg(target_os = "linux")]
#[test]
fn outputs_that_cannot_be_written() {
    let folder = folder(SCENARIO);
    for arguments in ["trace s.json --until 1e5", "eval p-crit"] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = program(folder.path(), arguments).stdout(full).output().unwrap();
        let (code, _, note) = crate::ended_with(&output);
        assert_eq!((code, note.lines().count()), (2, 1), "{note}");
        assert!(note.contains("standard output"), "{note}");
    }
    let mut command = program(folder.path(), "trace s.json --until 1e5");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let (code, _, note) = crate::ended_with(&child.wait_with_output().unwrap());
    assert!(note.is_empty() && code != -1, "{note}");
}

#[test]
fn files_without_end_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (path, verb) in [("s.json", "trace s.json --until 5"), ("values.json", "explain --paper .")]
    {
        fs::File::create(folder.join(path)).unwrap().set_len((64 << 20) + 1).unwrap();
        crate::refused(folder, verb, &[path, "64 MiB"]);
    }
}
