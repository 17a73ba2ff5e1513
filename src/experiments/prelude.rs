//! Gathers what most experiments use.

pub use crate::experiments::ensembles::{each, named};
pub use crate::params::Chain;
pub use impact_chain::State;
pub use impact_chain::rise::{Counted, Curve};
pub use impact_chain::{Engine, Impact, Scenario};
pub use impact_numerics::estimates::{average, difference, share, with_error};
pub use impact_numerics::random::NormalPairs;
pub use impact_numerics::statistics::Estimate;
pub use literate::experiments::{Error, Progress, Results, Session};
pub use literate::table::Table;
pub use literate::value::origin;
pub use serde::{Deserialize, Serialize};

/// Unit of σ and of forces.
pub const SIGMA: &str = "d omega^2";
/// Unit of times.
pub const TIME: &str = "1/omega";
