//! `impact-paper trace` and what people get wrong: exit code 2, one line on stderr that names the
//! field and the remedy, nothing on stdout, never a panic.

use assert_cmd::Command;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const GOOD: &str = r#"{"forcing":[[0.9,-0.4],[-0.7,0.8],[0.3,0.9]]}"#;

fn command() -> Command {
    Command::new(env!("CARGO_BIN_EXE_impact-paper"))
}

fn file(folder: &Path, text: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join("scenario.json");
    std::fs::write(&path, text).unwrap();
    path
}

/// The one line that a refused command leaves on stderr.
fn refusal(arguments: &[&str]) -> String {
    let output = command().arg("trace").args(arguments).output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    assert!(output.stdout.is_empty(), "{arguments:?} printed on stdout");
    assert!(!error.contains("panicked"), "{error}");
    error
}

/// Refuses `text` as a scenario with one line that holds all of `words`.
fn refused(text: impl AsRef<[u8]>, words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), &text);
    let error = refusal(&[path.to_str().unwrap(), "--until", "5"]);
    let shown = String::from_utf8_lossy(text.as_ref());
    let shown: String = shown.chars().take(80).collect();
    assert_eq!(error.trim_end().lines().count(), 1, "{shown}: {error}");
    assert!(error.len() < 600, "{shown}: the line is {} long", error.len());
    for word in words {
        assert!(error.contains(word), "{shown}: \"{word}\" is not in: {error}");
    }
}

/// A scenario of one mass with one more field.
fn with(field: &str) -> String {
    format!(r#"{{"forcing":[[0.9,-0.4]],{field}}}"#)
}

#[test]
fn the_good_scenario_is_taken() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), GOOD);
    let output = command().arg("trace").arg(path).args(["--until", "30"]).output().unwrap();
    assert!(output.status.success() && output.stderr.is_empty());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("time,gap,closing_speed\n") && text.lines().count() > 5, "{text}");
    let piped = command().args(["trace", "-", "--until", "30"]).write_stdin(GOOD).output().unwrap();
    assert_eq!(String::from_utf8(piped.stdout).unwrap(), text);
    let mut last = 0.0;
    for line in text.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert!(cells[0] >= last && cells[1] <= 3.0 && cells[2] >= 0.0, "{line}");
        last = cells[0];
    }
}

#[test]
fn files_that_are_none() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.json");
    let error = refusal(&[missing.to_str().unwrap(), "--until", "5"]);
    assert!(error.contains("missing.json") && error.lines().count() == 1, "{error}");
    let error = refusal(&[folder.path().to_str().unwrap(), "--until", "5"]);
    assert!(error.lines().count() == 1, "a directory: {error}");
    refused([0xff, 0xfe, 0x00, 0x9f], &[]);
    assert!(refusal(&["-", "--until", "5"]).starts_with("impact-paper: -: "));
}

#[test]
fn text_that_is_no_scenario() {
    refused("", &["line 1"]);
    refused("{", &["line 1"]);
    refused(r#"{"forcing":[[1,2]"#, &["line 1"]);
    refused("[]", &["scenario"]);
    refused("null", &["scenario"]);
    refused("17", &["scenario"]);
    refused(format!("{GOOD} {GOOD}"), &["one JSON object"]);
    for (open, close) in [("[", "]"), (r#"{"initial":"#, "}"), (r#"{"forcing":["#, "]}")] {
        refused(open.repeat(100_000), &[]);
        refused(format!("{}{}", open.repeat(100_000), close.repeat(100_000)), &[]);
    }
    refused(r#"{"forcing":[[1,2]],"forcing":[[1,2]]}"#, &["forcing", "duplicate"]);
    refused(with(r#""restitution":0.8,"restitution":0.8"#), &["restitution", "duplicate"]);
    refused(with(r#""sigma":1"#), &["sigma", "unknown"]);
    refused(with(r#""Restitution":1"#), &["Restitution", "unknown"]);
}

#[test]
fn numbers_that_the_model_does_not_have() {
    let range = |field: &str, values: &[&str]| {
        for value in values {
            refused(with(&format!(r#""{field}":{value}"#)), &[field]);
        }
    };
    let no_number =
        ["NaN", "Infinity", "-Infinity", "1e999", "\"1\"", "null", "[1]", "{}", "true", "0x10"];
    for value in no_number {
        refused(with(&format!(r#""restitution":{value}"#)), &[]);
        refused(format!(r#"{{"forcing":[[{value},1]]}}"#), &[]);
    }
    range("restitution", &["-0.1", "1.0000001", "2", "1e300", "-1e-300"]);
    range("spacing", &["0", "-1", "1e300", "1e-300", "5e-324"]);
    range("natural_frequency", &["0", "-1", "1e300", "1e-300"]);
    range("forcing_frequency", &["0", "-1", "1e300", "1", "1.0"]);
    range("boundary", &["\"wall\"", "\"\"", "1", "null", "[\"walls\"]"]);
    range("simultaneous", &["\"both\"", "\"Joint\"", "\"\"", "1", "null", "true", "[\"joint\"]"]);
    range("initial", &["\"start\"", "1", "{\"free\":3}", "{\"random\":{}}", "[]", "{}"]);
    refused(with(r#""simultaneous":"both""#), &["simultaneous", "`sequential` or `joint`"]);
    refused(r#"{"forcing":[[1e300,0]]}"#, &["forcing[0]"]);
    refused(r#"{"forcing":[[0,0],[0,-1e300]]}"#, &["forcing[1]"]);
}

#[test]
fn masses_that_do_not_add_up() {
    refused("{}", &["forcing", "mass"]);
    refused(r#"{"forcing":[]}"#, &["forcing", "mass"]);
    refused(r#"{"forcing":[[1]]}"#, &["forcing"]);
    refused(r#"{"forcing":[[1,2,3]]}"#, &["forcing"]);
    refused(r#"{"forcing":[1,2]}"#, &["forcing"]);
    refused(r#"{"forcing":{"1":2}}"#, &["forcing"]);
    refused(with(r#""initial":{"free":[]}"#), &["initial.free", "0 pairs", "1 masses"]);
    refused(with(r#""initial":{"free":[[0,0],[0,0]]}"#), &["initial.free", "2 pairs"]);
    refused(with(r#""initial":{"free":[[0,1e300]]}"#), &["initial.free[0]"]);
}

#[test]
fn random_starts_that_are_none() {
    let random = |body: &str| with(&format!(r#""initial":{{"random":{body}}}"#));
    refused(random(r#"{"sigma":-1,"seed":1}"#), &["initial.random.sigma", "give a number"]);
    refused(random(r#"{"sigma":1e300,"seed":1}"#), &["initial.random.sigma"]);
    refused(random(r#"{"sigma":0.1}"#), &["seed"]);
    refused(random(r#"{"sigma":0.1,"seed":-1}"#), &["seed"]);
    refused(random(r#"{"sigma":0.1,"seed":1.5}"#), &["seed"]);
    refused(random(r#"{"sigma":0.1,"seed":1,"more":1}"#), &["more"]);
}

#[test]
fn starts_that_overlap() {
    refused(with(r#""initial":{"free":[[-5,0]]}"#), &["initial", "gap 0", "overlap"]);
    refused(with(r#""initial":{"free":[[5,0]]}"#), &["initial", "gap 1", "overlap"]);
    let pair = r#"{"forcing":[[0,0],[0,0]],"initial":{"free":[[0.75,0],[-0.75,0]]}}"#;
    refused(pair, &["initial", "gap 1", "overlap"]);
}

#[test]
fn options_out_of_range() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), GOOD);
    let path = path.to_str().unwrap();
    for until in ["-1", "NaN", "inf", "-inf", "1e300", "", "soon"] {
        let error = refusal(&[path, &format!("--until={until}")]);
        assert!(error.contains("--until"), "{until}: {error}");
    }
    for most in ["-1", "1.5", "many", "99999999999999999999"] {
        let error = refusal(&[path, "--until", "5", &format!("--max-impacts={most}")]);
        assert!(error.contains("--max-impacts"), "{most}: {error}");
    }
    refusal(&[path]);
    refusal(&["--until", "5"]);
    refusal(&[path, "--until", "5", "--untill", "6"]);
}

#[cfg(unix)]
#[test]
fn outputs_that_cannot_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), GOOD);
    let run = || {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_impact-paper"));
        command.arg("trace").arg(&path).args(["--until", "1e5"]);
        command.stderr(std::process::Stdio::piped());
        command
    };
    // A full device: refused, and said so.
    if let Ok(full) = std::fs::OpenOptions::new().write(true).open("/dev/full") {
        let output = run().stdout(full).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(4), "{error}");
        assert_eq!(error.lines().count(), 1, "{error}");
    }
    // A reader that goes away, as `head` does: a quiet end.
    let mut child = run().stdout(std::process::Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(error.is_empty() && output.status.code().is_some(), "{error}");
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
    let said = |frequency: &str, more: &[&str]| {
        let path = file(folder.path(), with(&format!(r#""forcing_frequency":{frequency}"#)));
        let output =
            command().arg("trace").arg(path).args(["--until", "20"]).args(more).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success() && output.stdout.len() > 100, "{error}");
        error
    };
    for more in [&[][..], &["--certify"]] {
        let error = said("1.0000001", more);
        assert!(
            error.lines().count() == 1 && error.contains("closing speed v by 3.0e-7/v"),
            "{error}"
        );
        let error = said("1.1", more);
        assert!(!error.contains("/v"), "{error}");
    }
    assert_eq!(said("1.0000001", &["--method", "verlet"]), "");
}

/// Sizes are refused before the work begins, by the name of their option and with a bound.
#[test]
fn sizes_without_bound() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), GOOD);
    let path = path.to_str().unwrap();
    let trace = |option: &'static str, value: &'static str| {
        vec!["trace", path, "--until", "1", "--method", "verlet", option, value]
    };
    let most = usize::MAX.to_string();
    for (arguments, words) in [
        (vec!["sweep", "--sigma", "0.1", "--masses", "1000000000000"], "--masses: about"),
        (vec!["sweep", "--sigma", "0.1", "--masses", &most], "--masses: about"),
        (
            vec!["sweep", "--sigma", "0.1", "--realisations", "1000000000000000000"],
            "--realisations: about",
        ),
        (vec!["sweep", "--sigma", "0.1", "--threads", "10000"], "cores; give 1 to "),
        (vec!["sweep", "--sigma", "1e308"], "--sigma: 1e308"),
        (vec!["bench", "engine", "--masses", "1000000000000"], "--masses, --chains: about"),
        (vec!["bench", "engine", "--masses", "10", "--chains", &most], "--masses, --chains: about"),
        (
            vec!["bench", "engine", "--masses", "10", "--threads", "1000000000"],
            "--threads: 1000000000",
        ),
        (vec!["bench", "engine", "--chains", "-1"], "'--chains <C>'"),
        (vec!["bench", "scenario", "--masses", "1000000000000"], "--masses: about"),
        (vec!["bench", "methods", "--masses", "1000000000000"], "--masses: about"),
        (vec!["run", "--shard", "1/3", "--out", "nowhere", "--threads", "10000"], "--threads"),
        (trace("--step", "-1"), "--step: -1.0 is out of range"),
        (trace("--max-impacts", "-1"), "'--max-impacts <M>'"),
    ] {
        let began = Instant::now();
        let output = command().current_dir(&folder).args(&arguments).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(output.stdout.is_empty() && error.lines().count() == 1, "{error}");
        assert!(error.contains(words), "{arguments:?}: {error}");
        assert!(began.elapsed() < Duration::from_secs(5), "{arguments:?}");
    }
    if cfg!(unix) {
        let error = refusal(&["/dev/zero", "--until", "5"]);
        assert!(error.contains("longer than"), "{error}");
    }
}
