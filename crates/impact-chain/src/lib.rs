#![doc = include_str!("../README.md")]
//!
//! # Contents
//!
//! - [`Chain`], [`Scenario`]: the chain of the model above with equal places, and one with the
//!   amplitudes of its forcing, its start, and places of its choice.
//! - [`Engine`], [`Impact`], [`Counters`], [`Graze`]: the simulation of a scenario, its impacts,
//!   its counted work, and what rounding could not decide.
//! - [`State`]: positions and velocities at a time, and the scenario that goes on from there.
//! - [`Error`], [`rounding`]: input that is refused, and a bound of the errors of impacts.
#![cfg_attr(
    feature = "ensembles",
    doc = "- [`Abreast`]: many realisations of a chain, simulated side by side in half of the time.",
    doc = "- [`counts`], [`rise`]: many random chains, counted in windows; means, and places of the rise."
)]
#![cfg_attr(
    feature = "methods",
    doc = "- [`methods`]: other ways to simulate a chain, to compare with, and the motion to 106 bits."
)]
//!
//! Equations are those of M. Homer and S. J. Hogan (2007), *Impact Dynamics of Large Dimensional
//! Systems*.
//!
//! **Eq. (1)** (step towards (2)): a piecewise smooth system, smooth in flight, with a jump of
//! velocities at impacts.

#![deny(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

#[cfg(feature = "ensembles")]
pub mod abreast;
mod budget;
mod chain;
mod complementarity;
mod contact;
#[cfg(feature = "ensembles")]
pub mod counts;
mod elastic;
mod engine;
mod error;
mod events;
mod flight;
mod force;
mod impact;
#[cfg(feature = "methods")]
pub mod methods;
#[cfg(feature = "ensembles")]
pub mod mode_jump;
#[cfg(feature = "ensembles")]
pub mod rise;
pub mod rounding;
mod scenario;
#[cfg(feature = "serde")]
mod scenario_file;
mod search;
mod simulation;
mod state;
mod topology;
mod validation;
#[cfg(any(feature = "ensembles", feature = "methods"))]
mod vectors;

#[cfg(feature = "ensembles")]
pub use abreast::{Abreast, Counting};
pub use chain::{Boundary, Chain, Start};
#[cfg(feature = "ensembles")]
pub use counts::{Counts, Protocol, Watch};
pub use engine::Engine;
pub use error::{Error, check_range};
#[cfg(any(feature = "ensembles", feature = "methods"))]
pub use impact::HitGaps;
#[cfg(feature = "methods")]
pub use impact::Sink;
pub use impact::{End, Event, Impact};
#[cfg(feature = "random")]
pub use impact_numerics::random::{NormalPairs, Seed};
#[cfg(feature = "ensembles")]
pub use impact_numerics::statistics::Estimate;
pub use scenario::{Initial, Overtone, Scenario};
pub use search::clock::LATEST;
pub use search::outcome::{Counters, Graze};
pub use state::State;
#[cfg(any(feature = "ensembles", feature = "methods"))]
pub use vectors::without_wide_vectors;
