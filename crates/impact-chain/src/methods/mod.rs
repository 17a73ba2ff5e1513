//! Simulates a chain in several ways under one trait: the engine, its rivals and the true motion.
//!
//! Each rival is a method that is in use, at its best, so that its cost and its failures can be
//! measured on the same scenes. Its documentation names its source, its order and its failures.
//! Methods that locate impacts may be given a least rebound speed: no gap opens more slowly, so
//! masses at rest stay together by many small impacts (the micro-collisions of Mirtich).
//!
//! - [`Certified`]: the engine of this project. [`Truth`], [`truth::TrueMotion`]: the motion to 106
//!   bits.
//! - In closed form: [`Sampled`] gaps, conservative [`Advancement`].
//! - Integrated: a [`RungeKutta`] pair with events, [`MoreauJean`] time stepping, [`Verlet`] with a
//!   flip, [`VerletAbreast`] for many chains, [`Penalty`] springs.

mod advancement;
mod bodies;
mod flights;
mod forcing;
mod method;
mod moreau_jean;
mod penalty;
mod rival;
mod runge_kutta;
mod sampled;
mod steps;
pub mod truth;
mod verlet;
mod verlet_abreast;

pub use advancement::Advancement;
pub use method::{Cost, Method, Task};
pub use moreau_jean::MoreauJean;
pub use penalty::Penalty;
pub use rival::Certified;
pub use runge_kutta::RungeKutta;
pub use sampled::Sampled;
pub use truth::Truth;
pub use verlet::Verlet;
pub use verlet_abreast::{ChainSink, CountedSteps, VerletAbreast};
