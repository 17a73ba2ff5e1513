//! The command line of the literate paper.

// What writes to a closed pipe or a full disk by a macro panics: `say` and `program::stdout` do not.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
#![warn(clippy::print_stderr, clippy::print_stdout)]

mod cli;

use impact_paper::program::{tell, threads};
use std::process::ExitCode;

fn main() -> ExitCode {
    std::panic::set_hook(Box::new(tell));
    let thread = std::thread::Builder::new().stack_size(threads::STACK).spawn(cli::main);
    match thread.map(std::thread::JoinHandle::join) {
        Ok(Ok(code)) => code,
        // The hook has told it.
        Ok(Err(_)) => ExitCode::FAILURE,
        Err(_) => cli::main(),
    }
}
