//! Marks values in filled prose by private-use characters, which Tera and Markdown leave alone.
//!
//! A mark holds the id of a value and the filters for its digits. Marks without an id hold the
//! place in the template: [`with_places`] puts them around each tag, and
//! [`Filled::add`](super::filled::Filled::add) takes them out again.

use crate::print::Style;
use crate::value::Digits;
use std::ops::Range;

pub(super) const OPEN: char = '\u{e000}';
const NEXT: char = '\u{e001}';
pub(super) const CLOSE: char = '\u{e002}';

/// An id has words from data in it, whose signs Markdown would read: all of Latin-1 but letters
/// and digits is moved to private-use characters from here on.
const MOVED: u32 = 0xe100;

pub(super) fn is_of_mark(c: char) -> bool {
    (OPEN..=CLOSE).contains(&c) || moved_back(c) != c
}

fn moved(c: char) -> char {
    let moved = char::from_u32(MOVED + u32::from(c));
    moved.filter(|_| c <= '\u{ff}' && !c.is_alphanumeric()).unwrap_or(c)
}

fn moved_back(c: char) -> char {
    let code = u32::from(c).checked_sub(MOVED).and_then(|code| u8::try_from(code).ok());
    code.map_or(c, char::from)
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece<'a> {
    Text(&'a str),
    Value { id: String, filters: &'a str },
}

/// Returns the mark that stands for the value with an id, with filters of Tera behind it.
pub fn framed(id: &str, filters: &str) -> String {
    let id: String = id.chars().map(moved).collect();
    format!("{OPEN}{id}{NEXT}{filters}{CLOSE}")
}

pub fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some((before, mark)) = rest.split_once(OPEN) {
        let Some((mark, after)) = mark.split_once(CLOSE) else { break };
        let Some((id, filters)) = mark.split_once(NEXT) else { break };
        let id = id.chars().map(moved_back).collect();
        pieces.extend((!before.is_empty()).then_some(Piece::Text(before)));
        pieces.push(Piece::Value { id, filters });
        rest = after;
    }
    pieces.extend((!rest.is_empty()).then_some(Piece::Text(rest)));
    pieces
}

/// Returns the ids of the values in a text, with their filters and where their marks stand.
pub fn values(text: &str) -> impl Iterator<Item = (String, &str, Range<usize>)> {
    text.match_indices(OPEN).filter_map(|(start, _)| {
        let end = start + text[start..].find(CLOSE)? + CLOSE.len_utf8();
        match pieces(&text[start..end]).pop()? {
            Piece::Value { id, filters } => Some((id, filters, start..end)),
            Piece::Text(_) => None,
        }
    })
}

/// Returns the style that filters ask for: `percent`, `significant3`.
pub fn parse_filters(words: &str) -> Style {
    let mut style = Style::default();
    for word in words.split_whitespace() {
        match word.strip_prefix("significant") {
            Some(digits) => style.digits = digits.parse().ok().map(Digits::Significant),
            None => style.in_percent |= word == "percent",
        }
    }
    style
}

/// Returns the offset in the template that the rest of a mark without an id holds.
pub fn offset_in(mark: &str) -> Option<usize> {
    let (place, _) = mark.strip_prefix(NEXT)?.split_once(CLOSE)?;
    place.trim_end_matches(['t', 'x']).parse().ok()
}

/// Adds to a template a mark before each `«` and after each `»`, `%>` and `#>`, with the offset
/// there, and whether a tag writes what follows.
pub fn with_places(text: &str) -> String {
    let (mut marked, mut written) = (String::with_capacity(2 * text.len()), 0);
    for (offset, sign) in text.match_indices(['«', '»', '>']) {
        if offset < written || sign == ">" && !text[..offset].ends_with(['%', '#']) {
            continue;
        }
        let end = if sign == "«" { offset } else { offset + sign.len() };
        // A tag with a minus takes the blanks behind it: the mark must not stop it.
        let blanks = text[end..].len() - text[end..].trim_start().len();
        let end = if text[..offset].ends_with("-%") { end + blanks } else { end };
        let kind = if sign == "«" { "t" } else { "x" };
        marked += &text[written..end];
        marked += &framed("", &format!("{end}{kind}"));
        written = end;
    }
    marked + &text[written..]
}
