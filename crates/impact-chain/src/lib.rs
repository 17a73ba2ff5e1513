#![doc = include_str!("../README.md")]
//!
//! Numbers of equations are those of M. Homer and S. J. Hogan (2007), *Impact Dynamics of Large Dimensional
//! Systems*. The chain is a piecewise smooth system: smooth in flight, with a jump of velocities at impacts.
//!
//! **Eq. (1)** (step towards (2)): its general form has no code of its own.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod chain;
mod contact;
pub mod counts;
mod elastic;
mod engine;
mod ensemble;
mod error;
mod flight;
mod force;
mod impact;
mod linear;
pub mod methods;
pub mod replay;
pub mod rise;
pub mod rounding;
mod scenario;
mod search;
mod simulation;
mod topology;

pub use chain::{Boundary, Chain, Start};
pub use counts::Counts;
pub use engine::{Engine, Impact};
pub use ensemble::{Beyond, Ensemble, Heating, Protocol, work};
pub use error::Error;
pub use scenario::{Initial, Overtone, Scenario};
pub use search::clock::LATEST;
pub use search::first_root::Counters;
