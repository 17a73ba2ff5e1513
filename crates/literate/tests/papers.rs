//! The papers of `examples/`, made as their readers would make them.

#[allow(dead_code)]
#[path = "../examples/feigenbaum/main.rs"]
mod feigenbaum;

use literate::cli::terminal::is_ignored;
use literate::experiments::{AnyExperiment, Profile, Progress, Store};
use literate::input::sha256;
use literate::{INTERRUPTED, make_report};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use std::path::Path;
use std::process::{Command, Stdio};

#[test]
fn the_second_paper_is_made_and_its_run_is_used_again() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path());
    let paper = feigenbaum::paper();
    let prose = Some(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/feigenbaum"));
    let quiet = Progress::silent();
    let session = paper.session(prose.as_deref(), Profile::Full, store, quiet).unwrap();
    let (report, checks) = make_report(&paper, &session, Path::new("paper")).unwrap();
    assert!(checks.iter().all(|check| !check.fails()));
    let saved = folder.path().join("cascade-full.json");
    let written = || std::fs::metadata(&saved).unwrap().modified().unwrap();
    let first = written();
    assert!(report == make_report(&paper, &session, Path::new("paper")).unwrap().0);
    assert_eq!(written(), first, "it is run once");

    let text = |path: &str| String::from_utf8(report[path].clone()).unwrap();
    let markdown = text("report.md");
    for part in [
        "2 of 3 statements are reproduced, 1 differs and is",
        "| 1 | 3.236067977 | – | – |",
        "**Listing 1.** The search for the orbits.",
        "[convergence.csv](data/convergence.csv). Code: [main.rs](../examples/feigenbaum/main.rs)",
    ] {
        assert!(markdown.contains(part), "{part}: {markdown}");
    }
    // Where the two ratios are those of the last orbit, no logarithm has their distance.
    let data = text("data/convergence.csv");
    assert!(data.starts_with("series (text),n (1),distance from the last ratio (1)\ndelta,2,"));
    assert_eq!(data.lines().count(), 1 + 2 * 14, "{data}");
    assert!(text("data/cascade-orbits.csv").starts_with("n (1),parameter (1),delta (1),"));
    let ledger = text("ledger.json");
    assert_eq!(ledger.matches("\"reproduced\"").count(), 2, "{ledger}");
    assert_eq!(ledger.matches("\"differs and explained\"").count(), 1, "{ledger}");
    assert!(report.contains_key("report.html"));

    // To the digits that the literature has: 4.669 201 609 102… and 2.502 907 875 095….
    let cascade = feigenbaum::CASCADE
        .read_or_run(&feigenbaum::CASCADE.identity(&session).unwrap(), &session)
        .unwrap();
    let tables = AnyExperiment::tables(&feigenbaum::CASCADE, &cascade);
    let limit = |column: &str| tables[1].distinct(column).unwrap()[0];
    assert!((limit("delta") - 4.669_201_609_102_99).abs() < 1e-10, "{}", limit("delta"));
    assert!((limit("alpha") - 2.502_907_875_095_892).abs() < 1e-10, "{}", limit("alpha"));
    assert!((limit("onset") - 3.569_945_671_870_945).abs() < 1e-12, "{}", limit("onset"));
}

#[test]
#[ignore = "is a program that the next tests start"]
fn a_program() {
    let Ok(line) = std::env::var("LITERATE_LINE") else { return };
    let mut paper = feigenbaum::paper();
    if let Ok(words) = std::env::var("LITERATE_COMMAND") {
        let command = literate::experiments::Command::new("toy", words.leak());
        paper = paper.experiment(Box::leak(Box::new(command)));
    }
    let code = paper.run(line.split(' ').map(Into::into).collect());
    std::process::exit(code.into());
}

fn program(folder: &Path, line: &str) -> Command {
    let mut program = Command::new(std::env::current_exe().unwrap());
    program.args(["--ignored", "--exact", "a_program"]).current_dir(folder);
    program.env("LITERATE_LINE", format!("feigenbaum {line}"));
    program
}

/// The program with one more experiment: a script `toy.sh` in a folder, with an argument.
fn with_script(folder: &Path, script: &str, argument: &str, line: &str) -> Command {
    std::fs::write(folder.join("toy.sh"), script).unwrap();
    let line = format!("{line} --results {}/results", folder.display());
    let mut program = program(Path::new(env!("CARGO_MANIFEST_DIR")), &line);
    program.env("LITERATE_COMMAND", format!("sh {}/toy.sh {argument}", folder.display()));
    program
}

/// Runs a program, and returns its exit code and what it printed on both streams.
fn run(mut program: Command) -> (i32, String, String) {
    let output = program.output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

#[test]
fn the_advice_of_verify_works_as_it_is_printed() {
    let folder = tempfile::tempdir().unwrap();
    // The way to the project may have blanks.
    let prose = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/feigenbaum");
    std::fs::create_dir(folder.path().join("prose")).unwrap();
    for file in prose.read_dir().unwrap().map(Result::unwrap) {
        std::fs::copy(file.path(), folder.path().join("prose").join(file.file_name())).unwrap();
    }
    let made = |line: &str| run(program(folder.path(), &format!("{line} --templates prose")));
    assert_eq!(made("paper").0, 0);
    // A saved result that is wrong, and looks fresh.
    let saved = folder.path().join("target/results/cascade-full.json");
    let saved_result = std::fs::read_to_string(&saved).unwrap();
    let [_, made_of, body, ""] = saved_result.split('\n').collect::<Vec<_>>()[..] else {
        panic!("{saved_result}")
    };
    let made_of = format!("{made_of}\n{}\n", body.replacen("3.2", "3.3", 1));
    std::fs::write(&saved, format!("{}\n{made_of}", sha256(&made_of))).unwrap();
    assert_eq!(made("paper").0, 0);
    let (code, output, note) = made("verify --rerun");
    assert!(code == 1 && output.contains("rerun: "), "{output}{note}");
    let advice = "paper --force --rerun all";
    assert!(note.contains(advice), "{note}");
    let (code, _, note) = made(advice);
    assert_eq!(code, 0, "{note}");
    let (code, output, note) = made("verify --rerun");
    assert_eq!(code, 0, "{output}{note}");
    let (code, _, note) = made("paper --rerun cascade");
    assert!(code == 0 && note.contains("cascade: run\n"), "{note}");
    let (code, _, note) = made("paper --rerun cascades");
    assert!(code == 2 && note.contains("no experiment cascades; nearest: cascade"), "{note}");
}

#[test]
fn a_signal_also_ends_the_programs_that_commands_started() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path().display();
    let wait = format!("touch {here}/$1-ready; sleep 600 & wait");
    let inner = format!("trap 'touch {here}/$1-ended; exit' TERM; {wait}");
    std::fs::write(folder.path().join("inner.sh"), inner).unwrap();
    let outer = format!("sh {here}/inner.sh $1 & wait");
    let exists = |mark: String| folder.path().join(mark).exists();
    for (signal, number) in [("INT", SIGINT), ("TERM", SIGTERM), ("HUP", SIGHUP)] {
        if is_ignored(number) {
            continue;
        }
        let line = "run --templates examples/feigenbaum";
        let mut program = with_script(folder.path(), &outer, signal, line);
        let mut program = program.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        while !exists(format!("{signal}-ready")) {
            assert_eq!(program.try_wait().unwrap(), None, "ended too early");
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        let line = format!("kill -s {signal} {}", program.id());
        assert!(Command::new("sh").args(["-c", &line]).status().unwrap().success());
        let output = program.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(INTERRUPTED.into()), "{signal}: {output:?}");
        assert!(exists(format!("{signal}-ended")), "{signal}: {output:?}");
    }
}

#[test]
fn what_a_command_says_is_shown_and_explained() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path().display();
    let table = r#"{"rows": {"columns": ["b"], "rows": [[7]]}}"#;
    let script = format!("echo a warning >&2; echo progress 1/2 >&2; echo '{table}'");
    let made = |line: String| run(with_script(folder.path(), &script, "", &line));
    let (_, _, note) = made(format!("paper --templates examples/feigenbaum --out {here}/paper"));
    assert!(note.starts_with("2 experiments to run on ") && note.contains(", time unknown\n"));
    assert!(note.contains("\ntoy: a warning\n") && !note.contains("progress"), "{note}");
    let (_, said, _) = made(format!("explain toy.rows.b --paper {here}/paper"));
    assert!(said.ends_with("\n  7\ntoy said: a warning\n"), "{said}");
}

#[test]
fn what_a_command_runs_ends_even_if_this_program_is_killed() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    // The pipe ends when all that have opened it are gone.
    let script = format!("exec 3> {}; (sleep 5; echo late >&3) & wait", pipe.display());
    let line = "run --templates examples/feigenbaum";
    let mut program = with_script(folder.path(), &script, "", line);
    let mut program = program.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let mut pipe = std::fs::File::open(pipe).unwrap();
    program.kill().and_then(|()| program.wait()).unwrap();
    assert_eq!(std::io::read_to_string(&mut pipe).unwrap(), "");
}
