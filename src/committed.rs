//! Files of the project that the program reads when it runs: prose, printed numbers, times.
//!
//! None of them is compiled in, so a change of one word compiles nothing. Each is looked for below the
//! current folder, then in the checkout in which the program was built, which is a folder above the
//! program itself. A binary that is to travel alone is built with the feature `embed`: it has a copy
//! inside instead of that checkout.

use literate::input;
use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};

/// The copy inside: path from the top of the project, and text; empty without the feature `embed`.
const EMBEDDED: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/embedded.rs"));

/// What to do where a file is not found.
const REMEDY: &str = "run this in a checkout of impact-paper, or build it with --features embed";

/// Where a file lies, by its path from the top of the project; none if only the copy inside has it.
pub fn find(path: &str) -> Option<PathBuf> {
    let here = Path::new(path);
    if here.is_file() {
        return Some(here.into());
    }
    if !EMBEDDED.is_empty() {
        return None;
    }
    let program = std::env::current_exe().ok()?;
    program.ancestors().skip(1).map(|above| above.join(path)).find(|path| path.is_file())
}

/// The checkout, if there is one.
fn checkout() -> Option<PathBuf> {
    find("src/committed.rs")?.canonicalize().ok()?.ancestors().nth(2).map(Path::to_path_buf)
}

/// Whether a file or folder of the project is there. Without a checkout nobody can say, and it is believed.
pub fn exists(path: &str) -> bool {
    checkout().is_none_or(|top| top.join(path).exists())
}

/// The way from a folder, which may not be there yet, up to the checkout, as `../`; none if it lies outside.
pub fn top(folder: &Path) -> Option<String> {
    let folder = std::path::absolute(folder).ok()?;
    let real =
        |above: &Path| Some(above.canonicalize().ok()?.join(folder.strip_prefix(above).ok()?));
    let below =
        folder.ancestors().find_map(real)?.strip_prefix(checkout()?).ok()?.components().count();
    Some(if below == 0 { "./".into() } else { "../".repeat(below) })
}

/// The text of a file, by its path from the top of the project.
///
/// # Errors
/// As [`input::regular_text`]; [`io::ErrorKind::NotFound`] with what to do if there is no such file.
pub fn text(path: &str) -> io::Result<Cow<'static, str>> {
    if let Some(found) = find(path) {
        return input::regular_text(&found).map(Cow::Owned);
    }
    let copy = EMBEDDED.iter().find(|(own, _)| *own == path);
    let missing = || io::Error::new(io::ErrorKind::NotFound, format!("it is not there; {REMEDY}"));
    copy.map(|(_, text)| Cow::Borrowed(*text)).ok_or_else(missing)
}

/// The bytes of a file that is no text; none if it is not there, or cannot be read.
pub fn bytes(path: &str) -> Option<Vec<u8>> {
    find(path).and_then(|found| input::regular(&found).ok())
}

/// Files of the copy inside that lie below a folder, by their path relative to it.
pub fn embedded(folder: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let inside = move |path: &'static str| path.strip_prefix(folder)?.strip_prefix('/');
    EMBEDDED.iter().filter_map(move |(path, text)| Some((inside(path)?, *text)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_nowhere_is_an_error_that_helps() {
        assert!(text("templates/published.toml").unwrap().contains("[[statement]]"));
        let error = text("templates/no_such.md").unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
        assert!(error.to_string().contains("--features embed"), "{error}");
    }
}
