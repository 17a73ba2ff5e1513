//! The program: the command line, files too long, and where it writes.

use super::mutants::mutant;
use std::path::Path;
use std::process::Command;

/// Exit code and the text on stderr.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_impact-paper"));
    let output = command.current_dir(folder).args(arguments).output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// Refused with exit code 2 and one line that has these words.
fn refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    let (code, error) = run(folder, arguments);
    assert_eq!(code, Some(2), "{arguments:?}: {error}");
    assert_eq!(error.lines().count(), 1, "{arguments:?}: {error}");
    assert!(error.len() < 2000, "{arguments:?}: {} long", error.len());
    for word in words {
        assert!(error.contains(word), "{arguments:?}: {word} is not in: {error}");
    }
}

/// A list that is taken leads to the refusal of --masses 0.
#[test]
fn lists_of_sigma_of_any_text() {
    let good = ["0.1,0.12,0.3", "0.08..0.18:0.0025", "0..0.001:5e-4"].map(String::from);
    let folder = tempfile::tempdir().unwrap();
    let mut taken = 0;
    for index in 0..400 {
        let text = mutant("sigma", index, &good).replace('\0', "");
        let text: String = text.chars().take(20_000).collect();
        let sigma = format!("--sigma={text}");
        let (code, error) = run(folder.path(), &["sweep", &sigma, "--masses=0"]);
        let shown = &error[..error.len().min(300)];
        assert_eq!(code, Some(2), "{text:?}: {shown}");
        assert_eq!(error.lines().count(), 1, "{text:?}: {shown}");
        assert!(error.len() < 2000, "{text:?}: {} long", error.len());
        let option = if error.contains("--masses: 0") { "--masses" } else { "--sigma" };
        taken += usize::from(option == "--masses");
        assert!(error.contains(option), "{text:?}: {shown}");
    }
    assert!((50..350).contains(&taken), "{taken} taken");
}

#[test]
fn files_without_end_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let long = |path: &str| {
        let file = std::fs::File::create(folder.join(path)).unwrap();
        file.set_len((64 << 20) + 1).unwrap();
    };
    long("long.json");
    refused(folder, &["trace", "long.json", "--until=5"], &["long.json", "64 MiB"]);
    for name in ["report", "templates"] {
        std::fs::create_dir(folder.join(name)).unwrap();
    }
    long("report/values.json");
    refused(folder, &["explain", "--paper=report"], &["values.json", "64 MiB"]);
    long("templates/report.md");
    let check = ["check", "--profile=quick", "--claim=sec3_edges", "--templates=templates"];
    refused(folder, &check, &["report.md", "64 MiB"]);
    // Together, though none alone.
    for name in ["report.md", "one.md", "two.md"] {
        let file = std::fs::File::create(folder.join("templates").join(name)).unwrap();
        file.set_len(30 << 20).unwrap();
    }
    refused(folder, &check, &["templates", "64 MiB"]);
    if Path::new("/dev/zero").exists() {
        refused(folder, &["trace", "/dev/zero", "--until=5"], &["/dev/zero", "64 MiB"]);
    }
}

#[test]
fn broken_files_are_told_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::create_dir(folder.join("t")).unwrap();
    std::fs::write(folder.join("t/published.toml"), "# none\n[[statement]]\nid = 3\n").unwrap();
    let check = ["check", "--profile=quick", "--templates=t"];
    refused(folder, &check, &["impact-paper: published.toml:3: "]);
    std::fs::write(folder.join("name.json"), "{\"a\\nb\":1}").unwrap();
    refused(folder, &["trace", "name.json", "--until=5"], &["name.json", "a b"]);
}

#[cfg(unix)]
#[test]
fn templates_that_lead_round_in_circles_are_refused() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::create_dir(folder.join("t")).unwrap();
    for name in ["t/a", "t/b", "t/c"] {
        symlink(".", folder.join(name)).unwrap();
    }
    let check = ["check", "--profile=quick", "--templates=t"];
    refused(folder, &check, &["read before"]);
    for name in ["t/a", "t/b", "t/c"] {
        std::fs::remove_file(folder.join(name)).unwrap();
    }
    let made = Command::new("mkfifo").arg(folder.join("t/pipe.md")).status();
    if made.is_ok_and(|status| status.success()) {
        refused(folder, &check, &["pipe.md", "no regular file"]);
    }
}

/// A folder of the output that is a link leads out of it; a file that is one is replaced.
#[cfg(unix)]
#[test]
fn nothing_is_written_outside_the_output() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for name in ["out", "outside", "good"] {
        std::fs::create_dir(folder.join(name)).unwrap();
    }
    let names = |path: &str| -> Vec<String> {
        let entries = std::fs::read_dir(folder.join(path)).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    };
    symlink("../outside", folder.join("out/data")).unwrap();
    let paper = ["paper", "--profile=quick", "--figure=4", "--out=out", "--force"];
    refused(folder, &paper, &["--out", "data", "symbolic link"]);
    assert_eq!(names("outside"), Vec::<String>::new());
    assert_eq!(names("out"), ["data"], "nothing is half-written");

    std::fs::write(folder.join("outside/kept"), "kept").unwrap();
    std::fs::create_dir(folder.join("good/data")).unwrap();
    symlink("../../outside/kept", folder.join("good/data/fig04.csv")).unwrap();
    symlink("good", folder.join("link")).unwrap();
    let paper = ["paper", "--profile=quick", "--figure=4", "--out=link", "--force"];
    let (code, error) = run(folder, &paper);
    assert_eq!(code, Some(0), "{error}");
    assert_eq!(std::fs::read_to_string(folder.join("outside/kept")).unwrap(), "kept");
    assert!(!folder.join("good/data/fig04.csv").is_symlink());
}
