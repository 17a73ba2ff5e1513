//! Sections 1 and 2: forced masses in a row that hit one another, simulated without time steps.

mod contact;
mod engine;
mod error;
mod flight;
mod gap;
mod impact;
mod linear;
mod scenario;
mod topology;

pub use engine::{Counters, Engine, Impact};
pub use error::Error;
pub use scenario::{Initial, Scenario};
