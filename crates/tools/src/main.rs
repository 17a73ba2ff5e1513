//! What the project asks of itself, and no reader runs.

#![warn(clippy::print_stderr, clippy::print_stdout)]

mod bundle;
mod mutate;

use clap::{Parser, Subcommand};
use impact_paper::program::{ended, signals, usage};
use std::process::ExitCode;

/// What the project asks of itself, and no reader runs. Exit codes are those of impact-paper.
#[derive(Parser)]
#[command(version)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    Bundle(bundle::Args),
    Mutate(mutate::verb::Args),
}

fn main() -> ExitCode {
    let verb = match Cli::try_parse() {
        Ok(cli) => cli.verb,
        Err(error) => return usage(&error),
    };
    signals::obey();
    ended(match verb {
        Verb::Bundle(args) => bundle::run(args),
        Verb::Mutate(args) => mutate::verb::run(args),
    })
}
