//! Speed against accuracy: what each way to compute costs, and where it fails.
//!
//! - [`race`]: every method against the true motion, segment by segment and run by run.
//! - [`bias`]: what a method does to the mean number of gaps that impact.
//! - [`scenes`], [`case`], [`trials`]: situations in which methods fail, what must come out of each, and what
//!   each makes of them.
//! - [`scale`]: counted work against the number of masses.
//! - [`tables`]: what all of these say.
//!
//! Cost is counted work here, which is the same on every machine; times of the clock are in
//! [`super::measured`].

pub mod bias;
pub mod case;
pub mod race;
pub mod scale;
pub mod scenes;
pub mod tables;
pub mod trials;
