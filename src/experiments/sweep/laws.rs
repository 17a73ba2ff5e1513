//! How rare three-way impacts and sticking are (the remark of Sec. 2): power laws over decades.

use crate::experiments::prelude::*;
use crate::params::{NEAR_SIMULTANEOUS, SLOW};
use impact_chain::counts::{NEAR_DECADES, SLOW_DECADES, Total};
use impact_chain::rise::Runs;

/// First decade of the law of neighbouring impacts that is fitted, δ = 1e−2: at 1e−1 two impacts
/// are no longer close against the time between impacts.
const NEAR_FROM: usize = 1;

/// A share P(x) = coefficient · x^exponent; the coefficient is for the expected whole number as exponent (1 or 2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// Fitted exponent.
    pub exponent: Estimate,
    /// Coefficient c.
    pub coefficient: Estimate,
}

/// At one σ the share of impacts that follow one of an adjacent gap within δ, about c δ; and the share with a closing speed
/// below v, about c v². The latter is none where contact phases began: before a pair sticks it chatters, and its last
/// bounces are slow by another law, a fixed number of them in each decade.
pub fn run(row: &Runs) -> [Option<PowerLaw>; 2] {
    let own = &row.total;
    let slow = || fit(&own.slow, SLOW_DECADES[0], 2, own.impacts);
    [
        fit(&own.near[NEAR_FROM..], NEAR_DECADES[NEAR_FROM], 1, own.impacts),
        (own.contact_phases == 0).then(slow).flatten(),
    ]
}

/// Near-simultaneous impacts (within 1e−9) and slow ones (below 1e−8) that the laws let expect in a whole sweep: with the
/// exponent fixed, the counts at the first decade scale down to the limit.
pub fn expected(total: &Total) -> [f64; 2] {
    let slow = SLOW / SLOW_DECADES[0];
    [
        total.near[NEAR_FROM] as f64 * (NEAR_SIMULTANEOUS / NEAR_DECADES[NEAR_FROM]),
        total.slow[0] as f64 * slow * slow,
    ]
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
    let exponent_error = q_error / (q * std::f64::consts::LN_10);
    Some(PowerLaw {
        exponent: with_error(-pxfm::f_log10(q), exponent_error),
        coefficient: with_error(events as f64 / scale, (events as f64).sqrt() / scale),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_decades_give_the_exact_law() {
        // 40 000, 400, 4 below 0.1, 0.01, 0.001 of 10^6 impacts: 4 v².
        let law = fit(&[40_000, 400, 4], 0.1, 2, 1_000_000).unwrap();
        assert!((law.exponent.value - 2.0).abs() < 1e-12, "{law:?}");
        assert!((law.coefficient.value - 4.0).abs() < 1e-12);
        assert!((law.coefficient.error - 4.0 / 200.0).abs() < 1e-12);
    }
}
