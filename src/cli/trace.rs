//! `impact-paper trace`.

use super::Failure;

/// Prints the impacts of one scenario as CSV.
#[derive(clap::Args)]
pub struct Args {}

/// Runs the verb.
pub fn run(_args: Args) -> Result<(), Failure> {
    todo!()
}
