//! Why a verb ended without success: errors as exit codes.

use super::signals::INTERRUPTED;
use crate::experiments::{Error, say};
use crate::report::{self, contents, folder};
use crate::{claims, figures};
use literate::input::{is_obeyed, one_line, remedy};
use std::fmt::Display;
use std::io;
use std::process::ExitCode;

/// Characters of a message at most.
pub(super) const LONGEST: usize = 4000;

/// Why a verb ended without success: an exit code of the contract and one line for stderr.
#[derive(Debug)]
pub struct Failure {
    /// As in the table of DESIGN.md.
    pub code: u8,
    /// One line: which number, where, and what to do.
    pub message: String,
    /// Whether it is several findings, a line each.
    lines: bool,
}

impl Failure {
    /// Wrong usage or input: exit code 2.
    pub fn input(message: impl Into<String>) -> Self {
        Failure { code: 2, message: message.into(), lines: false }
    }

    /// Something does not hold, is stale, or failed: exit code 1.
    pub fn check(message: impl Into<String>) -> Self {
        Failure { code: 1, message: message.into(), lines: true }
    }

    /// The system refused to read or write `what`: exit code 2.
    pub fn io(error: &io::Error, what: impl Display, otherwise: &str) -> Self {
        Failure::input(format!("{what}: {error}; {}", remedy(error, otherwise)))
    }

    /// The same with a place or an option before it.
    pub fn of(self, place: impl Display) -> Self {
        Failure { message: format!("{place}: {}", self.message), ..self }
    }

    /// The same with another remedy.
    pub fn and(self, remedy: &str) -> Self {
        Failure { message: format!("{}; {remedy}", self.message), ..self }
    }

    /// Tells it on standard error.
    pub(super) fn tell(self) -> ExitCode {
        // Findings in the prose have a line each; names of files may have line breaks.
        let message = match self.lines {
            true => self.message.replace(|c| c != '\n' && is_obeyed(c), " "),
            false => one_line(&self.message, LONGEST),
        };
        say(&format!("impact-paper: {message}"));
        ExitCode::from(self.code)
    }
}

impl From<folder::Error> for Failure {
    fn from(error: folder::Error) -> Self {
        Failure::input(error.to_string())
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = match &error {
            Error::Interrupted => INTERRUPTED,
            Error::Store { .. } | Error::Input { .. } => 2,
            Error::Failed { source, .. }
                if matches!(source.downcast_ref(), Some(impact_chain::Error::Input { .. })) =>
            {
                2
            }
            _ => 1,
        };
        Failure { code, message: error.to_string(), lines: false }
    }
}

impl From<claims::Error> for Failure {
    fn from(error: claims::Error) -> Self {
        match error {
            claims::Error::Published(error) => Failure::input(error.to_string()),
            claims::Error::Experiment(error) => error.into(),
            claims::Error::Undecided => Failure::check(error.to_string()),
        }
    }
}

impl From<contents::Error> for Failure {
    fn from(error: contents::Error) -> Self {
        match error {
            contents::Error::Claims(error) => error.into(),
            contents::Error::Experiment(error) => error.into(),
            contents::Error::Report(error) => error.into(),
            error => Failure::check(error.to_string()),
        }
    }
}

impl From<figures::Error> for Failure {
    fn from(error: figures::Error) -> Self {
        match error {
            figures::Error::Data(error) => error.into(),
            error => Failure::check(error.to_string()),
        }
    }
}

impl From<report::Error> for Failure {
    fn from(error: report::Error) -> Self {
        let lines = matches!(error, report::Error::Several(_));
        match error.is_of_rules() {
            true => Failure::check(error.to_string()),
            false => Failure { lines, ..Failure::input(error.to_string()) },
        }
    }
}
