//! Speed against accuracy: the cost of each method, and where it fails.
//!
//! - [`race`]: every method against the true motion, segment by segment and run by run.
//! - [`bias`]: the error of a method in the mean number of gaps that impact.
//! - [`scenes`], [`case`], [`trials`]: situations in which methods fail, the expected outcomes, and those found.
//! - [`scale`]: counted work against the number of masses.
//! - [`tables`]: the numbers of all of these.
//!
//! Cost is counted work here, which is the same on every machine; times of the clock are in [`super::measured`].

pub mod bias;
pub mod case;
pub mod race;
pub mod scale;
pub mod scenes;
pub mod tables;
pub mod trials;
