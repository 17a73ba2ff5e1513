//! Simulates the chain a second time, with 106 bits. Nothing is taken from the engine but the
//! description of a scenario: absolute time, the amplitudes of Eq. (19), subdivision of intervals.

// benches/reference.rs and tests/experiments use a part of this module.
#![allow(dead_code, unused_imports)]

mod chain;
mod gap;

pub use chain::{Hit, Reference};
pub use impact_numerics::double_double::{DoubleDouble as Dd, sin_cos};

/// Relative rounding error of one operation (a generous bound).
const EPS: f64 = 1e-31;
