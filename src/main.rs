//! Starts the program `impact-paper`: [`impact_paper::paper`] lists what the paper is made of, and
//! `cli` has the verbs that it adds to those of [`literate::cli`].

// Macros that print panic on a closed pipe or a full disk: `literate::cli::terminal` does not.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
#![warn(clippy::print_stderr, clippy::print_stdout)]

mod cli;

fn main() -> std::process::ExitCode {
    impact_paper::paper().cli_with(cli::run)
}
