//! Simulates the chain a second time, in higher precision, to be compared with the engine.
//!
//! Nothing here is taken from the engine but the description of a scenario. It works in absolute
//! time with the plain amplitudes of Eq. (19), and searches by certified subdivision of intervals
//! instead of forward stretches, with numbers of 106 bits.

// benches/reference.rs and tests/experiments use a part of this module.
#![allow(dead_code, unused_imports)]

mod chain;
mod gap;

pub use chain::{Hit, Reference};
pub use impact_numerics::double_double::{DoubleDouble as Dd, sin_cos};

/// Relative rounding error of one operation (a generous bound).
const EPS: f64 = 1e-31;
