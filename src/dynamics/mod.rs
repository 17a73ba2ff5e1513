//! Sections 1 and 2: forced masses in a row that hit one another, simulated without time steps.
//!
//! The chain is a piecewise smooth system: smooth in flight, with a jump of velocities at impacts.
//!
//! **Eq. (1)** (step towards (2)): its general form has no code of its own.

mod certify;
mod contact;
mod engine;
mod error;
mod flight;
mod force;
mod gap;
mod growth;
mod impact;
mod linear;
pub mod methods;
pub mod orbit;
pub mod rounding;
mod scenario;
mod simulation;
mod simultaneous;
mod topology;

pub use certify::{Certificate, TOLERANCE, TWINS, certify};
pub use engine::{Counters, Engine, Impact};
pub use error::Error;
pub use growth::Growth;
pub use scenario::{Initial, Overtone, Scenario};
pub use simultaneous::Simultaneous;
