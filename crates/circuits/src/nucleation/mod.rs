//! Nucleation: how likely it is that a gap of a chain at rest closes by itself, and that one of a
//! chain does (ours).
//!
//! - [`reach`]: one gap, within a finite time or ever.
//! - [`pair`]: two neighbouring gaps, which share a mass.
//! - [`chain`]: at least one gap of a chain, with a bound on the error.

pub mod chain;
pub mod pair;
pub mod reach;
