//! Keeps where each piece of the filled prose stands in the templates, and tells what people typed
//! or calculated in their tags from what was computed.

use super::document::Block;
use super::edition::Document;
use super::error::{Error, Thing};
use super::lint::{Declared, find_numbers};
use super::mark::{self, Piece, framed, pieces};
use super::values::ValueRegistry;
use crate::input::Place;
use std::collections::BTreeSet;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filled {
    /// The text; values are marks in it.
    pub text: String,
    /// Paths and texts, and the names of what was typed in their tags.
    templates: Vec<(String, String, BTreeSet<String>)>,
    origins: Vec<Origin>,
}

/// What follows from an offset in the text on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Origin {
    start: usize,
    template: usize,
    offset: usize,
    is_tag: bool,
}

impl Filled {
    /// Adds what Tera made of a marked template, a paragraph apart.
    pub fn add(&mut self, path: &str, text: &str, filled: &str) {
        if !self.templates.is_empty() {
            self.text += "\n\n";
        }
        let template = self.templates.len();
        self.templates.push((path.into(), text.into(), typed_names(text)));
        let here = |start, offset, is_tag| Origin { start, template, offset, is_tag };
        self.origins.push(here(self.text.len(), 0, false));
        for piece in pieces(filled) {
            match piece {
                Piece::Text(text) => self.text += text,
                Piece::Value { id, filters } if !id.is_empty() => {
                    self.text += &framed(&id, filters)
                }
                Piece::Value { filters, .. } => {
                    let offset = filters.trim_end_matches(['t', 'x']).parse().unwrap_or_default();
                    self.origins.push(here(self.text.len(), offset, filters.ends_with('t')));
                }
            }
        }
    }

    fn origin(&self, offset: usize) -> Origin {
        let last = self.origins.partition_point(|origin| origin.start <= offset);
        self.origins[last.saturating_sub(1)]
    }

    /// Returns the place in the template of an offset in the text.
    pub fn place(&self, offset: usize) -> Place {
        let origin = self.origin(offset);
        let (path, text, _) = &self.templates[origin.template];
        let beyond = if origin.is_tag { 0 } else { offset - origin.start };
        Place::in_text(path.clone(), text, (origin.offset + beyond).min(text.len()))
    }

    /// Returns whether people typed what stands at an offset, as text or within a tag.
    pub fn is_typed(&self, offset: usize) -> bool {
        let Origin { template, offset, is_tag, .. } = self.origin(offset);
        let (_, text, names) = &self.templates[template];
        let inside = text[offset..].trim_start_matches('«').split('»').next();
        !is_tag || is_typed(inside.unwrap_or_default(), names)
    }
}

/// Returns the names for what was typed or calculated: `n` in `for n in [13.5]`.
fn typed_names(template: &str) -> BTreeSet<String> {
    let mut typed: BTreeSet<String> = ["raw", "loop", "range"].map(String::from).into();
    for tag in template.split("<%").skip(1).filter_map(|tag| tag.split("%>").next()) {
        let tag = tag.trim_matches(|c: char| c == '-' || c.is_whitespace());
        let (word, rest) = tag.split_once(' ').unwrap_or_default();
        let given = match word {
            "set" | "set_global" => rest.split_once('='),
            "for" => rest.split_once(" in "),
            _ => None,
        };
        if let Some((names, _)) = given.filter(|(_, expression)| is_typed(expression, &typed)) {
            typed.extend(names.split(',').map(|name| name.trim().into()));
        }
    }
    typed
}

/// Returns whether an expression is more than a name with filters: it begins with a number, words
/// or a typed name, calculates, or has a number in it, which names of rows may have.
fn is_typed(expression: &str, typed: &BTreeSet<String>) -> bool {
    let expression = expression.trim_start_matches(['-', ' ', '\n']);
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let name = expression.split(|c| !is_name(c)).next().unwrap_or_default();
    if name == "literal" {
        return false;
    }
    let (mut bare, mut rows) = (String::new(), 0);
    for c in expression.chars() {
        rows -= i32::from(c == ']');
        bare.extend((rows == 0).then_some(c));
        rows += i32::from(c == '[');
    }
    let mut quoted = false;
    let has_numbers = bare.split(['"', '\'', '`']).any(|part| {
        quoted = !quoted;
        let numbers = find_numbers(part, 0..part.len(), &Declared::default());
        // `nth(n=1)` chooses.
        let chooses = |offset: usize| quoted && part[..offset].ends_with(['=', '.']);
        quoted && part.contains(['*', '/', '+', '%'])
            || numbers.iter().any(|(offset, _)| !chooses(*offset))
    });
    !name.starts_with(char::is_alphabetic) || typed.contains(name) || has_numbers
}

/// A document as it is read.
pub struct Part<'a> {
    pub document: Document,
    /// The tree, without the blocks that have an error.
    pub blocks: Vec<Block>,
    pub errors: Vec<Error>,
    pub filled: &'a Filled,
    pub values: &'a ValueRegistry,
    /// Where the things stand that errors can name.
    pub offsets: Vec<(Thing, String, usize)>,
}

impl Part<'_> {
    /// Returns the names and the places of all things of one kind.
    pub fn named(&self, kind: Thing) -> impl Iterator<Item = (&str, Place)> {
        let of_kind = self.offsets.iter().filter(move |(thing, ..)| *thing == kind);
        of_kind.map(|(_, name, offset)| (name.as_str(), self.filled.place(*offset)))
    }

    /// Adds to an error the place of what it names; of two things with one id this is the second.
    pub fn locate(&self, error: Error) -> Error {
        let Error::Named { thing, name, .. } = &error else { return error };
        let mut offsets = self.offsets.iter().rev();
        match offsets.find(|(kind, of, _)| kind == thing && of == name) {
            Some((.., offset)) => error.with_place(self.filled.place(*offset)),
            None => error,
        }
    }

    /// Returns where a character stands first, in the prose or in the words of a value.
    pub fn place_of(&self, c: char) -> Place {
        let has = |id: &str| self.values.get(id).is_some_and(|v| v.to_plain_text().contains(c));
        let mut values = mark::values(&self.filled.text);
        let in_value = || values.find_map(|(id, _, at)| has(&id).then_some(at.start));
        match self.filled.text.find(c).or_else(in_value) {
            Some(offset) => self.filled.place(offset),
            None => "the authors, or the code of a listing".to_string().into(),
        }
    }
}
