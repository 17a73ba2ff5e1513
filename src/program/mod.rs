//! What the programs of this project share: exit codes, signals, threads, standard output, where prose and
//! results lie, and how a report is made and judged.

mod failure;
pub mod git;
pub mod judged;
pub mod make;
pub mod memory;
pub mod signals;
pub mod sources;
pub mod stdout;
pub mod threads;
pub mod work;

pub use failure::Failure;

use crate::experiments::say;
use failure::LONGEST;
use literate::input::{one_line, plain};
use std::path::Path;
use std::process::ExitCode;

/// Tells a fault of the program itself (exit code 1) in one line: what failed, and where.
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
    // No verb takes a value that looks like an option.
    let helps = |line: &&str| !line.is_empty() && !line.starts_with("tip: to pass '");
    let lines = text.lines().map(str::trim).filter(helps);
    let line = lines.collect::<Vec<_>>().join("; ");
    let line = format!("impact-paper: {}", line.strip_prefix("error: ").unwrap_or(&line));
    say(&one_line(&line, LONGEST));
    ExitCode::from(2)
}
