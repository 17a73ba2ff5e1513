//! The committed source, as git lists it.

use impact_paper::input::one_line;
use impact_paper::program::{Failure, git};
use impact_paper::report::sums;
use std::io::ErrorKind;

/// A revision without uncommitted changes.
pub struct Tree {
    /// Its hash.
    pub revision: String,
    /// Paths of its files, sorted, and whether each is a program.
    pub files: Vec<(String, bool)>,
}

impl Tree {
    /// The source in the folder where the program runs.
    ///
    /// # Errors
    /// Exit code 2 if this is not the top folder of a clone, or something is not committed.
    pub fn here() -> Result<Self, Failure> {
        let remedy = "run it in the top folder of a clone of impact-paper";
        let needed = |what: String| Failure::input(format!("bundle: {what}; {remedy}"));
        let ask = |arguments: &[&str]| match git::git(arguments) {
            Ok(Ok(bytes)) => Ok(String::from_utf8_lossy(&bytes).into_owned()),
            Ok(Err(told)) => Err(needed(format!(
                "this is no clone of git with a commit ({})",
                one_line(&told, 200)
            ))),
            Err(error) if error.kind() == ErrorKind::NotFound => Err(Failure::input(
                "bundle: it packs what is committed, and there is no git; install git",
            )),
            Err(error) => Err(needed(format!("git: {error}"))),
        };
        if !ask(&["rev-parse", "--show-prefix"])?.trim().is_empty() {
            return Err(needed("this is a folder inside a clone".into()));
        }
        let changed = ask(&["status", "--porcelain", "-z"])?;
        if let Some(first) = changed.split('\0').find(|line| !line.is_empty()) {
            let path = first.get(3..).unwrap_or(first);
            let what =
                format!("bundle: {path} is not committed; commit it, remove it, or put it aside");
            return Err(Failure::input(what));
        }
        let revision = ask(&["rev-parse", "--verify", "HEAD"])?.trim().to_string();
        let mut files = Vec::new();
        for line in ask(&["ls-files", "--stage", "-z"])?.split('\0').filter(|line| !line.is_empty())
        {
            let (mode, path) = (line.split(' ').next(), line.split_once('\t'));
            match (mode, path) {
                (Some(mode @ ("100644" | "100755")), Some((_, path))) if sums::is_inside(path) => {
                    files.push((path.to_string(), mode == "100755"));
                }
                _ => return Err(needed(format!("{line:?} is no ordinary file"))),
            }
        }
        files.sort();
        Ok(Tree { revision, files })
    }
}
