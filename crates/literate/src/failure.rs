//! Turns any error into a message and an exit code.

use crate::claims::{self, PublishedError};
use crate::experiments::{Error, Fault};
use crate::input::{one_line, remedy};
use crate::prose;
use crate::report::{self, folder};
use std::fmt::Display;
use std::io;

/// The exit code of a program that a signal ended: 128 + SIGINT.
pub const INTERRUPTED: u8 = 130;

const LONGEST: usize = 4000;

/// Why something ended without success. `?` makes one of any error.
#[derive(Debug)]
pub struct Failure {
    /// The exit code: 1 where something fails or is stale, 2 for wrong input, 130 after Ctrl-C.
    pub code: u8,
    /// One line: what, where, and what to do; several findings in the prose have a line each.
    pub message: String,
}

impl Failure {
    /// Makes a failure due to wrong usage or input: exit code 2.
    pub fn input(message: impl Into<String>) -> Self {
        Failure { code: 2, message: one_line(&message.into(), LONGEST) }
    }

    /// Makes a failure due to what does not hold, is stale, or failed: exit code 1.
    pub fn check(message: impl Into<String>) -> Self {
        Failure { code: 1, message: one_line(&message.into(), LONGEST) }
    }

    pub(crate) fn io(error: &io::Error, what: impl Display, otherwise: &str) -> Self {
        Failure::input(format!("{what}: {error}; {}", remedy(error, otherwise)))
    }

    pub(crate) fn in_context(self, context: impl Display) -> Self {
        Failure { message: format!("{context}: {}", self.message), ..self }
    }
}

impl<E: std::error::Error + 'static> From<E> for Failure {
    fn from(error: E) -> Self {
        let any = &error as &(dyn std::error::Error + 'static);
        let judged = any.downcast_ref::<claims::Error>().map(claims::Error::cause);
        let run = match judged {
            Some(claims::Error::Experiment(error)) => Some(error),
            _ => any.downcast_ref::<Error>(),
        };
        let code = match run {
            Some(Error(Fault::Interrupted)) => INTERRUPTED,
            Some(Error(Fault::Store { .. }) | Error(Fault::Input { .. })) => 2,
            _ if any.is::<folder::Error>() || any.is::<prose::Error>() => 2,
            _ if any.is::<PublishedError>() => 2,
            _ if matches!(judged, Some(claims::Error::Published(_))) => 2,
            _ if any.downcast_ref().is_some_and(|error: &report::Error| !error.is_of_rules()) => 2,
            _ => 1,
        };
        let lines = error.to_string();
        let lines: Vec<String> = lines.lines().map(|line| one_line(line, LONGEST)).collect();
        Failure { code, message: lines.join("\n") }
    }
}
