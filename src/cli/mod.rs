//! One file per verb; the exit codes are a contract.

mod audit;
mod bench;
mod bundle;
mod check;
mod diff;
mod eval;
mod explain;
mod folder;
mod git;
mod judged;
mod make;
mod merge;
mod method;
mod mutate;
mod output;
mod paper;
mod plan;
mod shard;
mod sigmas;
mod sources;
mod status;
mod stdout;
mod sweep;
mod trace;
mod verify;
mod work;

use clap::{Parser, Subcommand};
use impact_paper::experiments::say;
use impact_paper::input::one_line;
use std::io;
use std::process::ExitCode;

/// The contract; DESIGN.md has the same table.
const EXIT_CODES: &str = "Exit codes:
  0    fine
  1    a claim, target, check or comparison failed, and what was asked for is written all the same; or a rule of
       the prose is broken (a naked numeral, an unused value), and nothing is
  2    wrong usage or input, broken prose too, or a place that cannot be written
  3    saved results are stale or missing
  4    a run failed, or the system did: a full disk, an I/O error
  130  ended by Ctrl-C or SIGTERM";

/// Version, and the commit in a build from a checkout: that of the last change of the source.
const VERSION: &str =
    concat!(env!("CARGO_PKG_VERSION"), include_str!(concat!(env!("OUT_DIR"), "/commit.txt")));

/// The literate, reproducible edition of Homer & Hogan (2007), Impact Dynamics of Large
/// Dimensional Systems.
#[derive(Parser)]
#[command(
    version = VERSION,
    after_help = EXIT_CODES
)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    Audit(audit::Args),
    Bench(bench::Args),
    Bundle(bundle::Args),
    Check(check::Args),
    Diff(diff::Args),
    Eval(eval::Args),
    Explain(explain::Args),
    Merge(merge::Args),
    Mutate(mutate::Args),
    Paper(paper::Args),
    Plan(plan::Args),
    Run(shard::Args),
    Status(status::Args),
    Sweep(sweep::Args),
    Trace(trace::Args),
    Verify(verify::Args),
}

/// Characters of a message at most.
const LONGEST: usize = 4000;

/// Why a verb ended without success: an exit code of the contract and one line for stderr.
#[derive(Debug)]
pub struct Failure {
    /// As in [`EXIT_CODES`].
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

    /// The system refused to read or write: exit code 4 where no other place or name would help.
    pub fn io(error: &io::Error, message: impl Into<String>) -> Self {
        use io::ErrorKind::{FileTooLarge, OutOfMemory, QuotaExceeded, StorageFull, WriteZero};
        let full = [FileTooLarge, OutOfMemory, QuotaExceeded, StorageFull, WriteZero];
        // EIO has no kind of its own.
        let broken = cfg!(unix) && error.raw_os_error() == Some(5);
        let code = if full.contains(&error.kind()) || broken { 4 } else { 2 };
        Failure { code, message: message.into() }
    }

    /// Tells it on standard error.
    fn tell(self) -> ExitCode {
        // Findings in the prose have a line each; names of files may have line breaks.
        let message = if self.code == 1 { self.message } else { one_line(&self.message, LONGEST) };
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

/// Parses the command line and runs the verb.
pub fn main() -> ExitCode {
    let verb = match Cli::try_parse() {
        Ok(cli) => cli.verb,
        Err(error) => return usage(&error),
    };
    work::obey_signals();
    let result = match verb {
        Verb::Audit(args) => audit::run(args),
        Verb::Bench(args) => bench::run(args),
        Verb::Bundle(args) => bundle::run(args),
        Verb::Check(args) => check::run(args),
        Verb::Diff(args) => diff::run(args),
        Verb::Eval(args) => eval::run(args),
        Verb::Explain(args) => explain::run(args),
        Verb::Merge(args) => merge::run(args),
        Verb::Mutate(args) => mutate::run(args),
        Verb::Paper(args) => paper::run(args),
        Verb::Plan(args) => plan::run(args),
        Verb::Run(args) => shard::run(args),
        Verb::Status(args) => status::run(args),
        Verb::Sweep(args) => sweep::run(args),
        Verb::Trace(args) => trace::run(args),
        Verb::Verify(args) => verify::run(args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.tell(),
    }
}

/// Help and version go to standard output; a wrong command line becomes one line, exit code 2.
fn usage(error: &clap::Error) -> ExitCode {
    use clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
    if !error.use_stderr() || error.kind() == DisplayHelpOnMissingArgumentOrSubcommand {
        return match stdout::written(error.print()) {
            Ok(()) => ExitCode::from(error.exit_code() as u8),
            Err(failure) => failure.tell(),
        };
    }
    let text = error.to_string();
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let line = lines.collect::<Vec<_>>().join("; ");
    say(&format!("impact-paper: {}", line.strip_prefix("error: ").unwrap_or(&line)));
    ExitCode::from(2)
}
