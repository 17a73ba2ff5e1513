//! Lists what can go wrong in an experiment.

use crate::input::remedy;
use crate::table::Missing;
use std::path::PathBuf;

/// Why an experiment was not run, saved or found; its message says what to do.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct Error(pub(crate) Fault);

#[derive(Debug, thiserror::Error)]
pub(crate) enum Fault {
    #[error("interrupted; nothing was left half-written")]
    Interrupted,
    #[error("{field}: {problem}; {remedy}")]
    Input { field: String, problem: String, remedy: String },
    #[error(transparent)]
    Missing(Missing),
    #[error("{0}")]
    Table(String),
    #[error("{experiment}: {source}")]
    Failed { experiment: &'static str, source: Box<dyn std::error::Error + Send + Sync> },
    #[error("the results of {0} were not run; add it to `needs`")]
    NotRun(&'static str),
    #[error(
        "{0}: JSON loses some of its result, so it was not saved; use `None` where a number is not finite, \
         no `#[serde(skip)]`, and as keys of maps text and whole numbers"
    )]
    Lost(String),
    #[error("--results: {path}: {source}; {}", remedy(source, "choose another folder"))]
    Store { path: PathBuf, source: std::io::Error },
}

impl Error {
    /// Makes the error of an experiment whose run failed, with what went wrong.
    pub fn failed(
        experiment: &'static str,
        source: impl std::error::Error + Send + Sync + 'static,
    ) -> Self {
        Error(Fault::Failed { experiment, source: Box::new(source) })
    }

    /// Makes the error of input that is wrong: which, how, and what to do.
    pub fn input(
        field: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Error(Fault::Input { field: field.into(), problem: problem.into(), remedy: remedy.into() })
    }
}

impl From<Missing> for Error {
    fn from(missing: Missing) -> Self {
        Error(Fault::Missing(missing))
    }
}
