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
pub use literate::table::{Keys, Table};
pub use literate::value::origin;
pub use serde::{Deserialize, Serialize};

/// Columns of a table, empty where it has none of this name.
pub trait Columns {
    fn points(&self, keys: Keys<'_>, x: &str, y: &str) -> Vec<(f64, f64)>;
    fn estimates(&self, keys: Keys<'_>, x: &str, y: &str) -> Vec<(f64, Estimate)>;
    fn values(&self, column: &str) -> Vec<f64>;
}

impl Columns for Table {
    fn points(&self, keys: Keys<'_>, x: &str, y: &str) -> Vec<(f64, f64)> {
        self.curve(keys, x, y).unwrap_or_default()
    }

    fn estimates(&self, keys: Keys<'_>, x: &str, y: &str) -> Vec<(f64, Estimate)> {
        self.series(keys, x, y).unwrap_or_default()
    }

    fn values(&self, column: &str) -> Vec<f64> {
        self.distinct(column).unwrap_or_default()
    }
}

/// Unit of σ and of forces.
pub const SIGMA: &str = "d omega^2";
/// Unit of times.
pub const TIME: &str = "1/omega";
