//! Names what can be wrong with a report, with the place where it can be corrected.

use crate::input::{Place, one_line};
use crate::table::nearest;

const MAX_LENGTH: usize = 1000;

/// What the prose writes and an error can name.
#[derive(Clone, Debug, PartialEq)]
pub enum Thing {
    /// An id that the prose gives, as `fig:3`.
    Id(String),
    Reference(String),
    /// A link to an address.
    Link(String),
    /// A picture by its path.
    Picture(String),
    /// A formula by its TeX.
    Formula(String),
}

#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("{0} has no number; say what stands there, by «… | otherwise(words=\"…\")»")]
    NoNumber(String),
    #[error("value {0}: not a finite number; leave it out or say why there is none in words")]
    NotFinite(String),
    #[error(
        "value {}: its words have the character U+{:04X}, which no format can show; leave it out where they come from",
        one_line(.0, 200), u32::from(*.1)
    )]
    Unshowable(String, char),
    #[error("{}", one_line(.0, MAX_LENGTH))]
    Template(String),
    #[error(transparent)]
    Prose(#[from] crate::prose::Error),
    #[error("{}; the page *Prose* of the manual of literate lists all markup", one_line(.0, 200))]
    Markup(String),
    #[error("{place}: {error}")]
    At { place: Place, error: Box<Error> },
    /// What is wrong with a thing in the prose, by which its place is found.
    #[error("{}", one_line(problem, MAX_LENGTH))]
    Named { thing: Thing, problem: String },
    #[error(
        "the character '{}' (U+{:04X}) is not known in LaTeX; write it as TeX between $ signs, or in words",
        one_line(&.0.to_string(), 1), u32::from(*.0)
    )]
    NoLatex(char),
    #[error(
        "the formula ${}$ cannot be shown: {}; write it differently",
        one_line(tex, 200),
        one_line(problem, 200)
    )]
    Maths { tex: String, problem: String },
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Several(Vec<Error>),
    #[error(
        "hard-coded number {0}; use a value «v.…», or give the reason for a number that is not computed, \
         by «literal(text=…, why=…)» or by its phrase in literals.toml"
    )]
    HardCoded(String),
    #[error("figure {0} is not shown; put ![caption](figures/{0}.svg) into the prose")]
    NotShown(String),
    #[error("equation ({0}) is not shown; add \\tag{{{0}}} to it in the prose")]
    NoEquation(String),
}

impl Error {
    /// Makes the error of an id that two items give to what they compute.
    pub(crate) fn twice(id: &str, first: &str, second: &str) -> Error {
        let [first, second] =
            [first, second].map(|item| if item.is_empty() { "a value" } else { item });
        let problem = "have this id; give one of them another";
        Error::Template(format!("{id}: {first} and {second} {problem}"))
    }

    /// Something that the prose names and that is not there, with the most similar names.
    pub(crate) fn unknown<'a>(
        thing: Thing,
        problem: String,
        names: impl IntoIterator<Item = &'a str>,
    ) -> Error {
        let (Thing::Id(name)
        | Thing::Reference(name)
        | Thing::Link(name)
        | Thing::Picture(name)
        | Thing::Formula(name)) = &thing;
        let nearest = nearest(name, names.into_iter()).join(", ");
        let nearest = if nearest.is_empty() { nearest } else { format!("; nearest: {nearest}") };
        Error::Named { thing, problem: problem + &nearest }
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

    pub(crate) fn check(errors: Vec<Error>) -> Result<(), Error> {
        if errors.is_empty() { Ok(()) } else { Err(Error::Several(errors)) }
    }

    pub(crate) fn into_list(self) -> Vec<Error> {
        match self {
            Error::Several(errors) => errors.into_iter().flat_map(Error::into_list).collect(),
            error => vec![error],
        }
    }

    /// Whether the prose can be read but breaks a rule about its numbers and figures.
    pub fn is_of_rules(&self) -> bool {
        match self {
            Error::HardCoded(_) | Error::NotShown(_) => true,
            Error::At { error, .. } => error.is_of_rules(),
            Error::Several(errors) => errors.iter().all(Error::is_of_rules),
            _ => false,
        }
    }
}
