//! Finds the first root of a sum of sinusoids and a constant, with a proof that it is the first.
//!
//! - [`first_root`] searches in frames that lose no digits ([`local_frame`]): polynomials screen a
//!   piece of time ([`screen`]), Taylor polynomials refine a root (`nodes`), certified steps decide
//!   the rest (`stepping`). All of them return an [`outcome`].
//! - [`window`]: waits that are longer than a frame. [`earliest`]: the next event of all gaps.
//! - [`clock`]: instants and phases without drift. [`trig`]: sines with the same bits on every
//!   machine.

pub mod clock;
pub mod earliest;
pub mod first_root;
mod linear;
pub mod local_frame;
mod nodes;
pub mod outcome;
mod pair;
pub mod screen;
pub mod stepping;
pub mod trig;
#[cfg(test)]
pub mod truth;
pub mod window;
