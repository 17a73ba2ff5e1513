//! Runs chains and computes the theory: a file or a folder for each experiment, and the list
//! ([`ALL`]). [`literate::experiments`] saves results and cuts experiments into units.

// Functions take parameters and results as the types that an experiment declares, also vectors.
#![allow(clippy::ptr_arg)]

pub mod accuracy;
pub mod branches;
pub mod ensembles;
pub mod horizon;
pub mod identities;
pub mod jump;
pub mod lengths;
mod list;
pub mod measured;
pub mod nucleation;
pub(crate) mod prelude;
pub mod programs;
pub mod protocol;
pub mod replay;
pub mod restitution;
pub mod seeds;
pub mod segments;
pub mod spacetime;
pub mod starts;
pub mod sweep;
pub mod theory;
pub mod two_masses;

pub use accuracy::{BIAS, RACE, SCALE, TRIALS};
pub use branches::BRANCHES;
pub use horizon::HORIZON;
pub use impact_chain::rise;
pub use jump::MODE_JUMP;
pub use lengths::LENGTHS;
pub use list::{ALL, THEORY, bare};
pub use literate::experiments::{AnyExperiment, Error, Progress, Results, Session, Store, alive};
pub use measured::{MEASURED, Measured};
pub use nucleation::NUCLEATION;
pub use programs::PROGRAMS;
pub use protocol::PROTOCOL;
pub use replay::REPLAY;
pub use restitution::RESTITUTION;
pub use seeds::SEEDS;
pub use segments::SEGMENTS;
pub use spacetime::SPACE_TIME;
pub use starts::STARTS;
pub use sweep::{SECOND_SEED, SWEEP};
pub use two_masses::TWO_MASSES;
