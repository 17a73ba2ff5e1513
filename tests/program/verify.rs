//! `impact-paper verify`: what a folder says of itself, held against what stands in it.

use crate::{QUICK, TEMPLATES, digest, ended, program, put, refused, run};
use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

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

#[test]
fn what_is_as_listed_is_fine_with_what_is_built_beside() {
    let (folder, _) = small();
    let paper = folder.path().join("paper");
    fs::write(paper.join("report.html"), "page").unwrap();
    fs::write(paper.join("data/a.pdf"), "").unwrap();
    // Of a revision that was here before, but for what is built beside.
    let (page, pdf, other) = (digest("page"), digest(""), digest("other"));
    let local =
        format!("{pdf}  data/a.pdf\n{page}  report.html\n{other}  report.md\n{pdf}  report.pdf\n");
    fs::write(paper.join("SHA256SUMS.local"), local).unwrap();
    fs::create_dir(paper.join(".staging-impact-paper-1")).unwrap();
    fs::write(paper.join(".staging-impact-paper-1/report.md"), "half").unwrap();
    fs::write(paper.join(".staging-impact-paper-1/.impact-paper"), "").unwrap();
    let (code, told, note) = run(folder.path(), "verify");
    assert_eq!((code, note.as_str()), (0, ""), "{told}");
    assert_eq!(told, "paper: 4 files, all as SHA256SUMS lists them\n");
    // A page that somebody else put there, in place of ours or where none was made.
    fs::write(paper.join("report.html"), "planted").unwrap();
    let (code, told, note) = run(folder.path(), "verify");
    assert_eq!((code, told.as_str()), (1, "differs  report.html\n"));
    assert!(note.contains("--force"), "{note}");
    fs::remove_file(paper.join("SHA256SUMS.local")).unwrap();
    let (code, told, note) = run(folder.path(), "verify");
    assert_eq!((code, told.as_str()), (1, "unlisted data/a.pdf\nunlisted report.html\n"));
    assert!(note.contains("remove what is not listed"), "{note}");
}

#[test]
fn edited_missing_and_unlisted_files_are_named() {
    let (folder, _) = small();
    let paper = folder.path().join("paper");
    fs::write(paper.join("report.md"), "report.mD").unwrap();
    fs::remove_file(paper.join("data/a.csv")).unwrap();
    fs::write(paper.join("data/b.csv"), "").unwrap();
    let (code, told, note) = run(folder.path(), "verify paper");
    assert_eq!(code, 1);
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines, ["missing  data/a.csv", "differs  report.md", "unlisted data/b.csv"]);
    assert!(note.contains("3 faults") && note.trim_end().lines().count() == 1, "{note}");
}

#[test]
fn lists_that_cannot_be_trusted_are_refused_with_their_line() {
    let (folder, list) = small();
    fs::write(folder.path().join("outside"), "outside").unwrap();
    let (outside, absolute) = (digest("outside"), folder.path().join("outside"));
    for line in [
        "nonsense".to_string(),
        format!("{outside}  ../outside"),
        format!("{outside}  {}", absolute.display()),
        format!("{outside}  report.md"),
    ] {
        fs::write(folder.path().join("paper/SHA256SUMS"), format!("{list}{line}\n")).unwrap();
        refused(folder.path(), "verify", &["SHA256SUMS: line 3: "]);
    }
    fs::write(folder.path().join("paper/SHA256SUMS"), list).unwrap();
    fs::write(folder.path().join("paper/SHA256SUMS.local"), "nonsense").unwrap();
    refused(folder.path(), "verify", &["paper/SHA256SUMS.local: line 1: ", "--force"]);
    fs::write(folder.path().join("paper/SHA256SUMS"), b"\xff\xfe").unwrap();
    assert_eq!(run(folder.path(), "verify").0, 2);
    let (code, _, note) = run(small().0.path(), "verify --rerun");
    assert!(code == 2 && note.contains("--profile"), "{note}");
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
    let (code, told, _) = run(folder.path(), "verify");
    assert_eq!(code, 1);
    let lines: Vec<&str> = told.lines().collect();
    let link = "(it is a link, which is not followed)";
    assert_eq!(
        lines,
        [
            &format!("unread   door/x {link}"),
            &format!("unread   link {link}"),
            "unread   pipe (it is no regular file)",
            "unlisted door",
        ]
    );
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
    assert!(note.contains("sweep: run (no saved result)"), "{note}");
    assert!(told.contains("made again with the quick profile, the same bytes"), "{told}");
    let count = |line: &str| line.split(' ').nth(1).unwrap().parse::<usize>().unwrap();
    let counts: Vec<usize> = told.lines().map(count).collect();
    // The list is made again too, and does not list itself.
    assert_eq!(counts, [counts[0], counts[0] + 1]);
    let rerun = format!("verify r --rerun --results saved {templates}");
    assert_eq!(run(here, &rerun).0, 0);

    // A forger who keeps the list right.
    let path = here.join("r/data/fig02.csv");
    let before = fs::read_to_string(&path).unwrap();
    fs::write(&path, format!("{before}9\n")).unwrap();
    fs::write(here.join("r/more.csv"), "").unwrap();
    let list = fs::read_to_string(here.join("r/SHA256SUMS")).unwrap();
    let forged = list.replace(&digest(&before), &digest(format!("{before}9\n")));
    assert_ne!(forged, list);
    let forged = format!("{forged}{}  more.csv\n", digest(""));
    fs::write(here.join("r/SHA256SUMS"), forged).unwrap();
    // A page of theirs, in the list of what is built beside.
    fs::write(here.join("r/planted.html"), "").unwrap();
    let local = fs::read_to_string(here.join("r/SHA256SUMS.local")).unwrap();
    let local = format!("{local}{}  planted.html\n", digest(""));
    fs::write(here.join("r/SHA256SUMS.local"), local).unwrap();
    assert_eq!(run(here, "verify r").0, 0);
    let (code, told, note) = run(here, &rerun);
    assert_eq!(code, 1, "{told}{note}");
    assert!(note.contains("4 faults"), "{note}");
    assert!(note.contains("sweep: fresh"), "{note}");
    let lines: Vec<&str> = told.lines().skip(1).collect();
    let names = [
        "differs  SHA256SUMS",
        "differs  data/fig02.csv",
        "not made more.csv",
        "not made planted.html",
    ];
    assert_eq!(lines, names.map(|name| format!("rerun: {name}")));
}

#[test]
fn ctrl_c_ends_a_rerun() {
    let (folder, _) = small();
    let temporary = folder.path().join("tmp");
    fs::create_dir(&temporary).unwrap();
    let rerun = format!("verify --rerun --profile full --templates {TEMPLATES}");
    let mut command = program(folder.path(), &rerun);
    command.env("TMPDIR", &temporary).stderr(Stdio::null());
    ended(&mut command, "-INT", Duration::from_secs(10));
    assert_eq!(fs::read_dir(temporary).unwrap().count(), 0);
}
