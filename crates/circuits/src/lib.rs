//! Sections 3 to 9 of Homer and Hogan (2007): periodic orbits as circuits of the impact graph, how
//! many there are, how likely each is, and what follows for the number of impacts.
//!
//! - [`graph`]: the graph of Sec. 3 and its circuits, one by one (Figs. 4 to 6).
//! - [`counting`]: how many simple circuits there are, Eqs. (6) to (8) (Fig. 7).
//! - [`distribution`]: the number X of different impacts, Eqs. (9) and (10) (Figs. 8 and 9).
//! - [`jump`]: the jump of its most likely value, Eqs. (11) to (18) (Fig. 10).
//! - [`impact_probability`]: the relation of p and σ, Eqs. (20) to (25) (Fig. 11).
//! - [`higher_order`]: circuits that repeat vertices, Eqs. (26) to (38) (Figs. 13 to 15).
//! - [`commuting`]: circuits that differ only by the order of impacts without a common mass (not in
//!   the paper).
//! - [`nucleation`]: gaps of a chain from rest that close by themselves (not in the paper).
//!
//! An [`Error`] names an argument out of its range, or a result below the range of doubles.
//!
//! ```
//! use impact_circuits::distribution::{Law, SampleSpace};
//! use impact_circuits::jump;
//!
//! // A hundred gaps: where f of Eq. (12) has a double zero, and the law of X beyond the jump.
//! let p_crit = jump::p_crit(100)?;
//! assert!((p_crit - 0.0122099).abs() < 1e-7);
//! let law = Law::new(SampleSpace::Simple, 100, 0.02)?;
//! let total: f64 = law.probabilities().iter().sum();
//! assert!((total - 1.0).abs() < 1e-12);
//! # Ok::<(), impact_circuits::Error>(())
//! ```

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod commuting;
pub mod counting;
pub mod distribution;
pub mod graph;
pub mod higher_order;
pub mod impact_probability;
pub mod jump;
pub mod nucleation;

pub use distribution::LARGEST_N;
pub use impact_chain::Error;
