//! The files of a report's folder, as they stand there: nobody vouches for them.

use super::waiting::is_staging;
use super::{Failure, typed};
use crate::experiments::Progress;
use crate::report::{LAB, sums};
use literate::input;
use std::io;
use std::path::{Component, Path, PathBuf};

/// What to do about a folder that is none of a report.
pub const REMEDY: &str = "give the folder of a report, or make one with `impact-paper paper`";

/// How a report is made anew where it stands.
pub fn anew(folder: &Path) -> String {
    match folder == Path::new("paper") {
        true => "`impact-paper paper --force`".into(),
        false => format!(
            "`impact-paper paper --out {} --force`, with the --profile that it was made with,",
            typed(folder)
        ),
    }
}

/// The folder without links and dots, as it will be where it is not there yet.
pub fn resolved(folder: &Path) -> PathBuf {
    let there = |path: &&Path| path.as_os_str().is_empty() || path.exists();
    let base = folder.ancestors().find(there).unwrap_or(Path::new(""));
    let begin = if base.as_os_str().is_empty() { Path::new(".") } else { base };
    let mut out = begin.canonicalize().unwrap_or_else(|_| begin.into());
    let mut back = false;
    for part in folder.strip_prefix(base).unwrap_or(folder).components() {
        match part {
            Component::ParentDir => back |= out.pop(),
            Component::CurDir => {}
            part => out.push(part),
        }
    }
    // It may lead back to what is there, and be a link.
    if back { resolved(&out) } else { out }
}

/// Paths of everything below a folder that is no folder itself, sorted, with slashes. Links are
/// listed and not followed. What a killed run left half-done is passed over: the next run removes it.
///
/// # Errors
/// Exit code 2 if a folder cannot be listed, 130 if the work was asked to end.
pub fn walk(folder: &Path, progress: &Progress) -> Result<Vec<String>, Failure> {
    let mut paths = Vec::new();
    let mut open = vec![(folder.to_path_buf(), String::new())];
    while let Some((at, prefix)) = open.pop() {
        let unreadable = |error: io::Error| Failure::io(&error, at.display(), REMEDY);
        for entry in std::fs::read_dir(&at).map_err(unreadable)? {
            progress.check()?;
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
    match path.split_once('/') {
        Some((folder, name)) => folder == "figures" && name.ends_with(".pdf"),
        None => path.ends_with(".html") || [LAB, sums::LOCAL].contains(&path),
    }
}

/// A file below a folder, whole. No link is followed on the way, since it might lead out of the
/// folder, and nothing but a regular file is opened, since others might never end.
///
/// # Errors
/// What is in the way; [`io::ErrorKind::NotFound`] if there is no such file.
pub fn read(folder: &Path, path: &str) -> io::Result<Vec<u8>> {
    let mut at = folder.to_path_buf();
    for name in path.split('/') {
        at.push(name);
        if std::fs::symlink_metadata(&at)?.is_symlink() {
            return Err(io::Error::other("it is a link, which is not followed"));
        }
    }
    input::regular(&at)
}

/// The same as text.
///
/// # Errors
/// As [`read`]; what is no text.
pub fn text(folder: &Path, path: &str) -> io::Result<String> {
    String::from_utf8(read(folder, path)?).map_err(|_| io::Error::other("it is no UTF-8 text"))
}

/// The list of what was last written into a folder, if it has one.
///
/// # Errors
/// What is wrong with it, with its name.
pub fn local(folder: &Path, remedy: &str) -> Result<Option<Vec<sums::Entry>>, Failure> {
    let place = || folder.join(sums::LOCAL).display().to_string();
    match text(folder, sums::LOCAL) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Failure::io(&error, place(), remedy)),
        Ok(text) => sums::lines(&text)
            .map(Some)
            .map_err(|error| Failure::input(format!("{}: {error}; {remedy}", place()))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn a_walk_sees_a_signal() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a"), "").unwrap();
        let walked =
            |stop| walk(folder.path(), &Progress::on_stderr(Arc::new(AtomicBool::new(stop))));
        assert_eq!(walked(false).unwrap(), ["a"]);
        assert_eq!(walked(true).unwrap_err().code, 130);
    }
}
