//! Experiments: parameters, units of work, runs, tables; results that save and reload exactly, and are used again
//! as long as what they are made of is the same.

pub mod command;
pub mod cutting;
mod error;
pub mod experiment;
pub mod identity;
mod profile;
pub mod progress;
mod results;
mod session;
pub mod shards;
pub mod store;

pub use command::Command;
pub use error::Error;
pub use experiment::{Entry, Experiment, Found};
pub use profile::Profile;
pub use progress::{Progress, alive, be_quiet, say};
pub use results::{Results, Together};
pub use session::Session;
pub use store::Store;

/// An experiment of any parameters and result.
pub type Need = &'static dyn Entry;
