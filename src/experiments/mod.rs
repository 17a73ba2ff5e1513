//! What is run: one experiment a file. How experiments are saved, cut and carried over is for
//! [`literate::experiments`].

pub mod accuracy;
pub mod catalogue;
pub mod chains;
pub mod heat;
pub mod history;
pub mod horizon;
pub mod identities;
pub mod independence;
pub mod long;
pub mod measured;
pub mod nucleation;
pub mod observe;
pub mod orbits;
pub mod protocol;
pub mod protocol_tables;
pub mod protocols;
pub mod restitution;
pub mod rise;
pub mod run;
pub mod seeds;
pub mod segments;
pub mod spacetime;
pub mod starts;
pub mod starts_tables;
pub mod survival;
pub mod sweep;
pub mod tally;
pub mod theory;
pub mod two_masses;
pub mod weights;

pub mod built;
mod results;

pub use literate::experiments::{Error, Need, Progress, Store, say};
pub use measured::Measured;
pub use results::{Looked, Results};
pub use run::run;
