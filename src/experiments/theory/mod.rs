//! The graph theory of Secs. 3 to 9 as numbers: what Figs. 7 to 15 draw and what the text quotes; and
//! what lies beyond the paper, many vertices (Fig. S6) and circuits up to the order of distant impacts.
//!
//! Cheap and in memory: [`run`] takes some tenths of a second at most and nothing is saved.
//! Distributions are vectors over k = 1..=N (index i holds k = i + 1).

pub(crate) mod beside;
pub(crate) mod curves;
pub(crate) mod distributions;
pub(crate) mod jump;
pub(crate) mod large;
mod results;
pub(crate) mod slips;
pub(crate) mod tables;

pub use large::{Large, LargeJump, LargeShares};
pub use results::*;

use crate::params::{CONVERGENCE_P, DISTRIBUTION_P, HIGHER_P};
use impact_circuits::Error;

/// Computes everything for a graph of `vertices` vertices (main curves) and of one more (thin
/// curves).
///
/// # Errors
/// None for the paper's N = 100; [`Error`] for N without a jump (N ≤ 3) or too large.
pub fn run(vertices: usize) -> Result<Theory, Error> {
    let (scalars, scalars_walls) =
        rayon::join(|| jump::scalars(vertices), || jump::scalars(vertices + 1));
    let (scalars, scalars_walls) = (scalars?, scalars_walls?);
    let each = |values: &[f64], one: fn(usize, f64) -> Result<HigherDistribution, Error>| {
        values.iter().map(|p| one(vertices, *p)).collect::<Result<Vec<_>, _>>()
    };
    let simple = |p: &f64| distributions::simple(vertices, *p);
    let relation = curves::relation()?;
    Ok(Theory {
        vertices,
        simple_circuits: distributions::simple_circuits(vertices)?,
        distributions: DISTRIBUTION_P.iter().map(simple).collect::<Result<_, _>>()?,
        most_likely: curves::most_likely(vertices, &scalars)?,
        mechanism: jump::mechanism(vertices, &scalars)?,
        curve: curves::curve(vertices, &relation)?,
        curve_walls: curves::curve(vertices + 1, &relation)?,
        relation,
        higher: each(&HIGHER_P, distributions::higher)?,
        convergence: each(&CONVERGENCE_P, distributions::higher)?,
        slips: slips::slips(vertices)?,
        large: large::large()?,
        scalars,
        scalars_walls,
    })
}
