//! Runs the program as its users do, and makes the report in memory.

mod bad_input;
mod check;
mod diff;
mod explain;
mod paper;
#[path = "../report/mod.rs"]
mod report;
mod saved;
mod verbs;

use literate::input::sha256;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::LazyLock;

const PROGRAM: &str = env!("CARGO_BIN_EXE_impact-paper");

const TEMPLATES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/templates");

/// Number of the experiments that are saved.
const EXPERIMENTS: usize = 18;

const SCENARIO: &str = r#"{"forcing":[[0.9,-0.4],[-0.7,0.8],[0.3,0.9]]}"#;

/// The program in a folder, with arguments between blanks; `@` is the folder of the templates.
fn program(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(PROGRAM);
    let words = arguments.split(' ').map(|word| if word == "@" { TEMPLATES } else { word });
    command.current_dir(folder).env("LITERATE_PROJECT", env!("CARGO_MANIFEST_DIR")).args(words);
    command
}

/// A folder with a scenario, s.json.
fn folder(scenario: impl AsRef<[u8]>) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.json"), scenario).unwrap();
    folder
}

/// Exit code, stdout and stderr; −1 for a program that a signal ended.
fn ended_with(output: &Output) -> (i32, String, String) {
    let utf8 = |bytes: &Vec<u8>| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), utf8(&output.stdout), utf8(&output.stderr))
}

fn outcome(command: &mut Command) -> (i32, String, String) {
    ended_with(&command.output().unwrap())
}

/// The standard output and error of a run with this exit code and these words on stderr.
fn ends(folder: &Path, arguments: &str, code: i32, words: &[&str]) -> [String; 2] {
    let (ended, out, note) = outcome(&mut program(folder, arguments));
    assert_eq!(ended, code, "{arguments}: {out}{note}");
    for word in words {
        assert!(note.contains(word), "{arguments}: {word:?} is not in {note}");
    }
    [out, note]
}

/// The standard output of a run that succeeds and says nothing else.
fn answer(folder: &Path, arguments: &str) -> String {
    let [out, note] = ends(folder, &format!("-q {arguments}"), 0, &[]);
    assert_eq!(note, "", "{arguments}: {out}");
    out
}

/// Holds a run to its refusal: exit code 2, and one line on stderr, which has these words.
fn refused(folder: &Path, arguments: &str, words: &[&str]) {
    let [out, note] = ends(folder, arguments, 2, words);
    assert_eq!((out.as_str(), note.lines().count()), ("", 1), "{arguments}: {note}");
    assert!(note.len() < 2000 && !note.contains("panicked"), "{arguments}: {note}");
    for jargon in ["f64", "u64", "usize", "i128", "struct ", "enum ", "digit found", "literal:"] {
        assert!(!note.contains(jargon), "{arguments}: {note}");
    }
}

/// A saved result with other text in its second or third line, and a checksum that is right.
fn forged(bytes: &[u8], line: usize, from: &str, to: &str) -> Vec<u8> {
    let mut lines: Vec<&str> = std::str::from_utf8(bytes).unwrap().lines().collect();
    let changed = lines[line].replacen(from, to, 1);
    assert_ne!(changed, lines[line], "there is no {from}");
    lines[line] = &changed;
    let made_of = format!("{}\n{}\n", lines[1], lines[2]);
    format!("{}\n{made_of}", sha256(&made_of)).into()
}

/// Copies the project's templates, and changes one of their files.
fn templates(to: &Path, file: &str, change: impl Fn(&str) -> String) {
    put(to, &tree(Path::new(TEMPLATES)));
    fs::write(to.join(file), change(&fs::read_to_string(to.join(file)).unwrap())).unwrap();
}

type Files = BTreeMap<String, Vec<u8>>;

/// Returns all files below a folder, hidden ones included; nothing if it is not there.
fn tree(folder: &Path) -> Files {
    let mut files = Files::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_string();
        if path.is_dir() {
            let below = tree(&path).into_iter();
            files.extend(below.map(|(path, bytes)| (format!("{name}/{path}"), bytes)));
        } else {
            files.insert(name, fs::read(&path).unwrap());
        }
    }
    files
}

/// The JSON files of a folder. Temporary files that a killed program left are not among them.
fn files(folder: &Path) -> Files {
    let here = |name: &str| name.ends_with(".json") && !name.contains('/');
    tree(folder).into_iter().filter(|(name, _)| here(name)).collect()
}

fn put(folder: &Path, files: &Files) {
    for (name, bytes) in files {
        fs::create_dir_all(folder.join(name).parent().unwrap()).unwrap();
        fs::write(folder.join(name), bytes).unwrap();
    }
}

/// Runs one of three shards of the quick profile, and returns its standard output and error.
fn shard(folder: &Path, i: usize, results: &str) -> [String; 2] {
    let line = format!("run --profile quick --shard {i}/3 --results {results} --threads {i}");
    ends(folder, &line, 0, &[])
}

/// What the quick profile makes of three shards, run in another order and on other numbers of
/// threads. (A test of saved results compares it with a run of the whole.)
struct Quick {
    shards: [Files; 3],
    results: Files,
    report: Files,
    /// The same in a folder of target/, with links to files of the project.
    below: Files,
}

static QUICK: LazyLock<Quick> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    for i in [3, 1, 2] {
        let [_, note] = shard(here, i, &i.to_string());
        let begins = note.starts_with(&format!("shard {i}/3: "));
        assert!(begins && note.contains(" to run, "), "{note}");
    }
    let shards = [1, 2, 3].map(|i| files(&here.join(i.to_string())));
    shards.iter().for_each(|shard| put(&here.join("results"), shard));
    let paper = "paper --profile quick --out report --results results --threads 4 --templates @";
    ends(here, paper, 0, &[]);
    let below = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/test-report");
    let _ = fs::remove_dir_all(&below);
    let paper = "-q paper --profile quick --results results --templates @ --out";
    let (code, _, note) = outcome(program(here, paper).arg(&below));
    assert_eq!(code, 0, "{note}");
    Quick {
        shards,
        results: files(&here.join("results")),
        report: tree(&here.join("report")),
        below: tree(&below),
    }
});
