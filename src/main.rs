//! The command line of the literate paper.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
