//! What the programs of this project share: exit codes, signals, threads, standard output, where prose and
//! results lie, and how a report is made, judged, written and found again.

mod alone;
pub mod folder;
pub mod git;
pub mod judged;
pub mod listed;
pub mod make;
pub mod output;
mod own;
pub mod places;
pub mod sources;
pub mod stdout;
pub mod waiting;
pub mod work;

use crate::experiments::say;
use crate::input::{is_obeyed, one_line, plain, remedy};
use std::fmt::Display;
use std::io;
use std::path::Path;
use std::process::ExitCode;

/// What the project says of itself in Cargo.toml.
pub mod about {
    /// The version.
    pub const VERSION: &str = env!("CARGO_PKG_VERSION");
    /// One line.
    pub const DESCRIPTION: &str = env!("CARGO_PKG_DESCRIPTION");
    /// Who wrote it.
    pub const AUTHORS: &str = env!("CARGO_PKG_AUTHORS");
    /// The oldest compiler.
    pub const RUST_VERSION: &str = env!("CARGO_PKG_RUST_VERSION");
}

/// Tells a fault of the program itself (exit code 4) in one line: what failed, and where.
pub fn tell(fault: &std::panic::PanicHookInfo<'_>) {
    let words = fault.payload_as_str().unwrap_or("no words");
    let place = fault.location().map_or_else(String::new, |at| format!(" at {at}"));
    let remedy = "if saved results were edited, remove them";
    let line = format!("impact-paper: a fault of the program{place}: {words}; {remedy}");
    say(&one_line(&line, LONGEST));
}

/// A path as messages on standard output show it, in one line.
pub fn shown(path: &Path) -> String {
    one_line(&path.display().to_string(), 500)
}

/// Characters of a message at most.
const LONGEST: usize = 4000;

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

    /// Its exit code.
    fn io_code(error: &io::Error) -> u8 {
        use io::ErrorKind::{FileTooLarge, OutOfMemory, QuotaExceeded, StorageFull, WriteZero};
        let full = [FileTooLarge, OutOfMemory, QuotaExceeded, StorageFull, WriteZero];
        // EIO, and ENFILE and EMFILE, which have no kinds of their own.
        let broken =
            cfg!(unix) && error.raw_os_error().is_some_and(|code| [5, 23, 24].contains(&code));
        if full.contains(&error.kind()) || broken { 4 } else { 2 }
    }

    /// The same with another remedy.
    pub fn and(self, remedy: &str) -> Self {
        Failure { message: format!("{}; {remedy}", self.message), ..self }
    }

    /// Tells it on standard error.
    fn tell(self) -> ExitCode {
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

/// The exit code of a verb; why it failed goes to stderr.
pub fn ended(result: Result<(), Failure>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.tell(),
    }
}

/// Help and version go to standard output; a wrong command line becomes one line, exit code 2.
pub fn usage(error: &clap::Error) -> ExitCode {
    use clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
    if !error.use_stderr() || error.kind() == DisplayHelpOnMissingArgumentOrSubcommand {
        return match stdout::written(error.print()) {
            Ok(()) => ExitCode::from(error.exit_code() as u8),
            Err(failure) => failure.tell(),
        };
    }
    let text = plain(&error.to_string());
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let line = lines.collect::<Vec<_>>().join("; ");
    let line = format!("impact-paper: {}", line.strip_prefix("error: ").unwrap_or(&line));
    say(&one_line(&line, LONGEST));
    ExitCode::from(2)
}
