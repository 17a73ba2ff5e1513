//! Where in the templates each piece of filled text stands, so that what is wrong with it can be mended.
//!
//! Before a template is filled, marks with offsets are put about its tags ([`marked`]); afterwards they
//! are taken out of the text again ([`Filled::read`]). Between two tags the text is that of the
//! template; what a tag wrote stands where the tag does.

use super::Error;
use crate::input::line_and_column;
use std::fmt::Write as _;

const OPEN: char = '\u{e006}';
const CLOSE: char = '\u{e007}';

/// Tags and comments of Tera.
pub const TAGS: [(&str, &str); 3] = [("«", "»"), ("<%", "%>"), ("<#", "#>")];

/// A template with a mark before and after each tag: the offset there, and whether a tag begins.
pub fn marked(text: &str) -> String {
    let mut out = String::with_capacity(2 * text.len());
    let mark = |out: &mut String, offset: usize, kind: char| {
        let _ = write!(out, "{OPEN}{offset}{kind}{CLOSE}");
    };
    let mut at = 0;
    while let Some((start, end)) = next_tag(text, at) {
        // A tag with a minus eats the blanks at its side: the mark must not stop it.
        let before = text[at..start].trim_end().len() + at;
        let cut = if text[start..end].trim_start_matches(['<', '%', '#', '«']).starts_with('-') {
            before
        } else {
            start
        };
        out.push_str(&text[at..cut]);
        mark(&mut out, start, 't');
        out.push_str(&text[cut..end]);
        let eats = text[start..end].trim_end_matches(['>', '%', '#', '»']).ends_with('-');
        let after = if eats { text.len() - text[end..].trim_start().len() } else { end };
        out.push_str(&text[end..after]);
        mark(&mut out, after, 'x');
        at = after;
    }
    out + &text[at..]
}

/// Start and end of the first tag from `at` on.
pub(super) fn next_tag(text: &str, at: usize) -> Option<(usize, usize)> {
    // One walk to the nearest sign: a search for each of them would read the whole rest each time.
    let begins = |(i, _): (usize, &str)| {
        let start = at + i;
        let (_, close) = TAGS.iter().find(|(open, _)| text[start..].starts_with(open))?;
        Some((start, *close))
    };
    let (start, close) = text[at..].match_indices(['«', '<']).find_map(begins)?;
    Some((start, start + text[start..].find(close)? + close.len()))
}

/// What a tag has outside of brackets, which name rows and give arguments.
fn bare(tag: &str) -> String {
    let mut depth = 0_i32;
    let outside = |c: &char| {
        depth += i32::from("([".contains(*c));
        let outside = depth == 0;
        depth -= i32::from(")]".contains(*c));
        outside
    };
    tag.chars().filter(outside).collect()
}

/// Does the tag name something, `table["row"].column | filter`, and compute nothing?
fn names(tag: &str) -> bool {
    let name = |part: &str| {
        part.starts_with(|c: char| c.is_ascii_alphabetic())
            && part.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '.'))
            && !["true", "false", "none", "range"].contains(&part)
    };
    bare(tag).split('|').all(|part| name(part.trim()))
}

/// May the tag write a plain number? One declared, or one in a row that the program made.
fn has_a_number(tag: &str) -> bool {
    let other = ["raw.", "loop."].iter().any(|other| tag.starts_with(other));
    let row = bare(tag).contains('.') && !tag.contains('|');
    tag.starts_with("literal(") || (row && !other)
}

/// Templates and the text that was made of them, one after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filled {
    /// The text.
    pub text: String,
    templates: Vec<Template>,
    pieces: Vec<Piece>,
}

#[derive(Clone, Debug, PartialEq)]
struct Template {
    path: String,
    text: String,
}

/// What follows from an offset in the text on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    start: usize,
    /// Which template it comes from, and the offset there.
    template: usize,
    origin: usize,
    /// Whether a tag wrote it.
    tag: bool,
}

impl Filled {
    /// What a template made after [`marked`].
    pub fn read(path: &str, template: &str, filled: &str) -> Filled {
        let mut own = Filled::default();
        own.templates.push(Template { path: path.into(), text: template.into() });
        own.pieces.push(Piece { start: 0, template: 0, origin: 0, tag: false });
        let mut rest = filled;
        while let Some((before, after)) = rest.split_once(OPEN) {
            own.text.push_str(before);
            let Some((mark, after)) = after.split_once(CLOSE) else { break };
            let origin = mark.trim_end_matches(['t', 'x']).parse().unwrap_or_default();
            let (start, tag) = (own.text.len(), mark.ends_with('t'));
            own.pieces.push(Piece { start, template: 0, origin, tag });
            rest = after;
        }
        own.text.push_str(rest);
        own
    }

    /// The same, and after it what another template made, a paragraph apart.
    pub fn then(mut self, other: Filled) -> Filled {
        let templates = self.templates.len();
        if templates > 0 {
            self.text.push_str("\n\n");
        }
        let start = self.text.len();
        let moved = |piece: Piece| Piece {
            start: start + piece.start,
            template: templates + piece.template,
            ..piece
        };
        self.pieces.extend(other.pieces.into_iter().map(moved));
        self.templates.extend(other.templates);
        self.text.push_str(&other.text);
        self
    }

    /// Refuses a tag that wrote no value and no words of the program: a whole row or table, a plain number, or what
    /// the tag itself has in quotes.
    pub fn refuse_dumps(&self) -> Result<(), Error> {
        let ends = self.pieces.iter().skip(1).map(|piece| piece.start).chain([self.text.len()]);
        for (piece, end) in self.pieces.iter().zip(ends) {
            let wrote = &self.text[piece.start..end];
            let from = &self.templates[piece.template].text[piece.origin..];
            let Some(tag) = from.strip_prefix('«').filter(|_| piece.tag) else { continue };
            let tag = tag.split('»').next().unwrap_or_default().trim_matches(['-', ' ', '\n']);
            let what = match () {
                () if ["{\"", "[\"", "[{", "[["].iter().any(|dump| wrote.starts_with(dump)) => {
                    "a whole row or table; name a column of a row"
                }
                () if bare(tag).contains(['"', '\'', '`']) => {
                    "a text in quotes; write it in the prose"
                }
                () if !names(tag) => "no name of a value; write it in the prose, or name a value",
                () if wrote.parse::<f64>().is_ok() && !has_a_number(tag) => {
                    "a plain number; name a value, so that it has its digits and its card"
                }
                () => continue,
            };
            return Err(Error::Template(format!("{}: this is {what}", self.place(piece.start))));
        }
        Ok(())
    }

    /// Text that nothing was filled into.
    pub fn plain(path: &str, text: &str) -> Filled {
        Filled::read(path, text, text)
    }

    /// File, line and column in the template, from 1, of an offset in the text.
    pub fn place(&self, offset: usize) -> String {
        let last = self.pieces.partition_point(|piece| piece.start <= offset).saturating_sub(1);
        let Some(piece) = self.pieces.get(last) else { return String::new() };
        let Template { path, text } = &self.templates[piece.template];
        let beyond = if piece.tag { 0 } else { offset - piece.start };
        let at = (piece.origin + beyond).min(text.len());
        format!("{path}:{}", line_and_column(text, at))
    }
}

/// Where the things stand that a report has or names: `#fig:3` what can be referred to, `@fig:3` a
/// reference, `(path` a link, `Lab name` what readers run.
#[derive(Clone, Debug)]
pub struct Places<'a> {
    filled: &'a Filled,
    found: Vec<(String, usize)>,
}

impl<'a> Places<'a> {
    /// None yet.
    pub fn of(filled: &'a Filled) -> Self {
        Places { filled, found: Vec::new() }
    }

    /// Adds a thing at an offset of the filled text.
    pub fn add(&mut self, thing: String, offset: usize) {
        self.found.push((thing, offset));
    }

    /// Where the thing with an id stands first.
    pub fn first(&self, id: &str) -> Option<String> {
        let thing = format!("#{id}");
        let (_, offset) = self.found.iter().find(|(own, _)| *own == thing)?;
        Some(self.filled.place(*offset))
    }

    /// The error with the place of what it names. Of two things with one id the second is meant.
    pub fn tell(&self, error: Error) -> Error {
        let thing = match &error {
            Error::Label(id, _) => format!("#{id}"),
            Error::Reference(id) => format!("@{id}"),
            Error::Claim(id) => format!("#claim:{id}"),
            Error::NoFile(path) => format!("({path}"),
            Error::Lab(lab) => format!("Lab {lab}"),
            _ => return error,
        };
        match self.found.iter().rev().find(|(own, _)| *own == thing) {
            Some((_, offset)) => error.at(self.filled.place(*offset)),
            None => error,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_knows_its_place() {
        let template = "one «a» two\n<% for x in y -%>\n  | «x» |\n<%- endfor %>\nend $σ";
        let made = marked(template);
        assert!(made.ends_with("end $σ") && made.contains("two\n"), "{made}");
        // What Tera makes of it, by hand.
        let filled = made.replace("«a»", "VALUE").replace("<% for x in y -%>\n  ", "");
        let filled = filled.replace("«x»", "cell").replace("\n<%- endfor %>", "");
        let filled = Filled::read("report.md", template, &filled);
        assert_eq!(filled.text, "one VALUE two\n| cell |\nend $σ");
        let place = |word: &str| filled.place(filled.text.find(word).unwrap());
        for (word, expected) in [
            ("one", "1:1"),
            ("LUE", "1:5"),
            ("two", "1:9"),
            ("| ", "3:3"),
            ("ell", "3:5"),
            ("end", "5:1"),
            ("σ", "5:6"),
        ] {
            assert_eq!(place(word), format!("report.md:{expected}"), "{word}");
        }
        let plain = Filled::plain("x.md", "a\nb «c»");
        assert_eq!((plain.text.as_str(), plain.place(4)), ("a\nb «c»", "x.md:2:3".into()));
    }
}
