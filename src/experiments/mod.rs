//! What is run: one experiment a file, results that save and reload exactly.

pub mod accuracy;
pub mod catalogue;
pub mod chains;
pub mod cutting;
pub mod deep;
pub mod error;
pub mod estimates;
pub mod experiment;
pub mod heat;
pub mod history;
pub mod horizon;
pub mod identities;
pub mod identity;
pub mod independence;
pub mod long;
pub mod measured;
pub mod nucleation;
pub mod observe;
pub mod orbits;
pub mod progress;
pub mod protocol;
pub mod protocols;
pub mod restitution;
pub mod rise;
pub mod run;
pub mod seeds;
pub mod segments;
pub mod shards;
pub mod spacetime;
pub mod starts;
pub mod store;
pub mod survival;
pub mod sweep;
pub mod tally;
pub mod theory;
pub mod two_masses;
pub mod weights;

mod results;

pub use catalogue::Need;
pub use error::Error;
pub use measured::Measured;
pub use progress::{Progress, say};
pub use results::{Looked, Results};
pub use run::run;
pub use store::Store;
