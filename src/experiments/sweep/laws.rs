//! How rare three-way impacts and sticking are (the remark of Sec. 2): power laws over decades.

use crate::params::{NEAR_SIMULTANEOUS, SLOW};
use impact_chain::counts::{NEAR_DECADES, SLOW_DECADES};
use impact_chain::rise::Runs;
use serde::{Deserialize, Serialize};

/// First decade of the law of neighbouring impacts that is fitted, δ = 1e−2: at 1e−1 two impacts
/// are no longer close against the time between impacts.
const NEAR_FROM: usize = 1;

/// First decade of the law of slow impacts that is fitted, v = 1e−1.
const SLOW_FROM: usize = 0;

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
    /// Share of impacts with a closing speed below v: about c v². None where contact phases
    /// began: before a pair sticks it chatters, and its last bounces are slow by another law, a
    /// fixed number of them in each decade.
    pub slow: Option<PowerLaw>,
    /// Contact phases.
    pub contact_phases: u64,
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
}

/// Sums over all σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LawsTotals {
    /// Impacts.
    pub impacts: u64,
    /// Impacts that follow one of an adjacent gap within each δ of
    /// [`impact_chain::counts::NEAR_DECADES`].
    pub near_decades: Vec<u64>,
    /// Impacts slower than each v of [`impact_chain::counts::SLOW_DECADES`].
    pub slow_decades: Vec<u64>,
    /// Contact phases.
    pub contact_phases: u64,
    /// Near-simultaneous impacts (within 1e−9) that the laws let expect in the whole sweep.
    pub expected_near_simultaneous: f64,
    /// Slow impacts (below 1e−8) that the laws let expect in the whole sweep.
    pub expected_slow: f64,
}

/// Fits the laws to the rows of a sweep.
pub fn run(rows: &[Runs]) -> Laws {
    let fitted: Vec<LawsRow> = rows
        .iter()
        .filter(|row| row.total.impacts > 0)
        .map(|row| LawsRow {
            sigma: row.sigma,
            impacts: row.total.impacts,
            near: fit(&row.total.near[NEAR_FROM..], NEAR_DECADES[NEAR_FROM], 1, row.total.impacts),
            slow: (row.total.contact_phases == 0)
                .then(|| {
                    let nested = &row.total.slow[SLOW_FROM..];
                    fit(nested, SLOW_DECADES[SLOW_FROM], 2, row.total.impacts)
                })
                .flatten(),
            contact_phases: row.total.contact_phases,
        })
        .collect();
    // With the exponent fixed, the counts at the first decade scale down to the limit.
    let near_decades = sums(rows, NEAR_DECADES.len(), |row| &row.total.near);
    let slow_decades = sums(rows, SLOW_DECADES.len(), |row| &row.total.slow);
    let slow_ratio = SLOW / SLOW_DECADES[SLOW_FROM];
    let first = |counts: &[u64], from: usize| counts[from] as f64;
    let totals = LawsTotals {
        impacts: rows.iter().map(|row| row.total.impacts).sum(),
        contact_phases: rows.iter().map(|row| row.total.contact_phases).sum(),
        expected_near_simultaneous: first(&near_decades, NEAR_FROM)
            * (NEAR_SIMULTANEOUS / NEAR_DECADES[NEAR_FROM]),
        expected_slow: first(&slow_decades, SLOW_FROM) * slow_ratio * slow_ratio,
        near_decades,
        slow_decades,
    };
    Laws { rows: fitted, totals }
}

fn sums(rows: &[Runs], decades: usize, pick: fn(&Runs) -> &[u64]) -> Vec<u64> {
    (0..decades).map(|i| rows.iter().map(|row| pick(row)[i]).sum()).collect()
}

/// Fits a power law to the nested counts below `first`, `first`/10, … among `impacts`.
///
/// Under P(x) = c x^a an event below 10^−i lies below 10^−(i+1) with probability q = 10^−a,
/// whatever i: each event at each decade is one trial. So the likelihood gives q as successes
/// over trials, without logarithms of small counts, and its binomial error.
fn fit(nested: &[u64], first: f64, expected: i32, impacts: u64) -> Option<PowerLaw> {
    let events = *nested.first()?;
    let trials: u64 = nested[..nested.len() - 1].iter().sum();
    let successes: u64 = nested[1..].iter().sum();
    if successes == 0 || successes == trials {
        return None;
    }
    let q = successes as f64 / trials as f64;
    let q_error = (q * (1.0 - q) / trials as f64).sqrt();
    let scale = (0..expected).fold(impacts as f64, |product, _| product * first);
    Some(PowerLaw {
        exponent: -pxfm::f_log10(q),
        exponent_error: q_error / (q * std::f64::consts::LN_10),
        coefficient: events as f64 / scale,
        coefficient_error: (events as f64).sqrt() / scale,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_decades_give_the_exact_law() {
        // 40 000, 400, 4 below 0.1, 0.01, 0.001 of 10^6 impacts: 4 v².
        let law = fit(&[40_000, 400, 4], 0.1, 2, 1_000_000).unwrap();
        assert!((law.exponent - 2.0).abs() < 1e-12, "{law:?}");
        assert!((law.coefficient - 4.0).abs() < 1e-12);
        assert!((law.coefficient_error - 4.0 / 200.0).abs() < 1e-12);
    }

    #[test]
    fn too_few_events_make_no_law() {
        assert_eq!(fit(&[5, 0, 0], 0.1, 2, 100), None);
        assert_eq!(fit(&[0, 0, 0], 0.1, 2, 100), None);
    }
}
