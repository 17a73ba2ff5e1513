//! What an entry of `references.bib` says, looked at as it is written: what a reader of BibTeX passes over in
//! silence would be missing in the list of references.

use super::Error;
use crate::input::line;
use biblatex::{EntryType, Pair, RawBibliography, RawChunk, RawEntry};

/// Fields that the list of references shows. Managers of references write many others beside them.
const FIELDS: &str = "author booktitle chapter date doi edition editor howpublished institution issue journal \
    journaltitle note number organization pages publisher school series title translator url volume year";

/// Of each of these an entry has one, with something in it.
const NEEDED: [&[&str]; 3] = [&["author", "editor"], &["year", "date"], &["title"]];

/// Fields of BibLaTeX that are spelt nearly as these.
const NEAR: [&str; 4] = ["editora", "editorb", "editorc", "volumes"];

/// Refuses what no list of references could show as it was meant.
///
/// # Errors
/// The line, the key, and what to write.
pub fn sound(text: &str) -> Result<(), Error> {
    // What is wrong with the form is told by who reads the entries.
    let Ok(read) = RawBibliography::parse(text) else { return Ok(()) };
    let told = |offset: usize, what: String| {
        let line = line(text.get(..offset).unwrap_or(text));
        Err(Error::Template(format!("references.bib:{line}: {what}")))
    };
    if let Some(pair) = read.abbreviations.first() {
        return told(
            pair.key.span.start,
            "@string takes fields from elsewhere; write them out".into(),
        );
    }
    for entry in read.entries {
        if let Some((offset, what)) = wrong(&entry.v) {
            return told(offset, format!("{} {what}", entry.v.key.v));
        }
    }
    Ok(())
}

/// The first fault of an entry: its offset, and what is said behind the key.
fn wrong(entry: &RawEntry<'_>) -> Option<(usize, String)> {
    let (head, kind) = (entry.key.span.start, entry.kind.v);
    if matches!(EntryType::new(kind), EntryType::Unknown(_)) {
        let what = "which there is not; write @article, @book, @phdthesis or the like";
        return Some((head, format!("has the type @{kind}, {what}")));
    }
    let mut fields = entry.fields.iter().enumerate();
    let one = |(i, pair): (usize, &Pair<'_>)| {
        let before = entry.fields[..i].iter().map(name);
        Some((pair.key.span.start, format!("has `{}`, which {}", pair.key.v, fault(pair, before)?)))
    };
    if let Some(found) = fields.find_map(one) {
        return Some(found);
    }
    let has = |names: &&[&str]| {
        let full = |pair: &&Pair<'_>| value(pair).contains(char::is_alphanumeric);
        entry.fields.iter().filter(full).any(|pair| names.contains(&name(pair).as_str()))
    };
    let lacks = NEEDED.into_iter().find(|names| !has(names))?;
    Some((head, format!("lacks its {}; give it", lacks.join(" or "))))
}

/// What is wrong with a field; the names of those before it.
fn fault(pair: &Pair<'_>, mut before: impl Iterator<Item = String>) -> Option<String> {
    let (own, value) = (name(pair), value(pair));
    let shown = |name: &str| FIELDS.split(' ').any(|field| field == name);
    let meant = FIELDS.split(' ').find(|field| strsim::osa_distance(field, &own) == 1);
    match meant {
        // The reader follows them without end where they lead back.
        _ if ["crossref", "xdata", "xref"].contains(&own.as_str()) => {
            Some("takes fields from elsewhere; write them out".into())
        }
        _ if shown(&own) && before.any(|name| name == own) => Some("stands twice; keep one".into()),
        _ if own == "year" && (value.len() != 4 || !value.bytes().all(|c| c.is_ascii_digit())) => {
            Some("is no year of four digits; correct it".into())
        }
        Some(meant) if !shown(&own) && !NEAR.contains(&own.as_str()) => {
            Some(format!("is no field; is `{meant}` meant?"))
        }
        _ => None,
    }
}

fn name(pair: &Pair<'_>) -> String {
    pair.key.v.to_lowercase()
}

/// The value of a field without braces and blanks about it.
fn value(pair: &Pair<'_>) -> String {
    let words: String = pair
        .value
        .v
        .iter()
        .map(|chunk| match chunk.v {
            RawChunk::Normal(words) | RawChunk::Abbreviation(words) => words,
        })
        .collect();
    words.trim_matches(|c: char| c.is_whitespace() || matches!(c, '{' | '}')).to_string()
}
