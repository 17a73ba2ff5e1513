//! An independent simulator of the chain in higher precision, with which the engine is compared.
//!
//! Nothing here is taken from the engine but the description of a scenario. It works in absolute
//! time with the plain amplitudes of Eq. (19), searches by certified subdivision of intervals
//! instead of forward stretches, and is generic over its numbers: [`Dd`] (106 bits, fast) and
//! [`Big`] (256 bits, dashu's sine and cosine) check each other.

// benches/reference.rs uses a part of this module.
#![allow(dead_code, unused_imports)]

pub mod chain;
pub mod gap;
pub mod real;

pub use chain::{Hit, Reference};
pub use gap::Gap;
pub use real::{Big, Dd, Real};
