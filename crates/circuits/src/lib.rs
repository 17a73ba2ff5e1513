//! Sections 3 to 9: periodic orbits as circuits of the impact graph, how many there are, how
//! likely each is, and what that says about the number of impacts.
//!
//! - [`graph`]: the graph of Sec. 3 and its circuits, one by one (Figs. 4 to 6).
//! - [`counting`]: how many simple circuits there are, Eqs. (6) to (8) (Fig. 7).
//! - [`distribution`]: the number X of different impacts, Eqs. (9) and (10) (Figs. 8 and 9).
//! - [`jump`]: why its most likely value jumps, Eqs. (11) to (18) (Fig. 10).
//! - [`impact_probability`]: the relation of p and σ, Eqs. (20) to (25) (Fig. 11).
//! - [`higher_order`]: circuits that repeat vertices, Eqs. (26) to (38) (Figs. 13 to 15).
//! - [`commuting`]: orders of impacts that no mass notices (ours).
//! - [`large`]: Eq. (10) and its jump for many vertices (ours).
//! - [`nucleation`]: gaps of a chain at rest that close by themselves (ours).
//!
//! ```
//! use impact_circuits::distribution::{Law, SampleSpace};
//! use impact_circuits::jump;
//!
//! // A hundred gaps: where Φ has a double zero, and how many gaps are most likely hit just beyond the jump.
//! let p_crit = jump::p_crit(100)?;
//! assert!((p_crit - 0.0122099).abs() < 1e-7);
//! let law = Law::new(SampleSpace::Simple, 100, 0.02)?;
//! let total: f64 = law.probabilities().iter().sum();
//! assert!((total - 1.0).abs() < 1e-12);
//! # Ok::<(), impact_circuits::Error>(())
//! ```

pub mod commuting;
pub mod counting;
pub mod distribution;
mod error;
mod fraction;
mod from_rest;
pub mod graph;
pub mod higher_order;
pub mod impact_probability;
pub mod jump;
pub mod large;
pub mod nucleation;

pub use error::Error;
pub use fraction::Fraction;

/// The largest number of vertices for which a quantity is computed: each takes a time that grows
/// at most in proportion to N, some seconds at this bound.
pub const LARGEST_N: usize = 10_000_000;

/// Refuses a number of vertices outside 1..=[`LARGEST_N`].
pub(crate) fn check_vertices(big_n: usize) -> Result<(), Error> {
    if (1..=LARGEST_N).contains(&big_n) {
        return Ok(());
    }
    let problem = format!("{big_n} vertices");
    Err(Error::input("vertices", problem, format!("give 1 ≤ N ≤ {LARGEST_N}")))
}

/// Refuses an edge probability outside [0, 1].
pub(crate) fn check_p(p: f64) -> Result<(), Error> {
    if (0.0..=1.0).contains(&p) {
        return Ok(());
    }
    Err(Error::input("p", format!("{p:?} is not a probability"), "give 0 ≤ p ≤ 1"))
}

/// Refuses a number of different vertices outside 1..=N.
pub(crate) fn check_k(big_n: usize, k: usize) -> Result<(), Error> {
    if (1..=big_n).contains(&k) {
        return Ok(());
    }
    let problem = format!("{k} is outside 1..{big_n}");
    Err(Error::input("k", problem, format!("give 1 ≤ k ≤ {big_n}, the number of vertices")))
}
