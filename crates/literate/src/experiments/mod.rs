//! Defines experiments: parameters, units of work, runs, tables; results that save and reload
//! exactly, and are used again as long as what they are made of is the same.

mod command;
pub mod cutting;
mod error;
pub mod experiment;
mod printed;
mod process;
pub mod progress;
mod results;
mod session;
mod store;

pub use command::Command;
pub use error::Error;
pub(crate) use error::Fault;
pub use experiment::{AnyExperiment, AnyResult, Experiment};
pub(crate) use process::end_all;
pub use progress::{Progress, alive};
pub(crate) use progress::{be_quiet, say, stop};
pub use results::{DerivedTables, Results};
pub use session::Session;
pub use store::{Profile, Store};
