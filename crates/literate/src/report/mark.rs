//! Marks: where a value stands in text, in private-use characters, into which neither Tera nor Markdown reads anything.
//!
//! In filled prose a mark holds the id of a value and the filters of its digits; in the mathematics of a
//! [`document`](super::document) it holds id and digits, so that a page can make a button of them. Place marks have no id.
//!
//! They record where in the templates each piece of filled text stands, so that what is wrong with it can be mended: they are put
//! about what Tera fills ([`marked`]) and taken out again when the filled text is read ([`Filled::add`]). Between two tags the
//! text is that of the template; what a tag wrote stands where the tag does.

use crate::print::Style;
use crate::value::Digits;

pub(super) const OPEN: char = '\u{e000}';
const NEXT: char = '\u{e001}';
pub(super) const CLOSE: char = '\u{e002}';

/// Whether a character is one of those that make a mark.
pub(super) fn is_sign(c: char) -> bool {
    (OPEN..='\u{e004}').contains(&c)
}

/// Brackets of an address, into which Markdown would read a link.
const BRACKETS: [(&str, &str); 2] = [("[", "\u{e003}"), ("]", "\u{e004}")];

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece<'a> {
    Text(&'a str),
    Value {
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

/// What the words of filters ask for: `percent`, `significant3`.
pub fn style(words: &str) -> Style {
    let mut style = Style::default();
    for word in words.split_whitespace() {
        match word.strip_prefix("significant") {
            Some(digits) => style.digits = digits.parse().ok().map(Digits::Significant),
            None => style.percent |= word == "percent",
        }
    }
    style
}

/// A template with a mark before each `«` and behind each `»`, `%>` and `#>`: the offset there, and whether a tag writes
/// what follows.
pub fn marked(text: &str) -> String {
    let (mut out, mut at) = (String::with_capacity(2 * text.len()), 0);
    for (found, sign) in text.match_indices(['«', '»', '>']) {
        if found < at || sign == ">" && !text[..found].ends_with(['%', '#']) {
            continue;
        }
        let end = if sign == "«" { found } else { found + sign.len() };
        // A tag with a minus takes the blanks behind it: the mark must not stop it.
        let blanks = text[end..].len() - text[end..].trim_start().len();
        let end = if text[..found].ends_with("-%") { end + blanks } else { end };
        let kind = if sign == "«" { "t" } else { "x" };
        out += &text[at..end];
        out += &framed("", &format!("{end}{kind}"));
        at = end;
    }
    out + &text[at..]
}
