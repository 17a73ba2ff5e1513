//! Sections 1 and 2: forced masses in a row that hit one another, simulated without time steps.

mod engine;
mod error;
mod scenario;

pub use engine::{Counters, Engine, Impact};
pub use error::Error;
pub use scenario::{Initial, Scenario};
