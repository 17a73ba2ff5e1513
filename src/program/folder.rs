//! The files of a report's folder, as they stand there: nobody vouches for them.

use super::Failure;
use super::output::is_staging;
use crate::report::sums;
use std::io::{self, Read};
use std::path::Path;

/// A file of a report is a few megabytes at most; what is larger is none.
const LARGEST: u64 = 64 << 20;

/// Paths of everything below a folder that is no folder itself, sorted, with slashes. Links are
/// listed and not followed. What a killed run left half-done is passed over: the next run removes it.
///
/// # Errors
/// Exit code 2 if a folder cannot be listed.
pub fn walk(folder: &Path) -> Result<Vec<String>, Failure> {
    let mut paths = Vec::new();
    let mut open = vec![(folder.to_path_buf(), String::new())];
    while let Some((at, prefix)) = open.pop() {
        let unreadable = |error: io::Error| {
            let remedy = "give the folder of a report, or make one with `impact-paper paper`";
            Failure::input(format!("{}: {error}; {remedy}", at.display()))
        };
        for entry in std::fs::read_dir(&at).map_err(unreadable)? {
            let entry = entry.map_err(unreadable)?;
            let path = format!("{prefix}{}", entry.file_name().to_string_lossy());
            if prefix.is_empty() && is_staging(folder, &path) {
                continue;
            }
            if entry.file_type().map_err(unreadable)?.is_dir() {
                open.push((entry.path(), format!("{path}/")));
            } else {
                paths.push(path);
            }
        }
    }
    paths.sort();
    Ok(paths)
}

/// Built beside the files of a report, or the list of what is, and never a part of it: .gitignore names
/// them.
pub fn is_beside(path: &str) -> bool {
    path.ends_with(".pdf") || path.ends_with(".html") || path == sums::LOCAL
}

/// A file below a folder, whole. No link is followed on the way, since it might lead out of the
/// folder, and nothing but a regular file is opened, since others might never end.
///
/// # Errors
/// What is in the way; [`io::ErrorKind::NotFound`] if there is no such file.
pub fn read(folder: &Path, path: &str) -> io::Result<Vec<u8>> {
    let mut at = folder.to_path_buf();
    let mut size = 0;
    let mut names = path.split('/').peekable();
    while let Some(name) = names.next() {
        at.push(name);
        let data = std::fs::symlink_metadata(&at)?;
        if data.is_symlink() {
            return Err(io::Error::other("a link, which is not followed"));
        }
        if names.peek().is_none() && !data.is_file() {
            return Err(io::Error::other("not a file"));
        }
        size = data.len();
    }
    if size > LARGEST {
        return Err(io::Error::other("too large for a file of a report"));
    }
    let mut bytes = Vec::new();
    std::fs::File::open(&at)?.take(LARGEST).read_to_end(&mut bytes)?;
    Ok(bytes)
}
