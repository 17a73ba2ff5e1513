//! Reads the command line of a paper, and runs its verb: `paper`, `check`, `explain`, `diff`,
//! `verify`, `run`, or one that a paper adds.

mod check;
mod common;
mod diff;
mod explain;
mod paper;
mod run;
pub mod terminal;
mod verify;

use crate::experiments::be_quiet;
use crate::failure::Failure;
use crate::input::in_plain_words;
use crate::paper::Paper;
use clap::error::ErrorKind;
use clap::{Command, CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

const EXIT_CODES: &str = "Exit codes:
  0    fine
  1    a statement, relation or comparison failed, but the files were written; a rule of the
       prose is broken (a hard-coded number) or a run failed, and nothing was written; or
       `paper --dry-run` found stale results
  2    wrong usage or input, including broken prose, or a path that cannot be read or written
  130  ended by Ctrl-C, SIGTERM or SIGHUP

The project is the first folder from the current one upwards that has the source of this program;
elsewhere the environment variable LITERATE_PROJECT can name it.";

#[derive(Parser)]
struct Cli<V: Subcommand> {
    #[command(subcommand)]
    verb: Verb<V>,
    /// Do not show progress; errors are still printed.
    #[arg(long, short, global = true)]
    quiet: bool,
}

#[derive(Subcommand)]
enum Verb<V: Subcommand> {
    Paper(paper::Args),
    Check(check::Args),
    Explain(explain::Args),
    Diff(diff::Args),
    Verify(verify::Args),
    Run(run::Args),
    #[command(flatten)]
    More(V),
}

/// No verb beyond those of every paper.
#[derive(Subcommand)]
enum None {}

impl Paper {
    /// Runs the command line of the program; what it returns is the exit code.
    pub fn cli(self) -> ExitCode {
        self.cli_with(|none: None| match none {})
    }

    /// The same with more verbs, and what each of them does.
    pub fn cli_with<V: Subcommand>(self, more: impl FnOnce(V) -> Result<(), Failure>) -> ExitCode {
        std::panic::set_hook(Box::new(terminal::report_panic));
        let run = || self.run_with(std::env::args_os().collect(), more);
        // The hook has said what went wrong.
        catch_unwind(AssertUnwindSafe(run)).unwrap_or(1).into()
    }

    /// Runs a command line, which begins with the name of the program; returns its exit code.
    pub fn run(&self, line: Vec<OsString>) -> u8 {
        self.run_with(line, |none: None| match none {})
    }

    fn run_with<V: Subcommand>(
        &self,
        line: Vec<OsString>,
        more: impl FnOnce(V) -> Result<(), Failure>,
    ) -> u8 {
        let crate::Sources { name, version, .. } = self.project.sources;
        let command: Command = Cli::<V>::command().name(name).bin_name(name).version(version);
        let command = command.about(self.edition.title).after_help(EXIT_CODES);
        let parsed = command.try_get_matches_from(line);
        let result = match parsed.and_then(|matches| Cli::<V>::from_arg_matches(&matches)) {
            Ok(Cli { verb, quiet }) => {
                if quiet {
                    be_quiet();
                }
                terminal::install_signals();
                match verb {
                    Verb::Paper(args) => paper::run(self, args),
                    Verb::Check(args) => check::run(self, args),
                    Verb::Explain(args) => explain::run(self, args),
                    Verb::Diff(args) => diff::run(args),
                    Verb::Verify(args) => verify::run(self, args),
                    Verb::Run(args) => run::run(self, args),
                    Verb::More(verb) => more(verb),
                }
            }
            Err(error) => usage(&error),
        };
        match result {
            Ok(()) => 0,
            Err(failure) => {
                failure.message.lines().for_each(terminal::warn);
                failure.code
            }
        }
    }
}

/// Prints help and version on standard output; a wrong command line is one line and exit code 2.
fn usage(error: &clap::Error) -> Result<(), Failure> {
    if !error.use_stderr() {
        return terminal::written(error.print());
    }
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        terminal::written(error.print())?;
        return Err(Failure { code: 2, message: String::new() });
    }
    let message = in_plain_words(&error.to_string());
    // No verb takes a value that looks like an option.
    let helps = |line: &&str| !line.is_empty() && !line.starts_with("tip: to pass '");
    let is_problem = |line: &&str| !line.starts_with("Usage: ") && !line.starts_with("For more ");
    let lines = message.lines().map(str::trim).filter(helps).take_while(is_problem);
    let line = lines.chain(["--help explains"]).collect::<Vec<_>>().join("; ").replace(":; ", ": ");
    Err(Failure::input(line.strip_prefix("error: ").unwrap_or(&line)))
}
