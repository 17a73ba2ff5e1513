//! The verb `diff`.

use super::terminal::{print, shown};
use crate::failure::Failure;
use crate::input::one_line;
use crate::report::compare::{self, Parts};
use crate::report::{Files, folder};
use serde_json::json;
use std::path::Path;
use std::process::Command;

/// Say what differs between two reports: verdicts, numbers, files
///
/// Examples:
///   diff paper target/paper          two folders
///   diff v1.0.0 paper                a revision of git, whose folder paper/ is meant, and a folder
///
/// A difference is no failure: the exit code is 0 unless --exit-code asks for more.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// The earlier report.
    #[arg(value_name = "OLD")]
    old: String,
    /// The later one.
    #[arg(value_name = "NEW")]
    new: String,
    /// Print everything as JSON.
    #[arg(long)]
    json: bool,
    /// End with exit code 1 if anything differs.
    #[arg(long)]
    exit_code: bool,
}

pub(super) fn run(args: Args) -> Result<(), Failure> {
    let [before, after] = [parts(&args.old)?, parts(&args.new)?];
    let diff = compare::diff(&before, &after);
    let [old, new] = [&args.old, &args.new].map(|name| shown(Path::new(name)));
    let json = || json!({"old": old, "new": new, "same": diff.is_empty(), "diff": diff});
    let told = if args.json { format!("{:#}\n", json()) } else { diff.text(&old, &new) };
    print(&told)?;
    match diff.is_empty() || !args.exit_code {
        true => Ok(()),
        false => Err(Failure::check(format!("{} and {} differ", args.old, args.new))),
    }
}

/// A report by its folder or revision, without the files that are never committed.
fn parts(name: &str) -> Result<Parts, Failure> {
    let files = if Path::new(name).is_dir() { standing(name)? } else { committed(name)? };
    Parts::of(name, files).map_err(|what| Failure::input(format!("{what}; is it a report?")))
}

/// The files in a folder.
fn standing(name: &str) -> Result<Files, Failure> {
    let root = Path::new(name);
    let paths = folder::walk(root)?;
    let read = |path: String| {
        let fault = |error| Failure::io(&error, format!("{name}: {path}"), "is it a report?");
        let bytes = folder::read(root, &path).map_err(fault)?;
        Ok((path, bytes))
    };
    paths.into_iter().filter(|path| !folder::is_beside(path)).map(read).collect()
}

/// What git prints, or why it does not.
fn git(arguments: &[&str]) -> Result<Vec<u8>, String> {
    let output = Command::new("git").arg("--no-pager").args(arguments).output();
    let output = output.map_err(|error| format!("git: {error}"))?;
    let words = String::from_utf8_lossy(&output.stderr);
    if output.status.success() { Ok(output.stdout) } else { Err(words.into_owned()) }
}

/// The files of a revision below paper/, from where the program runs, as git has stored them.
fn committed(name: &str) -> Result<Files, Failure> {
    let neither = |told: String| {
        let what = "neither a folder nor a revision of git with a report in ./paper here";
        let told = one_line(&told, 200);
        let remedy = "give the folder of a report, a tag or a commit";
        Failure::input(format!("{name}: {what} ({told}); {remedy}"))
    };
    let git = |arguments: &[&str]| git(arguments).map_err(neither);
    // What git would take for an option, a path or a range is no revision.
    let odd = |c: char| c.is_control() || c.is_whitespace() || c == ':';
    if name.is_empty() || name.starts_with('-') || name.contains(odd) || name.contains("..") {
        return Err(neither("the name is none".into()));
    }
    let list =
        git(&["ls-tree", "-r", "-z", "--full-tree", "--name-only", &format!("{name}:./paper")])?;
    let list = String::from_utf8_lossy(&list).into_owned();
    let paths = list.split_terminator('\0').filter(|path| !folder::is_beside(path));
    let read = |path: &str| {
        Ok((path.to_string(), git(&["cat-file", "blob", &format!("{name}:./paper/{path}")])?))
    };
    paths.map(read).collect()
}
