//! What an entry of `references.bib` says, looked at as it is written: what a reader of BibTeX passes over in
//! silence would be missing in the list of references.

use super::Error;
use crate::input::line;
use biblatex::{EntryType, Pair, RawBibliography, RawChunk, RawEntry};

/// Fields that the list of references shows, or that managers of references write beside them.
const FIELDS: &str = "abstract address annotation author booktitle chapter copyright date doi edition editor \
    eprint eprinttype eventtitle file groups howpublished institution isbn issn issue journal journaltitle keywords \
    langid language location month note number organization pages pagetotal publisher school series shortjournal \
    shorttitle subtitle title translator type url urldate version volume volumes year";

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
    let head = entry.key.span.start;
    let kind = entry.kind.v;
    if matches!(EntryType::new(kind), EntryType::Unknown(_)) {
        let what = format!(
            "has the type @{kind}, which there is not; write @article, @book, @phdthesis or the like"
        );
        return Some((head, what));
    }
    let name = |pair: &Pair<'_>| pair.key.v.to_lowercase();
    for (i, pair) in entry.fields.iter().enumerate() {
        let (own, value) = (name(pair), value(pair));
        let what = match own.as_str() {
            // The reader follows them without end where they lead back.
            "crossref" | "xdata" | "xref" => "takes fields from elsewhere; write them out",
            _ if entry.fields[..i].iter().any(|other| name(other) == own) => {
                "stands twice; keep one"
            }
            _ if !FIELDS.split(' ').any(|field| field == own) => {
                "is no known field; correct its name, or remove it"
            }
            _ if !value.contains(char::is_alphanumeric) => {
                "has nothing in it; fill it, or remove it"
            }
            "year" if value.len() != 4 || value.contains(|c: char| !c.is_ascii_digit()) => {
                "is no year of four digits; correct it"
            }
            _ => continue,
        };
        return Some((pair.key.span.start, format!("has `{own}`, which {what}")));
    }
    let has =
        |fields: &[&str]| entry.fields.iter().any(|pair| fields.contains(&name(pair).as_str()));
    let lacks =
        [&["author"][..], &["year", "date"], &["title"]].into_iter().find(|fields| !has(fields))?;
    Some((head, format!("lacks its {}; give it", lacks[0])))
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
