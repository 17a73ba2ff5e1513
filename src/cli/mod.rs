//! One file per verb; the exit codes are a contract.

mod check;
mod diff;
mod eval;
mod explain;
mod paper;
mod run;
mod sigmas;
mod sweep;
mod trace;
mod verify;

use clap::{Parser, Subcommand};
use impact_paper::experiments::be_quiet;
use impact_paper::program::{
    self, Failure, git, judged, make, memory, shown, signals, sources, stdout, threads, work,
};
use impact_paper::report::values::Number;
use impact_paper::report::{compare, folder};
use std::path::Path;
use std::process::ExitCode;

/// The contract; DESIGN.md has the same table.
const EXIT_CODES: &str = "Exit codes:
  0    fine
  1    a claim, target, check or comparison failed, and what was asked for is written all
       the same; a rule of the prose is broken (a naked numeral, an unused value) or a run
       failed, and nothing is; or saved results are stale, says `paper --dry-run`
  2    wrong usage or input, broken prose too, or a place that cannot be read or written
  130  ended by Ctrl-C or SIGTERM";

/// Version, and the commit in a build from a checkout: that of the last change of the source.
const VERSION: &str =
    concat!(env!("CARGO_PKG_VERSION"), include_str!(concat!(env!("OUT_DIR"), "/commit.txt")));

/// The literate, reproducible edition of Homer & Hogan (2007), Impact Dynamics of Large
/// Dimensional Systems.
#[derive(Parser)]
#[command(version = VERSION, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
    /// Say nothing of progress; errors are told all the same.
    #[arg(long, short, global = true)]
    quiet: bool,
}

/// A reader of numbers in a range, both ends among them.
fn within(
    low: f64,
    high: f64,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| {
        let range = || format!("give a number from {low:?} to {high:?}");
        let number = text.trim().parse::<f64>().map_err(|_| range())?;
        // A negative zero would be printed as one.
        (low..=high).contains(&number).then_some(number + 0.0).ok_or_else(range)
    }
}

#[derive(Subcommand)]
enum Verb {
    Paper(paper::Args),
    Check(check::Args),
    Verify(verify::Args),
    Diff(diff::Args),
    Run(run::Args),
    Explain(explain::Args),
    Eval(eval::Args),
    Sweep(sweep::Args),
    Trace(trace::Args),
}

/// Parses the command line and runs the verb.
pub fn main() -> ExitCode {
    let Cli { verb, quiet } = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return program::usage(&error),
    };
    if quiet {
        be_quiet();
    }
    signals::obey();
    let result = match verb {
        Verb::Check(args) => check::run(args),
        Verb::Diff(args) => diff::run(args),
        Verb::Eval(args) => eval::run(args),
        Verb::Explain(args) => explain::run(args),
        Verb::Paper(args) => paper::run(args),
        Verb::Run(args) => run::run(args),
        Verb::Sweep(args) => sweep::run(args),
        Verb::Trace(args) => trace::run(args),
        Verb::Verify(args) => verify::run(args),
    };
    program::ended(result)
}

/// The profile that a report names, if there is one in a folder.
fn profile_in(root: &Path) -> Option<String> {
    let text = String::from_utf8(folder::read(root, "values.json").ok()?).ok()?;
    match &compare::read(&text).ok()?.get("profile")?.number {
        Number::Text(name) => Some(name.clone()),
        _ => None,
    }
}
