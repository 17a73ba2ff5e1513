//! The report of a revision of git, read by the git command.

use super::super::Failure;
use impact_paper::report::{Files, folder};
use literate::input::one_line;
use std::io::ErrorKind;

/// The folder of the report in a revision, from where the program runs.
const FOLDER: &str = "./paper";

/// Its files.
///
/// # Errors
/// Exit code 2 if there is no such folder or revision, or no git.
pub fn files(name: &str) -> Result<Files, Failure> {
    let neither = |told: String| {
        let told = if told.is_empty() { told } else { format!(" ({})", one_line(&told, 200)) };
        let name = if name.is_empty() { "an empty name" } else { name };
        let what = format!("neither a folder nor a revision of git here{told}");
        Failure::input(format!("{name}: {what}; give the folder of a report, a tag or a commit"))
    };
    // What git would take for an option, a path or a range is no revision.
    let odd = |c: char| c.is_control() || c.is_whitespace() || c == ':';
    if name.is_empty() || name.starts_with('-') || name.contains(odd) || name.contains("..") {
        return Err(neither(String::new()));
    }
    let commit = format!("{name}^{{commit}}");
    let commit = git(name, &["rev-parse", "--verify", &commit])?.map_err(neither)?;
    let commit = String::from_utf8_lossy(&commit).trim().to_string();
    if commit.is_empty() || !commit.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return Err(neither(String::new()));
    }
    let no_report = |told: String| {
        let told = one_line(&told, 200);
        Failure::input(format!(
            "{name}: this revision has no folder paper/ here ({told}); give one that has, from the top of the checkout"
        ))
    };
    let tree = format!("{commit}:{FOLDER}");
    let list = git(name, &["ls-tree", "-r", "-z", "--full-tree", "--long", &tree])?;
    let list = String::from_utf8_lossy(&list.map_err(no_report)?).into_owned();
    // Mode, kind, object and length, and the path behind a tab.
    let line = |line: &'_ str| {
        let (head, path) = line.split_once('\t')?;
        let length = head.rsplit(' ').next()?.parse().unwrap_or(0);
        Some((path.to_string(), length))
    };
    let meant = |(path, _): &(String, u64)| !folder::is_beside(path);
    let listed: Vec<(String, u64)> = list.split('\0').filter_map(line).filter(meant).collect();
    super::bounded(name, listed.iter().map(|(path, length)| (path.as_str(), *length)))?;
    let mut files = Files::new();
    for (path, _) in listed {
        // As it is stored: `git show` might convert it.
        let bytes = git(name, &["cat-file", "blob", &format!("{commit}:{FOLDER}/{path}")])?;
        let unread = |told: String| {
            let told = one_line(&told, 200);
            let remedy = "see whether `git fsck` finds a fault, or give another revision";
            Failure::input(format!("{name}: paper/{path} cannot be read ({told}); {remedy}"))
        };
        let bytes = bytes.map_err(unread)?;
        files.insert(path, bytes);
    }
    Ok(files)
}

/// What git prints, or why it does not.
fn git(name: &str, arguments: &[&str]) -> Result<Result<Vec<u8>, String>, Failure> {
    super::super::git::git(arguments).map_err(|error| match error.kind() {
        ErrorKind::NotFound => Failure::input(format!(
            "{name}: no such folder, and there is no git to ask for a revision; install git, or give a folder"
        )),
        _ => Failure::input(format!("{name}: git: {error}; give a folder")),
    })
}
