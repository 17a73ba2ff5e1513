//! What can go wrong in an experiment.

use crate::input::remedy;
use std::path::PathBuf;

/// An error of an experiment.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Ctrl-C or a request to end; nothing is saved of the running experiment.
    #[error("interrupted; nothing was left half-written")]
    Interrupted,
    /// A parameter is outside what the experiment allows (exit code 2).
    #[error("{field}: {problem}; {remedy}")]
    Input {
        /// Name of the parameter.
        field: String,
        /// What is wrong, with the value.
        problem: String,
        /// What to write instead.
        remedy: String,
    },
    /// A run failed that must not fail.
    #[error("{experiment}: {source}")]
    Failed {
        /// The experiment.
        experiment: &'static str,
        /// What failed.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// A result was asked for that was not run.
    #[error("the results of {0} were not run; declare them among what is needed")]
    NotRun(&'static str),
    /// A result holds a number that is not finite, or that does not survive saving.
    #[error(
        "{experiment}: a result is not finite, so it was not saved; this is a fault of the program"
    )]
    NotFinite {
        /// The experiment.
        experiment: String,
    },
    /// An audit needs a result that is fresh.
    #[error("{name}: there is nothing to audit: {why}")]
    Stale {
        /// The experiment.
        name: &'static str,
        /// The reasons.
        why: String,
    },
    /// A unit of work gave something else than its experiment understands.
    #[error("{name}: what a unit of work gave is not understood; run its shard again")]
    NotUnderstood {
        /// The experiment.
        name: &'static str,
    },
    /// Units of work that are not there as this program would make them.
    #[error("{what}; {remedy}")]
    Units {
        /// Which, and what is the matter.
        what: String,
        /// What to do.
        remedy: String,
    },
    /// The results directory cannot be written.
    #[error(
        "results directory {path}: {source}; {}",
        remedy(source, "choose another with --results")
    )]
    Store {
        /// File or directory.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

impl Error {
    /// An [`Error::Failed`] of an experiment.
    pub fn failed(
        experiment: &'static str,
        source: impl std::error::Error + Send + Sync + 'static,
    ) -> Self {
        Error::Failed { experiment, source: Box::new(source) }
    }

    /// An [`Error::Input`] from its three parts.
    pub fn input(
        field: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Error::Input { field: field.into(), problem: problem.into(), remedy: remedy.into() }
    }
}
