//! Marks: where a value stands in text, in private-use characters, into which neither Tera nor Markdown reads anything.
//!
//! In filled prose a mark holds the id of a value and the filters of its digits; in the mathematics of a
//! [`document`](super::document) it holds id and digits, so that a page can make a button of them. Place marks have no id.
//!
//! They record where in the templates each piece of filled text stands, so that what is wrong with it can be mended: they are put
//! about what Tera fills ([`marked`]) and taken out again when the filled text is read ([`Filled::add`]). Between two tags the
//! text is that of the template; what a tag wrote stands where the tag does.

use super::Error;
use crate::input::line_and_column;
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

/// Templates and the text that was made of them, one after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filled {
    /// The text; values are marks in it.
    pub text: String,
    templates: Vec<(String, String)>,
    origins: Vec<Origin>,
}

/// What follows from an offset in the text on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Origin {
    start: usize,
    /// Which template it comes from, and the offset there.
    template: usize,
    offset: usize,
    tag: bool,
}

impl Filled {
    /// Adds what Tera made of a template after [`marked`], a paragraph apart.
    pub fn add(&mut self, path: &str, template: &str, filled: &str) {
        if !self.templates.is_empty() {
            self.text += "\n\n";
        }
        let own = self.templates.len();
        self.templates.push((path.into(), template.into()));
        let here = |start, offset, tag| Origin { start, template: own, offset, tag };
        self.origins.push(here(self.text.len(), 0, false));
        for piece in pieces(filled) {
            match piece {
                Piece::Text(text) => self.text += text,
                Piece::Value { id, shown } if !id.is_empty() => self.text += &framed(&id, shown),
                Piece::Value { shown, .. } => {
                    let offset = shown.trim_end_matches(['t', 'x']).parse().unwrap_or_default();
                    self.origins.push(here(self.text.len(), offset, shown.ends_with('t')));
                }
            }
        }
    }

    fn origin(&self, offset: usize) -> Origin {
        let last = self.origins.partition_point(|origin| origin.start <= offset);
        self.origins[last.saturating_sub(1)]
    }

    /// File, line and column in the template, from 1, of an offset in the text.
    pub fn place(&self, offset: usize) -> String {
        let origin = self.origin(offset);
        let (path, text) = &self.templates[origin.template];
        let beyond = if origin.tag { 0 } else { offset - origin.start };
        format!("{path}:{}", line_and_column(text, (origin.offset + beyond).min(text.len())))
    }

    /// Whether people typed what stands there: text of the template, or a tag that writes a plain number or a quotation
    /// instead of a value, a declared literal or words of the program.
    pub fn is_typed(&self, offset: usize) -> bool {
        let Origin { template, offset, tag, .. } = self.origin(offset);
        let own = self.templates[template].1[offset..].trim_start_matches(['«', '-', ' ']);
        let number = |c: char| c.is_ascii_digit() || "\"'`(-".contains(c);
        !tag || own.starts_with(number) || own.starts_with("raw.") || own.starts_with("loop.")
    }
}

/// Where the things stand that a report has or names: `#fig:3` what can be referred to, `@fig:3` a
/// reference, `(path` a link.
#[derive(Clone, Debug)]
pub struct Places<'a> {
    filled: &'a Filled,
    found: Vec<(String, usize)>,
}

impl<'a> Places<'a> {
    pub fn of(filled: &'a Filled) -> Self {
        Places { filled, found: Vec::new() }
    }

    pub fn add(&mut self, thing: String, offset: usize) {
        self.found.push((thing, offset));
    }

    /// Adds to an error the place of what it names. Of two things with one id the second is meant.
    pub fn locate(&self, error: Error) -> Error {
        let thing = match error {
            Error::Several(errors) => {
                return Error::Several(
                    errors.into_iter().map(|error| self.locate(error)).collect(),
                );
            }
            Error::Label(ref id) => format!("#{id}"),
            Error::Reference(ref id) => format!("@{id}"),
            Error::Claim(ref id) => format!("#claim:{id}"),
            Error::NoFile(ref path) | Error::Picture(ref path) => format!("({path}"),
            Error::Maths { ref tex, .. } => format!("${tex}"),
            Error::NoLatex(c) => {
                return match self.filled.text.find(c) {
                    Some(offset) => error.at(self.filled.place(offset)),
                    None => error,
                };
            }
            _ => return error,
        };
        match self.found.iter().rev().find(|(noted, _)| *noted == thing) {
            Some((_, offset)) => error.at(self.filled.place(*offset)),
            None => error,
        }
    }
}
