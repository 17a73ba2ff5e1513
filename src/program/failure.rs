//! Why a verb ended without success: errors as exit codes.

use super::signals::{INTERRUPTED, yield_to_end};
use crate::experiments::{Error, say};
use crate::report::{self, contents};
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
}

impl Failure {
    /// Wrong usage or input: exit code 2.
    pub fn input(message: impl Into<String>) -> Self {
        Failure { code: 2, message: message.into() }
    }

    /// Something was held against something else and failed: exit code 1.
    pub fn check(message: impl Into<String>) -> Self {
        Failure { code: 1, message: message.into() }
    }

    /// The system refused to read or write `what`: exit code 4 where no other place or name would help,
    /// else 2 and the remedy.
    pub fn io(error: &io::Error, what: impl Display, otherwise: &str) -> Self {
        let message = format!("{what}: {error}; {}", remedy(error, otherwise));
        Failure { code: Self::io_code(error), message }
    }

    /// Refuses what the system, and not the file, is at fault for: of anything else the caller knows more.
    ///
    /// # Errors
    /// Exit code 4.
    pub fn of_the_system(error: &io::Error, what: impl Display) -> Result<(), Self> {
        match Self::io(error, what, "try again, or use another disk") {
            failure if failure.code == 4 => Err(failure),
            _ => Ok(()),
        }
    }

    /// Its exit code.
    fn io_code(error: &io::Error) -> u8 {
        use io::ErrorKind::{
            FileTooLarge, OutOfMemory, QuotaExceeded, StaleNetworkFileHandle, StorageFull,
            WriteZero,
        };
        let full = [
            FileTooLarge,
            OutOfMemory,
            QuotaExceeded,
            StaleNetworkFileHandle,
            StorageFull,
            WriteZero,
        ];
        // EIO, and ENFILE and EMFILE, which have no kinds of their own.
        let broken =
            cfg!(unix) && error.raw_os_error().is_some_and(|code| [5, 23, 24].contains(&code));
        if full.contains(&error.kind()) || broken { 4 } else { 2 }
    }

    /// The same, told of an option.
    pub fn of(self, option: &str) -> Self {
        Failure { message: format!("{option}: {}", self.message), ..self }
    }

    /// The same with another remedy.
    pub fn and(self, remedy: &str) -> Self {
        Failure { message: format!("{}; {remedy}", self.message), ..self }
    }

    /// Tells it on standard error.
    pub(super) fn tell(self) -> ExitCode {
        yield_to_end();
        // Findings in the prose have a line each; names of files may have line breaks.
        let message = match self.code {
            1 => self.message.replace(|c| c != '\n' && is_obeyed(c), " "),
            _ => one_line(&self.message, LONGEST),
        };
        say(&format!("impact-paper: {message}"));
        ExitCode::from(self.code)
    }

    /// Saved results are stale: exit code 3.
    pub fn stale(message: impl Into<String>) -> Self {
        Failure { code: 3, message: message.into() }
    }

    /// A run failed: exit code 4.
    pub fn run(message: impl Into<String>) -> Self {
        Failure { code: 4, message: message.into() }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = match &error {
            Error::Interrupted => INTERRUPTED,
            Error::Store { source, .. } => Failure::io_code(source),
            Error::Input { .. } | Error::Foreign { .. } => 2,
            Error::Failed { source, .. } if is_input(source.as_ref()) => 2,
            _ => 4,
        };
        Failure { code, message: error.to_string() }
    }
}

/// Whether a run was refused for what it was given.
fn is_input(error: &(dyn std::error::Error + Send + Sync + 'static)) -> bool {
    matches!(error.downcast_ref(), Some(impact_chain::Error::Input { .. }))
}

impl From<claims::Error> for Failure {
    fn from(error: claims::Error) -> Self {
        match error {
            claims::Error::Published(error) => Failure::input(error.to_string()),
            claims::Error::Experiment(error) => error.into(),
        }
    }
}

impl From<contents::Error> for Failure {
    fn from(error: contents::Error) -> Self {
        match error {
            contents::Error::Claims(error) => error.into(),
            contents::Error::Experiment(error) => error.into(),
            contents::Error::Report(error) => error.into(),
            contents::Error::Rows(_) | contents::Error::Missing(_) => {
                Failure::run(error.to_string())
            }
        }
    }
}

impl From<figures::Error> for Failure {
    fn from(error: figures::Error) -> Self {
        let told = error.to_string();
        match error {
            figures::Error::Data(error) => error.into(),
            _ => Failure::run(told),
        }
    }
}

impl From<report::Error> for Failure {
    fn from(error: report::Error) -> Self {
        use report::Error::{Lint, NotShown, Unused};
        use report::lint::Fault;
        match error {
            Lint(ref found) if !found.iter().all(|one| matches!(one.fault, Fault::Numeral(_))) => {
                Failure::input(error.to_string())
            }
            // What can be read, and breaks a rule of the prose.
            Lint(_) | NotShown(_) | Unused(_) => Failure::check(error.to_string()),
            report::Error::Read { ref source, .. } => {
                Failure { code: Failure::io_code(source), message: error.to_string() }
            }
            _ => Failure::input(error.to_string()),
        }
    }
}
