//! The command line of the literate paper.

// What writes to a closed pipe or a full disk by a macro panics: `say` and `cli::stdout` do not.
#![warn(clippy::print_stderr, clippy::print_stdout)]

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
