//! Keeps where each piece of the filled prose stands in the templates.

use super::error::Error;
use super::mark::{Piece, framed, pieces};
use super::typed::{self, Names};
use crate::input::line_and_column;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filled {
    /// The text; values are marks in it.
    pub text: String,
    templates: Vec<(String, String)>,
    /// Of each template the names of what was typed in its tags.
    typed: Vec<Names>,
    origins: Vec<Origin>,
}

/// What follows from an offset in the text on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Origin {
    start: usize,
    template: usize,
    offset: usize,
    tag: bool,
}

impl Filled {
    /// Adds what Tera made of a marked template, a paragraph apart.
    pub fn add(&mut self, path: &str, text: &str, filled: &str) {
        if !self.templates.is_empty() {
            self.text += "\n\n";
        }
        let template = self.templates.len();
        self.templates.push((path.into(), text.into()));
        self.typed.push(typed::names(text));
        let here = |start, offset, tag| Origin { start, template, offset, tag };
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

    /// Returns whether people typed what stands at an offset, as text or within a tag.
    pub fn is_typed(&self, offset: usize) -> bool {
        let Origin { template, offset, tag, .. } = self.origin(offset);
        let inside = self.templates[template].1[offset..].trim_start_matches('«');
        let inside = inside.split('»').next().unwrap_or_default();
        !tag || typed::is_typed(inside, &self.typed[template])
    }
}

/// Offsets of what errors can name: `#fig:3` an id, `@fig:3` a reference, `(path` a link, `!name` a
/// picture, `$tex` a formula.
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

    pub fn links(&self) -> impl Iterator<Item = (&str, String)> {
        let all = self.found.iter().map(|(thing, at)| (thing.strip_prefix('('), at));
        all.filter_map(|(to, at)| Some((to?, self.filled.place(*at))))
    }

    pub fn ids(&self) -> impl Iterator<Item = &str> {
        self.found.iter().filter_map(|(thing, _)| thing.strip_prefix('#'))
    }

    /// Adds to an error the place of what it names. Of two things with one id the second is meant.
    pub fn locate(&self, error: Error) -> Error {
        let offset = match &error {
            Error::Several(_) => {
                let errors = error.each().into_iter().map(|error| self.locate(error));
                return Error::Several(errors.collect());
            }
            Error::Named { thing, .. } => self.offset(thing),
            Error::Maths { tex, .. } => self.offset(&format!("${tex}")),
            Error::NoLatex(c) => self.filled.text.find(*c),
            _ => None,
        };
        match offset {
            Some(offset) => error.at(self.filled.place(offset)),
            None => error,
        }
    }

    fn offset(&self, thing: &str) -> Option<usize> {
        self.found.iter().rev().find(|(noted, _)| noted == thing).map(|(_, offset)| *offset)
    }
}
