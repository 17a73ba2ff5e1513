//! `impact-paper eval`.

use super::Failure;

/// Evaluates one quantity of the theory as JSON.
#[derive(clap::Args)]
pub struct Args {}

/// Runs the verb.
pub fn run(_args: Args) -> Result<(), Failure> {
    todo!()
}
