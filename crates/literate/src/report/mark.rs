//! Marks: where a value stands in text, in private-use characters, into which neither Tera nor Markdown reads anything.
//!
//! In filled prose a mark holds the id of a value and what filters ask of its digits; in the mathematics of a
//! [`document`](super::document) it holds id and digits, so that a page can make a button of them. The place marks of
//! [`super::origin`] are marks without an id.

use super::print::{Asked, Style};

pub(super) const OPEN: char = '\u{e000}';
const NEXT: char = '\u{e001}';
pub(super) const CLOSE: char = '\u{e002}';

/// Brackets of an address, into which Markdown would read a link.
const BRACKETS: [(&str, &str); 2] = [("[", "\u{e003}"), ("]", "\u{e004}")];

/// A piece of text with marks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece<'a> {
    /// Text between marks.
    Text(&'a str),
    /// A value.
    Value {
        /// Its id.
        id: String,
        /// Its digits as TeX, or in filled prose the words of its filters.
        shown: &'a str,
    },
}

/// A mark with an id and what is shown.
pub fn framed(id: &str, shown: &str) -> String {
    let id = BRACKETS.iter().fold(id.to_string(), |id, (own, kept)| id.replace(own, kept));
    format!("{OPEN}{id}{NEXT}{shown}{CLOSE}")
}

/// Cuts text at its marks.
pub fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut out = Vec::new();
    let mut rest = text;
    while let Some((before, mark)) = rest.split_once(OPEN) {
        let Some((mark, after)) = mark.split_once(CLOSE) else { break };
        let Some((id, shown)) = mark.split_once(NEXT) else { break };
        let id = BRACKETS.iter().fold(id.to_string(), |id, (own, kept)| id.replace(kept, own));
        out.extend((!before.is_empty()).then_some(Piece::Text(before)));
        out.push(Piece::Value { id, shown });
        rest = after;
    }
    out.extend((!rest.is_empty()).then_some(Piece::Text(rest)));
    out
}

/// Text with what its marks show, and without them.
pub fn bare(text: &str) -> String {
    let shown = |piece| match piece {
        Piece::Text(text) | Piece::Value { shown: text, .. } => text,
    };
    pieces(text).into_iter().map(shown).collect()
}

/// Ids of the values in a text.
pub fn ids(text: &str) -> impl Iterator<Item = String> + '_ {
    pieces(text).into_iter().filter_map(|piece| match piece {
        Piece::Value { id, .. } => Some(id),
        Piece::Text(_) => None,
    })
}

/// The mark of a value with one more word of a filter; none for other text.
pub fn with(mark: &str, word: &str) -> Option<String> {
    match pieces(mark).as_slice() {
        [Piece::Value { id, shown }] => Some(framed(id, &format!("{shown} {word}"))),
        _ => None,
    }
}

/// What the words of filters ask for: `percent`, `no_error`, `significant3`.
pub fn style(words: &str) -> Style {
    let mut style = Style::default();
    for word in words.split_whitespace() {
        match word.strip_prefix("significant") {
            Some(digits) => style.digits = digits.parse().ok().map(Asked::Significant),
            None => {
                style.percent |= word == "percent";
                style.no_error |= word == "no_error";
            }
        }
    }
    style
}
