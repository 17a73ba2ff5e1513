//! Names what can be wrong with a report, with the place where it can be corrected.

use crate::input::{Place, one_line};
use crate::table::nearest;

const MAX_LENGTH: usize = 1000;

/// What the prose writes and an error can name: an id that it gives, a reference, the address of a
/// link or picture, or the TeX of a formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Thing {
    Id,
    Reference,
    Link,
    Formula,
}

#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("{}", one_line(.0, MAX_LENGTH))]
    Message(String),
    /// The prose can be read, but breaks a rule about its numbers and figures.
    #[error("{}", one_line(.0, MAX_LENGTH))]
    Rule(String),
    #[error(transparent)]
    Prose(#[from] crate::prose::Error),
    #[error("{place}: {error}")]
    At { place: Place, error: Box<Error> },
    /// What is wrong with a thing in the prose, by which its place is found.
    #[error("{}", one_line(problem, MAX_LENGTH))]
    Named { thing: Thing, name: String, problem: String },
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Several(Vec<Error>),
}

/// Makes the error of markup that is not as the manual says.
pub(crate) fn fault(problem: impl AsRef<str>) -> Error {
    let manual = "the page *Prose* of the manual of literate lists all markup";
    Error::Message(format!("{}; {manual}", one_line(problem.as_ref(), 200)))
}

impl Error {
    pub(crate) fn formula(tex: String, problem: &str) -> Error {
        let [formula, problem] = [&tex, problem].map(|words| one_line(words, 200));
        let problem =
            format!("the formula ${formula}$ cannot be shown: {problem}; write it differently");
        Error::Named { thing: Thing::Formula, name: tex, problem }
    }

    /// Makes the error of a character that LaTeX lacks.
    pub(crate) fn no_latex(c: char) -> Error {
        let (sign, code) = (one_line(&c.to_string(), 1), u32::from(c));
        let problem = "is not known in LaTeX; write it as TeX between $ signs, or in words";
        Error::Message(format!("the character '{sign}' (U+{code:04X}) {problem}"))
    }

    pub(crate) fn hard_coded(numeral: &str) -> Error {
        let remedy = "use a value «v.…», or give the reason for a number that is not computed, by \
                      «literal(text=…, why=…)» or by its phrase in literals.toml";
        Error::Rule(format!("hard-coded number {numeral}; {remedy}"))
    }

    /// Makes the error of an id that two items give to what they compute.
    pub(crate) fn twice(id: &str, first: &str, second: &str) -> Error {
        let [first, second] =
            [first, second].map(|item| if item.is_empty() { "a value" } else { item });
        let problem = "have this id; give one of them another";
        Error::Message(format!("{id}: {first} and {second} {problem}"))
    }

    pub(crate) fn named(thing: Thing, name: &str, problem: String) -> Error {
        Error::Named { thing, name: name.into(), problem }
    }

    /// Makes the error of a thing that is not there, with the most similar names.
    pub(crate) fn unknown<'a>(
        thing: Thing,
        name: &str,
        problem: &str,
        names: impl IntoIterator<Item = &'a str>,
    ) -> Error {
        let nearest = nearest(name, names.into_iter()).join(", ");
        let nearest = if nearest.is_empty() { nearest } else { format!("; nearest: {nearest}") };
        Error::named(thing, name, format!("{problem}{nearest}"))
    }

    /// Adds the place where it can be corrected, unless it has one.
    pub(crate) fn with_place(self, place: impl Into<Place>) -> Error {
        match self {
            Error::At { .. } => self,
            error => Error::At { place: place.into(), error: Box::new(error) },
        }
    }

    /// Returns the place where it can be corrected, or `None` if that is not known.
    pub(crate) fn place(&self) -> Option<&Place> {
        if let Error::At { place, .. } = self { Some(place) } else { None }
    }

    /// Returns whether the prose can be read but breaks a rule about its numbers and figures.
    pub fn is_of_rules(&self) -> bool {
        match self {
            Error::Rule(_) => true,
            Error::At { error, .. } => error.is_of_rules(),
            Error::Several(errors) => errors.iter().all(Error::is_of_rules),
            _ => false,
        }
    }
}
