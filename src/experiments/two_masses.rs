//! Two masses (the remark of Sec. 2): under a low enough force they never hit.
//!
//! For a start from rest every gap keeps R1 + R2 < d, and so stays open for ever, as long as the
//! amplitudes are below a bound in closed form. A chain with fixed directions of the forcing and
//! growing amplitude must therefore have its first impact at that bound or above, and come close
//! to it when given time, because ω and Ω are incommensurable.

use crate::numerics::statistics::Estimate;
use crate::params::TwoMassesParams;
use serde::{Deserialize, Serialize};

/// The smallest forces that lead to an impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoMasses {
    /// What was run.
    pub parameters: TwoMassesParams,
    /// The force amplitude √(α² + β²) of each mass below which no direction of the forcing lets
    /// the two masses hit each other, in closed form.
    pub safe_force: f64,
    /// The smallest force amplitude with an impact of the two masses within each time, under the
    /// worst directions.
    pub worst: Vec<WithinTime>,
    /// Over random directions: smallest amplitude with an impact divided by the bound of that
    /// direction, for each time.
    pub excess: Vec<ExcessWithinTime>,
    /// Impacts seen below the bound, over all directions and times: must be 0.
    pub violations: u64,
}

/// Smallest force amplitude with an impact within a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WithinTime {
    /// The time.
    pub time: f64,
    /// The force amplitude.
    pub force: f64,
}

/// Simulated threshold over its bound, over random directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExcessWithinTime {
    /// The time.
    pub time: f64,
    /// Median of threshold / bound, with its bootstrap interval.
    pub median: Estimate,
    /// Smallest ratio.
    pub least: f64,
    /// Largest ratio.
    pub greatest: f64,
}
