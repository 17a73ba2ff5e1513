//! Values for the templates, and Markdown and LaTeX from them.
//!
//! The flow: experiments' results become [`Value`]s in a [`Registry`]; templates (people's prose)
//! name them; [`templates`] fills them in.

pub mod print;
pub mod templates;
pub mod values;

pub use templates::Templates;
pub use values::{Registry, Value};

/// What is wrong with the report, with the place where it can be mended.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Two values claim one id.
    #[error("value {0}: the id is taken; give one of the two values another id")]
    DuplicateId(String),
    /// An id that a template could not name.
    #[error(
        "value {0}: an id is `name` or `group.name` of a-z, 0-9 and _, beginning with a letter"
    )]
    BadId(String),
    /// NaN or infinity.
    #[error(
        "value {0}: not a finite number; leave the value out or say why there is none in words"
    )]
    NotFinite(String),
    /// A template that cannot be read, parsed or filled; the message has file, line and column.
    #[error("{0}")]
    Template(String),
    /// Files that cannot be read.
    #[error("{path}: {source}; check --templates")]
    Read {
        /// The file or folder.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// Values that nothing names.
    #[error("no template and no claim names {0}; use or remove it, or declare it data_only()")]
    Unused(String),
}
