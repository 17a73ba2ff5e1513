//! `impact-paper verify`: what a folder says of itself, held against what stands in it.

use crate::{QUICK, TEMPLATES, answer, digest, ended, outcome, program, put, refused, run};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// A folder that looks like a report, and its list.
fn small() -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let paper = folder.path().join("paper");
    fs::create_dir_all(paper.join("data")).unwrap();
    let mut list = String::new();
    for path in ["data/a.csv", "report.md"] {
        fs::write(paper.join(path), path).unwrap();
        list += &format!("{}  {path}\n", digest(path));
    }
    fs::write(paper.join("SHA256SUMS"), &list).unwrap();
    (folder, list)
}

/// Exit code 1, these lines, and one on stderr with these words.
fn faults(folder: &Path, lines: &[&str], words: &str) {
    let (code, told, note) = run(folder, "verify");
    assert_eq!((code, told.lines().collect::<Vec<_>>()), (1, lines.to_vec()));
    assert!(note.contains(words) && note.lines().count() == 1, "{note}");
}

#[test]
fn what_is_as_listed_is_fine_with_what_is_built_beside() {
    let (folder, _) = small();
    let paper = folder.path().join("paper");
    let write = |path: &str, text: &str| fs::write(paper.join(path), text).unwrap();
    write("report.html", "page");
    write("lab.js", "");
    // Of a revision that was here before, but for what is built beside.
    let [page, script, other] = ["page", "", "other"].map(digest);
    let local = format!("{script}  lab.js\n{page}  report.html\n{other}  report.md\n");
    write("SHA256SUMS.local", &local);
    fs::create_dir(paper.join(".staging-impact-paper-1")).unwrap();
    write(".staging-impact-paper-1/report.md", "half");
    write(".staging-impact-paper-1/.impact-paper", "");
    let fine = "paper: 4 files, all as SHA256SUMS lists them\n";
    assert_eq!(answer(folder.path(), "verify"), fine);
    // A page that somebody else put there, in place of ours or where none was made.
    write("report.html", "planted");
    faults(folder.path(), &["differs  report.html"], "--force");
    fs::remove_file(paper.join("lab.js")).unwrap();
    faults(folder.path(), &["missing  lab.js", "differs  report.html"], "--force");
    write("lab.js", "");
    fs::remove_file(paper.join("SHA256SUMS.local")).unwrap();
    let unlisted = ["unlisted lab.js", "unlisted report.html"];
    faults(folder.path(), &unlisted, "remove what is not listed");
    // Ended before the list came: a first report, or all of it moved away.
    fs::remove_file(paper.join("SHA256SUMS")).unwrap();
    refused(folder.path(), "verify", &["SHA256SUMS", "was ended, or goes on", "--force"]);
    fs::remove_dir_all(paper.join(".staging-impact-paper-1")).unwrap();
    refused(folder.path(), "verify", &["SHA256SUMS: No such file"]);
}

#[test]
fn edited_missing_and_unlisted_files_are_named() {
    let (folder, _) = small();
    let paper = folder.path().join("paper");
    fs::write(paper.join("report.md"), "report.mD").unwrap();
    fs::remove_file(paper.join("data/a.csv")).unwrap();
    fs::write(paper.join("data/b.csv"), "").unwrap();
    let lines = ["missing  data/a.csv", "differs  report.md", "unlisted data/b.csv"];
    faults(folder.path(), &lines, "3 faults");
}

/// Which lines a list cannot have is told by the unit tests of `sums`.
#[test]
fn lists_that_cannot_be_trusted_are_refused_with_their_line() {
    let (folder, list) = small();
    let write = |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).unwrap();
    write("outside", b"outside");
    let outside = format!("{list}{}  ../outside\n", digest("outside"));
    write("paper/SHA256SUMS", outside.as_bytes());
    refused(folder.path(), "verify", &["SHA256SUMS: line 3: "]);
    write("paper/SHA256SUMS", list.as_bytes());
    write("paper/SHA256SUMS.local", b"nonsense");
    refused(folder.path(), "verify", &["paper/SHA256SUMS.local: line 1: ", "--force"]);
    write("paper/SHA256SUMS", b"\xff\xfe");
    refused(folder.path(), "verify", &["SHA256SUMS"]);
    let (code, _, note) = run(small().0.path(), "verify --rerun");
    assert!(code == 2 && note.contains("values.json cannot be read; restore it"), "{note}");
}

/// Neither a link to a file, nor one to a folder, nor a pipe that would never end.
#[test]
fn nothing_leads_out_of_the_folder() {
    let (folder, list) = small();
    let paper = folder.path().join("paper");
    fs::create_dir(folder.path().join("away")).unwrap();
    for path in ["away/x", "secret"] {
        fs::write(folder.path().join(path), "secret").unwrap();
    }
    std::os::unix::fs::symlink("../secret", paper.join("link")).unwrap();
    std::os::unix::fs::symlink("../away", paper.join("door")).unwrap();
    assert!(Command::new("mkfifo").arg(paper.join("pipe")).status().unwrap().success());
    let secret = digest("secret");
    let more = format!("{list}{secret}  link\n{secret}  door/x\n{secret}  pipe\n");
    fs::write(paper.join("SHA256SUMS"), more).unwrap();
    let lines = [
        "unread   door/x (it is a link, which is not followed)",
        "unread   link (it is a link, which is not followed)",
        "unread   pipe (it is no regular file)",
        "unlisted door",
    ];
    faults(folder.path(), &lines, "4 faults");
}

#[test]
fn a_rerun_finds_what_the_list_cannot() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let templates = format!("--templates {TEMPLATES}");
    put(&here.join("r"), &QUICK.report);
    put(&here.join("saved"), &QUICK.results);

    // Without saved results, by the profile that the report names, on another number of threads.
    let (code, told, note) = run(here, &format!("verify r --rerun --threads 3 {templates}"));
    assert_eq!(code, 0, "{told}{note}");
    assert!(note.contains("sweep: run\n"), "{note}");
    assert!(told.contains("made again with the quick profile, the same bytes"), "{told}");
    let count = |line: &str| line.split(' ').nth(1).unwrap().parse::<usize>().unwrap();
    let counts: Vec<usize> = told.lines().map(count).collect();
    // The list is made again too, and does not list itself.
    assert_eq!(counts, [counts[0], counts[0] + 1]);
    let rerun = format!("verify r --rerun --results saved {templates}");
    assert_eq!(run(here, &rerun).0, 0);
    let mut within = program(here, &format!("verify r --rerun {templates}"));
    let (code, _, note) = outcome(within.env("TMPDIR", here.join("r")));
    assert!(code == 2 && note.contains("TMPDIR: "), "{note}");

    // A forger who keeps the lists right, of the report and of what is built beside.
    let edit = |name: &str, change: &dyn Fn(String) -> String| {
        let path = here.join("r").join(name);
        fs::write(&path, change(fs::read_to_string(&path).unwrap())).unwrap();
    };
    let before = fs::read_to_string(here.join("r/data/fig02.csv")).unwrap();
    edit("data/fig02.csv", &|text| format!("{text}9\n"));
    for name in ["more.csv", "planted.html"] {
        fs::write(here.join("r").join(name), "").unwrap();
    }
    let (old, new) = (digest(&before), digest(format!("{before}9\n")));
    edit("SHA256SUMS", &|list| format!("{}{}  more.csv\n", list.replace(&old, &new), digest("")));
    edit("SHA256SUMS.local", &|list| format!("{list}{}  planted.html\n", digest("")));
    assert_eq!(run(here, "verify r").0, 0);
    let (code, told, note) = run(here, &rerun);
    assert_eq!(code, 1, "{told}{note}");
    assert!(note.contains("4 faults") && note.contains("sweep: fresh"), "{note}");
    let lines: Vec<&str> = told.lines().skip(1).collect();
    let names = ["differs  SHA256SUMS", "differs  data/fig02.csv", "not made more.csv"];
    let names = names.into_iter().chain(["not made planted.html"]);
    assert_eq!(lines, names.map(|name| format!("rerun: {name}")).collect::<Vec<_>>());
}

#[test]
fn ctrl_c_ends_a_rerun() {
    let folder = tempfile::tempdir().unwrap();
    let [temporary, paper] = ["tmp", "paper"].map(|name| folder.path().join(name));
    fs::create_dir(&temporary).unwrap();
    put(&paper, &QUICK.report);
    let values = paper.join("values.json");
    let text = fs::read_to_string(&values).unwrap();
    fs::write(&values, text.replacen("\"quick\"", "\"full\"", 1)).unwrap();
    let rerun = format!("verify --rerun --templates {TEMPLATES}");
    let mut command = program(folder.path(), &rerun);
    command.env("TMPDIR", &temporary).stderr(Stdio::null());
    ended(&mut command, "-INT");
    assert_eq!(fs::read_dir(temporary).unwrap().count(), 0);
}
