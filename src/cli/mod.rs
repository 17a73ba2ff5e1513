//! One file per verb; the exit codes are a contract.

mod eval;
mod trace;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// The literate, reproducible edition of Homer & Hogan (2007), Impact Dynamics of Large
/// Dimensional Systems.
#[derive(Parser)]
#[command(
    version,
    after_help = "Exit codes: 0 fine, 1 a claim or lint failed, 2 wrong usage or input, 3 stale, 4 a run failed."
)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    Eval(eval::Args),
    Trace(trace::Args),
}

/// Why a verb ended without success: an exit code of the contract and one line for stderr.
#[derive(Debug)]
pub struct Failure {
    /// 1 a claim or lint failed, 2 wrong usage or input, 3 stale, 4 a run failed.
    pub code: u8,
    /// One line: which number, where, and what to do.
    pub message: String,
}

impl Failure {
    /// Wrong usage or input: exit code 2.
    pub fn input(message: impl Into<String>) -> Self {
        Failure { code: 2, message: message.into() }
    }

    /// A run failed: exit code 4.
    pub fn run(message: impl Into<String>) -> Self {
        Failure { code: 4, message: message.into() }
    }
}

/// Parses the command line and runs the verb.
pub fn main() -> ExitCode {
    let result = match Cli::parse().verb {
        Verb::Eval(args) => eval::run(args),
        Verb::Trace(args) => trace::run(args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("impact-paper: {}", failure.message);
            ExitCode::from(failure.code)
        }
    }
}
