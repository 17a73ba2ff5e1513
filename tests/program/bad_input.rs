//! `impact-paper trace` and what people get wrong: exit code 2, one line on stderr that names the
//! field and the remedy, nothing on stdout, never a panic.

use crate::{SCENARIO, program, run};
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

/// Refuses `text` as a scenario with one line that has all of `words`.
fn refused(text: impl AsRef<[u8]>, words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.json"), text).unwrap();
    crate::refused(folder.path(), "trace s.json --until 5", words);
}

/// A scenario of one mass with one more field.
fn with(field: &str) -> String {
    format!(r#"{{"forcing":[[0.9,-0.4]],{field}}}"#)
}

/// Texts that are no scenario, or, without braces, fields of one with a mass; of values with bars between, each
/// stands there once. And what is said.
const NO_SCENARIOS: &str = r##"{ => line 1
{"forcing":[[1,2]" => line 1
null => line 1
[] => forcing
{"forcing":[[1,2]],"forcing":[[1,2]]} => forcing; duplicate
{"forcing":[[nan,1]]} => forcing[0][0]
{"forcing":[[[1,2]],[[1,2]]]} => forcing: its lists; forcing_frequencies
{"forcing_frequencies":[1.4],"forcing":[[1,2]]} => forcing: its lists
{"forcing_frequencies":[1.4],"forcing":[[[1,2]]],"restitution":.8} => restitution
{} => forcing; mass
{"forcing":[]} => forcing; mass
{"forcing":[[1]]} => forcing
{"forcing":[[1,2,3]]} => forcing; [alpha, beta]
{"forcing":[1,2]} => forcing
{"forcing":[[1e300,0]]} => forcing[0]
{"forcing":[[0,0],[0,-1e300]]} => forcing[1]
{"forcing":[[0,0],[0,0]],"initial":{"free":[[0.75,0],[-0.75,0]]}} => initial; gap 1; overlap
"sigma":1 => sigma; unknown
"Restitution":1 => Restitution; unknown
"restitution":NaN|Infinity|-Infinity|0x10 => line 1
"restitution":1e999|"1"|null|[1]|{}|true => 
"restitution":-0.1|1.0000001|2|1e300|-1e-300 => restitution
"spacing":0|-1|1e300|1e-300|5e-324 => spacing
"natural_frequency":0|-1|1e300|1e-300 => natural_frequency
"forcing_frequency":0|-1|1e300|1|1.0 => forcing_frequency
"boundary":"wall"|""|1|null|["walls"] => boundary
"initial":"start"|{"free":3}|{"random":{}}|[]|{} => initial
"initial":"random" => initial.random
"initial":{"random":{"sigma":-1,"seed":1}} => initial.random.sigma; give a number
"initial":{"random":{"sigma":0.1}} => seed
"initial":{"random":{"sigma":0.1,"seed":-1}} => seed
"initial":{"random":{"sigma":0.1,"seed":1,"more":1}} => more
"initial":{"free":[]} => initial.free; 0 pairs for 1 mass
"initial":{"free":[[0,1e300]]} => initial.free[0]
"initial":{"free":[[-5,0]]} => initial; gap 0; overlap
"initial":{"free":[[5,0]]} => initial; gap 1; overlap"##;

#[test]
fn text_that_is_no_scenario() {
    refused([0xff, 0xfe, 0x00, 0x9f], &[]);
    refused(" \n", &["line"]);
    for (open, close) in [("[", "]"), (r#"{"initial":"#, "}"), (r#"{"forcing":["#, "]}")] {
        refused(open.repeat(100_000), &[]);
        refused(format!("{}{}", open.repeat(100_000), close.repeat(100_000)), &[]);
    }
    for line in NO_SCENARIOS.lines() {
        let (text, words) = line.split_once(" => ").unwrap();
        let words: Vec<&str> = words.split("; ").collect();
        if !text.starts_with('"') {
            refused(text, &words);
            continue;
        }
        let (field, values) = text.split_once(':').unwrap();
        for value in values.split('|') {
            refused(with(&format!("{field}:{value}")), &words);
        }
    }
}

/// Near resonance the motion is a small difference of large parts: it is refused where nothing is left of it,
/// and standard error says by how much rounding moves it where it matters.
#[test]
fn near_resonance() {
    let folder = tempfile::tempdir().unwrap();
    for frequency in ["1.0000000000000002", "1.000000000001", "0.9999999999"] {
        let text = with(&format!(r#""forcing_frequency":{frequency}"#));
        refused(text, &["forcing: ", "rounding may move a gap by", "1e-6", "further from"]);
    }
    refused(r#"{"forcing":[[0,1e9]]}"#, &["smaller amplitudes"]);
    let said = |frequency: &str, more: &str| {
        let text = with(&format!(r#""forcing_frequency":{frequency}"#));
        fs::write(folder.path().join("s.json"), text).unwrap();
        let (code, out, note) = run(folder.path(), &format!("trace s.json --until 20{more}"));
        assert!(code == 0 && out.len() > 100, "{note}");
        note
    };
    for more in ["", " --method sampled"] {
        let note = said("1.0000001", more);
        assert!(
            note.lines().count() == 1 && note.contains("closing speed v by 2.9e-7/v"),
            "{note}"
        );
        assert!(!said("1.1", more).contains("/v"));
    }
    assert_eq!(said("1.0000001", " --method verlet"), "");
}

/// What the verbs refuse, and words that the line says of it: the field, the bound or the remedy. Of values with
/// bars between, each stands there once.
const REFUSED: &str = "
trace s.json => --until
trace --until 5 => SCENARIO
trace missing.json --until 5 => missing.json:
trace empty --until 5 => empty:
trace - --until 5 => standard input:
trace s.json --until soon => --until; give a number from 0.0 to
trace s.json --until=-1|NaN|inf|-inf|1e300||soon => --until
trace s.json --until 5 --max-impacts=-1|1.5|many|99999999999999999999 => --max-impacts
trace s.json --until 5 --step 0.1 => --step; certified takes neither; leave it out
trace s.json --until 5 --method verlet --step 0 => --step: 0.0; give a number
trace s.json --until 5 --method verlet --tolerance 0.1 => --tolerance; --step
trace s.json --until 5 --method runge-kutta --step 0.1 => --step; --tolerance
trace s.json --until 5 --method euler => euler; verlet; certified
sweep --masses 5 => --sigma
sweep --sigma -0.1|NaN|x|0.2..0.1:0.01|0.1..0.2:0|1e300|1e308 => --sigma
sweep --sigma 0.1 --masses 0|x => --masses
sweep --sigma 0.1 --masses 1000000000000|18446744073709551615 => --masses, --realisations: about
sweep --sigma 0.1 --realisations 0 => --realisations
sweep --sigma 0.1 --realisations 1000000000000000000 => --masses, --realisations: about
sweep --sigma 0.1 --window inf|1e-4|1e300 => --window; give a number from 0.001
sweep --sigma 0.1 --transient -1|NaN|1e13 => --transient
sweep --sigma 0.1 --restitution 1.1|-0.1|NaN => --restitution
sweep --sigma 0.1 --threads 0|10000|4294967296 => --threads; give 1 
paper --figure 16|0|x => --figure
paper --profile deep => --profile
paper --threads 0 --figure 4 => --threads
paper --figure 4 --out file|file/below => --out
paper --profile quick --out file => --out: file: ; a file is in the way
paper --profile quick --figure 3 --results file => --results: file: not a directory
paper --templates nowhere => nowhere
paper --templates empty => empty: no prose is there; front
check --templates empty => empty: no prose is there
check --profile quick --results r no-such => no statement no-such; check -v
check --profile quick --results file => --results: file: not a directory
verify => paper/SHA256SUMS: 
run --profile quick --shard 0/3|4/3 --results d => 1 <= i <= N
run --profile quick --shard 1/3 --results file|file/below => --results: file
eval => QUANTITY
eval pjump => pjump; similar; 'p-jump'
eval p-crit --no-such-option => --no-such-option
eval k-star --p -0.1|1.0000000000000002|nan|inf|-inf|abc|0,5 => --p; give a number from 0.0 to 1.0
eval p-of-sigma --sigma 0|-1|nan|inf => --sigma
eval p-of-sigma --sigma 0.1 --omega 0|-1|nan|inf|1e4 => --omega; from 0.001 to 1000
eval p-of-sigma --sigma 0.1 --spacing 0|1e308 => --spacing; give
eval p-crit --vertices 0|100000001 => --vertices; give
eval p-crit --vertices 1.5|abc|99999999999999999999999 => --vertices
eval p-jump --masses 100 --vertices 101 => --masses; --vertices; cannot be used with
eval probability --p 0.5 --k 0|101 => --k:; 1 ≤ k ≤ 100
eval k-star => --p: k-star needs it
eval p-of-sigma => --sigma: p-of-sigma needs it
eval p-jump --vertices 1|2|3 => --vertices:; no jump; N ≥ 4
eval p-of-sigma --sigma 0.01 => sigma:; below the range; log-p-of-sigma
eval log-p-of-sigma --sigma 1e-160 => sigma:; larger
eval p-of-sigma --sigma 0.1 --omega 2 --forcing-frequency 2 => forcing-frequency:; ω
eval log-p-of-sigma --sigma 1 --omega 1.4142135623730951 => forcing-frequency:
eval p-crit --p 0.1 => --p:; leave it out
eval p-of-sigma --sigma 0.1 --vertices 5 => --vertices:";

#[test]
fn options_out_of_range() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("s.json"), SCENARIO).unwrap();
    fs::write(here.join("file"), "").unwrap();
    fs::create_dir(here.join("empty")).unwrap();
    let mut count = 0;
    for line in REFUSED.lines().skip(1) {
        let (arguments, words) = line.split_once(" => ").unwrap();
        let words: Vec<&str> = words.split("; ").collect();
        let group = arguments.split(' ').find(|word| word.contains('|')).unwrap_or(arguments);
        let option = group.find('=').filter(|_| group != arguments).map_or(0, |at| at + 1);
        for value in group[option..].split('|') {
            let value = format!("{}{value}", &group[..option]);
            crate::refused(here, &arguments.replace(group, &value), &words);
            count += 1;
        }
    }
    assert!(count > 100, "{count}");
    assert!(!here.join("d").exists() && !here.join("SHA256SUMS").exists(), "nothing is made");
}

/// A full device is refused, and said so; a reader that goes away, as `head` does, is a quiet end.
#[cfg(target_os = "linux")]
#[test]
fn outputs_that_cannot_be_written() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.json"), SCENARIO).unwrap();
    for arguments in ["trace s.json --until 1e5", "eval p-crit"] {
        let mut command = program(folder.path(), arguments);
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = command.stdout(full).stderr(Stdio::piped()).spawn().unwrap();
        let (code, _, note) = crate::told(&output.wait_with_output().unwrap());
        assert_eq!((code, note.lines().count()), (2, 1), "{note}");
        assert!(note.contains("standard output"), "{note}");
    }
    let mut command = program(folder.path(), "trace s.json --until 1e5");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let (code, _, note) = crate::told(&child.wait_with_output().unwrap());
    assert!(note.is_empty() && code != -1, "{note}");
}

#[test]
fn files_without_end_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let long = |path: &str| {
        let file = fs::File::create(folder.join(path)).unwrap();
        file.set_len((64 << 20) + 1).unwrap();
    };
    long("long.json");
    crate::refused(folder, "trace long.json --until=5", &["long.json", "64 MiB"]);
    for name in ["report", "templates"] {
        fs::create_dir(folder.join(name)).unwrap();
    }
    crate::refused(folder, "trace long.json --until=5", &["64 MiB"]);
    long("report/values.json");
    crate::refused(folder, "explain --paper=report", &["values.json", "8 MiB"]);
    long("templates/report.md");
    let check = "check --profile=quick --templates=templates";
    crate::refused(folder, check, &["report.md", "8 MiB"]);
}

#[test]
fn broken_files_are_told_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::create_dir(folder.join("t")).unwrap();
    fs::write(folder.join("name.json"), "{\"a\\nb\":1}").unwrap();
    fs::write(folder.join("t/published.toml"), "# none\n[[statement]]\nid = 3\n").unwrap();
    let check = "check --profile=quick --templates=t";
    crate::refused(folder, check, &["impact-paper: published.toml:3: ", "restore the file"]);
    crate::refused(folder, "trace name.json --until=5", &["name.json", "a b"]);
}

/// A folder of the output that is a link leads out of it; a file that is one is replaced.
#[cfg(unix)]
#[test]
fn nothing_is_written_outside_the_output() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for name in ["out", "outside", "good"] {
        fs::create_dir(folder.join(name)).unwrap();
    }
    let names = |path: &str| -> Vec<String> {
        let entries = fs::read_dir(folder.join(path)).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    };
    symlink("../outside", folder.join("out/data")).unwrap();
    let paper = "paper --profile=quick --figure=7 --out=out --force";
    crate::refused(folder, paper, &["--out", "data", "symbolic link"]);
    assert_eq!(names("outside"), Vec::<String>::new());
    assert_eq!(names("out"), ["data"], "nothing is half-written");

    fs::write(folder.join("outside/kept"), "kept").unwrap();
    fs::create_dir(folder.join("good/data")).unwrap();
    symlink("../../outside/kept", folder.join("good/data/fig07.csv")).unwrap();
    symlink("good", folder.join("link")).unwrap();
    let paper = "paper --profile=quick --figure=7 --out=link --force";
    assert_eq!(run(folder, paper).0, 0);
    assert_eq!(fs::read_to_string(folder.join("outside/kept")).unwrap(), "kept");
    assert!(!folder.join("good/data/fig07.csv").is_symlink());
}

/// What takes long says after some seconds that it is at work, on standard error alone.
#[test]
fn long_work_gives_signs_of_life() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.json"), SCENARIO).unwrap();
    let sweep = "sweep --sigma 0.3 --realisations 1 --masses 10 --window 1e11";
    let begun = ["trace s.json --until 1e12", sweep].map(|verb| {
        let mut command = program(folder.path(), verb);
        command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    });
    for mut child in begun {
        let mut line = String::new();
        BufReader::new(child.stderr.take().unwrap()).read_line(&mut line).unwrap();
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(line.contains(", after 5 s"), "{line}");
    }
}
