//! How rare three-way impacts and sticking are (the remark of Sec. 2): power laws over decades.

use serde::{Deserialize, Serialize};

/// The fitted laws, from the rows of the main sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Laws {
    /// One for each σ of the sweep that has impacts.
    pub rows: Vec<LawsRow>,
    /// Sums over all σ of the sweep.
    pub totals: LawsTotals,
}

/// The laws at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LawsRow {
    /// Standard deviation σ.
    pub sigma: f64,
    /// Impacts behind it.
    pub impacts: u64,
    /// Share of impacts that follow one of an adjacent gap within δ: about c δ.
    pub near: Option<PowerLaw>,
    /// Share of impacts with a closing speed below v: about c v².
    pub slow: Option<PowerLaw>,
    /// Contact phases per impact.
    pub contact_phases_per_impact: f64,
}

/// A share P(x) = coefficient · x^exponent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PowerLaw {
    /// Fitted exponent.
    pub exponent: f64,
    /// Its standard error.
    pub exponent_error: f64,
    /// Coefficient c with the exponent fixed at the expected whole number (1 or 2).
    pub coefficient: f64,
    /// Its standard error.
    pub coefficient_error: f64,
    /// Decades with at least one event in the fit.
    pub decades: usize,
    /// Events in the fit.
    pub events: u64,
}

/// Sums over all σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LawsTotals {
    /// Impacts.
    pub impacts: u64,
    /// Impacts that follow one of an adjacent gap within each δ of
    /// [`super::observe::NEAR_DECADES`].
    pub near_decades: Vec<u64>,
    /// Impacts slower than each v of [`super::observe::SLOW_DECADES`].
    pub slow_decades: Vec<u64>,
    /// Contact phases.
    pub contact_phases: u64,
    /// Near-simultaneous impacts (within 1e−9) that the laws let expect in the whole sweep.
    pub expected_near_simultaneous: f64,
    /// Slow impacts (below 1e−8) that the laws let expect in the whole sweep.
    pub expected_slow: f64,
}
