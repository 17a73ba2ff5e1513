//! Reads files up to a bounded size, computes their hashes, and prepares text for messages.

use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt;
use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::panic::Location;
use std::path::Path;
use std::sync::RwLock;

/// MiB at most of a file that is read whole. A scenario of a million masses has less.
pub const MOST: u64 = 64;

/// Reads text from an open file; one beyond [`MOST`] MiB or not in UTF-8 is an error.
pub fn read_from(file: impl Read) -> Result<String, Error> {
    decode(read_bounded(file)?)
}

/// Reads a whole file, if it is a regular one: opening a pipe waits for its other end.
pub fn read_file(path: &Path) -> Result<Vec<u8>, Error> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(Error::new(ErrorKind::InvalidInput, "not a regular file"));
    }
    read_bounded(File::open(path)?)
}

pub(crate) fn read_text(path: &Path) -> Result<String, Error> {
    decode(read_file(path)?)
}

/// Reads text without a byte-order mark; lines end in `\n` however they end in the file.
fn decode(bytes: Vec<u8>) -> Result<String, Error> {
    let wrong = |_| Error::new(ErrorKind::InvalidData, "not valid UTF-8");
    let content = String::from_utf8(bytes).map_err(wrong)?;
    let content = content.trim_start_matches('\u{feff}');
    Ok(if content.contains('\r') { content.replace("\r\n", "\n") } else { content.into() })
}

fn read_bounded(file: impl Read) -> Result<Vec<u8>, Error> {
    let (mut bytes, most) = (Vec::new(), MOST << 20);
    file.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(Error::new(ErrorKind::InvalidInput, format!("it is longer than {MOST} MiB")));
    }
    Ok(bytes)
}

/// Computes the SHA-256 of bytes, in lower-case hexadecimal digits.
pub fn sha256(bytes: impl AsRef<[u8]>) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Lists a file, or all files below a folder, links included, by their paths from the folder `top`.
/// An error names the path that is missing or cannot be opened.
pub(crate) fn list_files(top: &Path, place: &str) -> Result<Vec<String>, Error> {
    let (mut files, mut open) = (Vec::new(), vec![place.to_string()]);
    while let Some(path) = open.pop() {
        let here = top.join(&path);
        let named = |error: Error| Error::new(error.kind(), format!("{path}: {error}"));
        if here.is_dir() {
            for entry in here.read_dir().map_err(named)? {
                open.push(format!("{path}/{}", entry?.file_name().to_string_lossy()));
            }
        } else if here.metadata().map_err(named)?.is_file() {
            File::open(&here).map_err(named)?;
            files.push(path);
        } else {
            return Err(named(Error::new(ErrorKind::InvalidInput, "not a regular file")));
        }
    }
    Ok(files)
}

/// Computes the SHA-256 of the files that [`list_files`] lists, of whatever size.
pub(crate) fn hash_files(top: &Path, place: &str) -> Result<BTreeMap<String, String>, Error> {
    let hash = |path: String| Ok((path.clone(), sha256(std::fs::read(top.join(path))?)));
    list_files(top, place)?.into_iter().map(hash).collect()
}

pub(crate) fn is_absent(error: &Error) -> bool {
    [ErrorKind::NotFound, ErrorKind::NotADirectory].contains(&error.kind())
}

/// Returns what to do about an error of the system, which is `otherwise` if the place is at fault.
pub(crate) fn remedy<'a>(error: &Error, otherwise: &'a str) -> &'a str {
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::WriteZero => "make room",
        ErrorKind::InvalidData => "save it as UTF-8",
        ErrorKind::NotADirectory | ErrorKind::AlreadyExists => {
            "a file is in the way; choose another folder"
        }
        _ => otherwise,
    }
}

/// Prefix of the names of files and folders that are not yet complete.
pub(crate) const STAGING: &str = ".staging-literate-";

/// Held for reading while files are put into place, and for writing when the program ends.
pub(crate) static WRITING: RwLock<()> = RwLock::new(());

/// Describes a TOML error with its line, from 1, and a remedy: `12: missing field …; correct …`.
pub(crate) fn toml_fault(toml: &str, error: &toml::de::Error) -> String {
    let before = error.span().and_then(|span| toml.get(..span.start)).unwrap_or_default();
    let problem = one_line(&in_plain_words(error.message()), 300);
    format!("{}: {problem}; correct this line, or restore the file", line_number(before))
}

/// Returns the number of the line that a text ends in, from 1.
pub(crate) fn line_number(before: &str) -> usize {
    before.matches('\n').count() + 1
}

/// A place in a file, with line and column in characters, from 1, where they are known.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Place {
    file: String,
    line_and_column: Option<(usize, usize)>,
}

impl Place {
    /// Returns the place of an offset in the text of a file.
    pub(crate) fn in_text(file: String, text: &str, offset: usize) -> Place {
        let before = text.get(..offset).unwrap_or(text);
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        Place { file, line_and_column: Some((line_number(before), column)) }
    }
}

impl From<String> for Place {
    fn from(file: String) -> Place {
        Place { file, line_and_column: None }
    }
}

/// Writes the place as editors read it: `report.md:12:5`.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line_and_column {
            Some((line, column)) => write!(f, "{}:{line}:{column}", self.file),
            None => f.write_str(&self.file),
        }
    }
}

/// Returns a message in one line of at most `most` characters; a longer one keeps its beginning
/// and its end. Parsers repeat their input, which may be of any length.
pub fn one_line(input: &str, most: usize) -> String {
    let message = input.replace(is_control, " ");
    let message = message.trim();
    let length = message.chars().count();
    if length <= most {
        return message.into();
    }
    let (head, tail) = (most * 2 / 3, most - most * 2 / 3 - 1);
    let head = message.chars().take(head);
    head.chain(['…']).chain(message.chars().skip(length - tail)).collect()
}

pub(crate) fn source_line(location: &Location<'_>) -> String {
    format!("{}:{}", location.file(), location.line())
}

/// Counts things in words: `3 numbers`, `1 number`, `no number`.
pub(crate) fn count(number: usize, noun: &str) -> String {
    match number {
        0 => format!("no {noun}"),
        1 => format!("1 {noun}"),
        _ if noun.ends_with('s') => format!("{number} {noun}es"),
        _ => format!("{number} {noun}s"),
    }
}

const NUMBER: &str = "not a number; write one such as 0.12";
const WHOLE: &str = "not a whole number of 0 or more; write one such as 1000";

/// Words of parsers, and those that users read instead.
const PLAIN: [(&str, &str); 11] = [
    (" as i128", ""),
    ("`usize`", "a whole number"),
    ("expected f64", "expected a number"),
    ("expected u64", "expected a whole number"),
    ("expected usize", "expected a whole number"),
    ("an array of length 2", "a pair [a, b]"),
    ("expected value", "unexpected value"),
    ("invalid float literal", NUMBER),
    ("cannot parse float from empty string", NUMBER),
    ("invalid digit found in string", WHOLE),
    ("cannot parse integer from empty string", WHOLE),
];

/// Puts words of users in place of those of parsers, as "a whole number" for `usize`.
pub fn in_plain_words(message: &str) -> String {
    let put = |line: String, (theirs, ours): &(&str, &str)| line.replace(theirs, ours);
    PLAIN.iter().fold(message.into(), put)
}

/// Returns whether a terminal or an editor treats a character as a command, or hides it.
pub(crate) fn is_control(c: char) -> bool {
    match c {
        ' '..='~' => false,
        '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{feff}' => true,
        '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' => true,
        '\u{fff9}'..='\u{fffb}' | '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e007f}' => true,
        c => c.is_control(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_the_same_way_and_what_is_no_text_is_refused() {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), "\u{feff}$a\r\n= b$\r\n\r\nc\rd\n").unwrap();
        assert_eq!(read_text(file.path()).unwrap(), "$a\n= b$\n\nc\rd\n");
        std::fs::write(file.path(), [b'a', 0xff]).unwrap();
        assert_eq!(read_text(file.path()).unwrap_err().to_string(), "not valid UTF-8");
    }

    #[test]
    fn long_and_broken_lines_are_one_short_line() {
        assert_eq!(one_line("a\nb\u{2028}c\0d\u{61c}e\u{202e}f\u{e0041}g\n", 20), "a b c d e f g");
        let long = format!("begin{}end", "σ".repeat(1000));
        let line = one_line(&long, 30);
        assert_eq!(line.chars().count(), 30);
        assert!(line.starts_with("beginσ") && line.ends_with("σend"), "{line}");
        assert_eq!(one_line("abc", 3), "abc");
    }
}
