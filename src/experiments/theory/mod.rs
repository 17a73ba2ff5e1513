//! The graph theory of Secs. 3 to 9 as numbers: what Figs. 7 to 15 draw and what the text quotes.
//!
//! Cheap and in memory: [`run`] takes some hundredths of a second and nothing is saved. Distributions are
//! vectors over k = 1..=N (index i holds k = i + 1).

mod results;

pub use results::*;

/// Computes everything for a graph of `vertices` vertices (main curves) and of one more (thin curves).
///
/// # Errors
/// None for the paper's N = 100; see [`crate::circuits::Error`] for N that are too small or large.
pub fn run(_vertices: usize) -> Result<Theory, String> {
    todo!()
}
