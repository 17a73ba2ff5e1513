//! How long a run can be trusted: twins that differ in the last bit of one amplitude.

use crate::numerics::statistics::Estimate;
use crate::params::HorizonParams;
use serde::{Deserialize, Serialize};

/// The measured horizon. Means over the twins, with standard error and a normal interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Horizon {
    /// What was run.
    pub parameters: HorizonParams,
    /// One for each pair of twins.
    pub twins: Vec<Twins>,
    /// Time of the first impact whose gap differs.
    pub order: Option<Estimate>,
    /// Number of impacts before it.
    pub order_impacts: Option<Estimate>,
    /// Time of the first impact whose time differs by more than 1e−9.
    pub time: Option<Estimate>,
    /// Growth rate λ of the time differences, e-folds per unit of time.
    pub growth: Option<Estimate>,
    /// Time in which differences grow tenfold, ln 10 / λ.
    pub tenfold: Option<Estimate>,
}

/// One pair of twins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Twins {
    /// Time of the first impact whose gap differs, if there was one.
    pub order: Option<f64>,
    /// Impacts before it.
    pub order_impacts: Option<u64>,
    /// Time of the first impact whose time differs by more than 1e−9.
    pub time: Option<f64>,
    /// Growth rate λ of this pair.
    pub growth: Option<f64>,
}
