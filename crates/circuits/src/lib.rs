//! Sections 3 to 9: periodic orbits as circuits of the impact graph, how many there are, how
//! likely each is, and what follows for the number of impacts.
//!
//! - [`graph`]: the graph of Sec. 3 and its circuits, one by one (Figs. 4 to 6).
//! - [`counting`]: how many simple circuits there are, Eqs. (6) to (8) (Fig. 7).
//! - [`distribution`]: the number X of different impacts, Eqs. (9) and (10) (Figs. 8 and 9).
//! - [`jump`]: the jump of its most likely value, Eqs. (11) to (18) (Fig. 10).
//! - [`impact_probability`]: the relation of p and σ, Eqs. (20) to (25) (Fig. 11).
//! - [`higher_order`]: circuits that repeat vertices, Eqs. (26) to (38) (Figs. 13 to 15).
//! - [`commuting`]: circuits that differ only by the order of impacts without a common mass (ours).
//! - [`nucleation`]: gaps of a chain from rest that close by themselves (ours).
//!
//! ```
//! use impact_circuits::distribution::{Law, SampleSpace};
//! use impact_circuits::jump;
//!
//! // A hundred gaps: the p at which f has a double zero, and the distribution of X beyond the jump.
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

/// An argument outside the theory, or a value outside the range of doubles.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field}: {problem}; {remedy}")]
pub struct Error {
    /// The field: `vertices`, `p`, `k`, `sigma`, `omega`, `forcing-frequency` or `spacing`.
    pub field: &'static str,
    /// What is wrong, with the value.
    pub problem: String,
    /// What to give instead.
    pub remedy: String,
}

impl Error {
    pub(crate) fn new(field: &'static str, problem: String, remedy: impl Into<String>) -> Self {
        Error { field, problem, remedy: remedy.into() }
    }

    /// A positive quantity is below the range of doubles at a σ.
    pub(crate) fn underflow(what: &str, sigma: f64, remedy: &str) -> Self {
        let problem = format!("{what} is below the range of double precision at σ = {sigma:e}");
        Error::new("sigma", problem, remedy)
    }
}

/// A non-negative fraction in lowest terms: printed formulas need not give integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fraction {
    /// Above the line.
    pub numerator: u128,
    /// Below the line, > 0.
    pub denominator: u128,
}

impl Fraction {
    /// `numerator`/`denominator` in lowest terms; the denominator must not be zero.
    pub fn new(numerator: u128, denominator: u128) -> Self {
        let divisor = gcd(numerator, denominator).max(1);
        Fraction { numerator: numerator / divisor, denominator: denominator / divisor }
    }

    /// The integer it equals, if it does.
    pub fn integer(self) -> Option<u128> {
        (self.denominator == 1).then_some(self.numerator)
    }

    /// The nearest double, up to a rounding of both parts.
    pub fn to_f64(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

/// Greatest common divisor, gcd(0, b) = b.
fn gcd(a: u128, b: u128) -> u128 {
    if a == 0 { b } else { gcd(b % a, a) }
}

/// The largest number of vertices for which a quantity is computed: each takes a time that grows
/// at most in proportion to N, some seconds at this bound.
pub const LARGEST_N: usize = 10_000_000;

/// Refuses a number of vertices outside 1..=[`LARGEST_N`].
pub(crate) fn check_vertices(big_n: usize) -> Result<(), Error> {
    if (1..=LARGEST_N).contains(&big_n) {
        return Ok(());
    }
    let remedy = format!("give 1 ≤ N ≤ {LARGEST_N}");
    Err(Error::new("vertices", format!("{big_n} vertices"), remedy))
}

/// Refuses an edge probability outside [0, 1].
pub(crate) fn check_p(p: f64) -> Result<(), Error> {
    if (0.0..=1.0).contains(&p) {
        return Ok(());
    }
    Err(Error::new("p", format!("{p:?} is not a probability"), "give 0 ≤ p ≤ 1"))
}

/// Refuses a number of different vertices outside 1..=N.
pub(crate) fn check_k(big_n: usize, k: usize) -> Result<(), Error> {
    if (1..=big_n).contains(&k) {
        return Ok(());
    }
    let problem = format!("{k} is outside 1..{big_n}");
    Err(Error::new("k", problem, format!("give 1 ≤ k ≤ {big_n}, the number of vertices")))
}
