//! SHA256SUMS: what a report consists of, in the form of `sha256sum`; and SHA256SUMS.local: what was last
//! written into a folder, with what is built beside a report and never committed.

use super::assemble::Files;
use crate::digest::sha256;
use crate::input::one_line;
use std::fmt;
use std::path::{Component, Path};

/// The file's name in the report's folder.
pub const NAME: &str = "SHA256SUMS";

/// The name of the list of everything that was last written into a folder; it is never committed.
pub const LOCAL: &str = "SHA256SUMS.local";

/// One line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Path below the report's folder: names and slashes only.
    pub path: String,
    /// 64 lower-case hexadecimal digits.
    pub digest: String,
}

/// A line that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Malformed {
    /// Its number, from 1.
    pub line: usize,
    /// What is wrong with it.
    pub what: String,
}

impl fmt::Display for Malformed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.what)
    }
}

/// Lines that `sha256sum --check` reads, sorted by path.
pub fn write(files: &Files) -> String {
    files.iter().map(|(path, bytes)| format!("{}  {path}\n", sha256(bytes))).collect()
}

/// Reads the lines of a list in which each path stands once.
pub fn read(text: &str) -> Result<Vec<Entry>, Malformed> {
    let entries = lines(text)?;
    let mut paths = std::collections::BTreeSet::new();
    match entries.iter().position(|entry| !paths.insert(&entry.path)) {
        Some(i) => Err(Malformed { line: i + 1, what: "its path is listed twice".into() }),
        None => Ok(entries),
    }
}

/// Reads the lines. Whoever wrote them is not trusted: a path stays below the folder, at least by
/// its letters (links are for the caller to refuse). While files are replaced, [`LOCAL`] has the old digest of
/// each before the new one.
pub fn lines(text: &str) -> Result<Vec<Entry>, Malformed> {
    let mut entries: Vec<Entry> = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let malformed = |what: &str| Malformed { line: i + 1, what: what.into() };
        let form = "it is not 64 hexadecimal digits, two blanks and a path";
        let (digest, path) = line.split_once("  ").ok_or(malformed(form))?;
        let digit = |byte: u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte);
        if digest.len() != 64 || !digest.bytes().all(digit) {
            return Err(malformed(form));
        }
        if !is_inside(path) {
            let path = one_line(path, 200);
            return Err(malformed(&format!("{path:?} is no path of a file below this folder")));
        }
        if path == NAME || path == LOCAL {
            return Err(malformed("the list cannot list itself"));
        }
        entries.push(Entry { path: path.into(), digest: digest.into() });
    }
    if entries.is_empty() {
        return Err(Malformed { line: 1, what: "no file is listed".into() });
    }
    Ok(entries)
}

/// Whether a path is written as names with slashes between, so that it cannot climb or start anew.
pub fn is_inside(path: &str) -> bool {
    let plain = |c: char| !c.is_control() && c != '\\';
    let names = Path::new(path).components().all(|part| matches!(part, Component::Normal(_)));
    // `components` passes over a dot, a double slash and a slash at the end.
    let tidy = path.split('/').all(|name| !name.is_empty() && name != ".");
    names && tidy && path.chars().all(plain)
}

/// Could a report list such a file? Documents stand in its folder itself, what figures show and data below it.
pub fn is_of_report(path: &str) -> bool {
    let named = |name: &str, end: &str| {
        let stem = name.strip_suffix(end).unwrap_or_default();
        !stem.is_empty() && !stem.starts_with('.')
    };
    match path.split_once('/') {
        None => [".md", ".tex", ".json"].into_iter().any(|end| named(path, end)),
        Some(("figures", name)) => !name.contains('/') && named(name, ".svg"),
        Some(("data", name)) => !name.contains('/') && named(name, ".csv"),
        Some(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let files: Files = [("b.md", "b"), ("a/c.csv", "")]
            .map(|(path, text)| (path.to_string(), text.as_bytes().to_vec()))
            .into();
        let text = write(&files);
        let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert!(text.starts_with(&format!("{empty}  a/c.csv\n")), "{text}");
        let read = read(&text).unwrap();
        assert_eq!(read.iter().map(|e| e.path.as_str()).collect::<Vec<_>>(), ["a/c.csv", "b.md"]);
        assert_eq!(read[0].digest, empty);
    }

    #[test]
    fn a_report_has_documents_figures_and_data() {
        for path in ["report.md", "second.tex", "values.json", "figures/s01.svg", "data/all.csv"] {
            assert!(is_of_report(path), "{path}");
        }
        for path in [
            ".git/config",
            ".md",
            "notes.txt",
            "Makefile",
            "src/main.rs",
            "data/.csv",
            "data/a/b.csv",
            "figures/a.csv",
            "data",
            "/data/a.csv",
            "../a.md",
            "figures/../a.svg",
        ] {
            assert!(!is_of_report(path), "{path}");
        }
    }

    #[test]
    fn lines_of_another_form_are_named() {
        let digest = sha256(b"");
        let good = format!("{digest}  a\n");
        for (line, what) in [
            (digest.clone(), "not 64"),
            (format!("{}  a", &digest[1..]), "not 64"),
            (format!("{}  a", digest.to_uppercase()), "not 64"),
            (format!("{digest} *a"), "not 64"),
            (String::new(), "not 64"),
            (format!("{digest}  ../b"), "below"),
            (format!("{digest}  b/../../c"), "below"),
            (format!("{digest}  /etc/passwd"), "below"),
            (format!("{digest}  ./b"), "below"),
            (format!("{digest}  b/"), "below"),
            (format!("{digest}  b//c"), "below"),
            (format!("{digest}  "), "below"),
            (format!("{digest}  b\\c"), "below"),
            (format!("{digest}  b\u{7}"), "below"),
            (format!("{digest}  a"), "twice"),
            (format!("{digest}  {NAME}"), "itself"),
        ] {
            let fault = read(&format!("{good}{line}\n")).unwrap_err();
            assert_eq!(fault.line, 2, "{line:?}");
            assert!(fault.what.contains(what), "{line:?}: {fault}");
        }
        assert!(read("").is_err());
    }
}
