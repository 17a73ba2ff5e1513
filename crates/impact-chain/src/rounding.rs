//! Bounds how far rounding can move an impact.
//!
//! Take the doubles of a scenario as exact, and let gap Δ of two neighbours close next, at t + s,
//! falling with speed v = −Δ'(t + s). Then the engine's waiting time is off by at most
//! |δs| ≤ C ε S/v, with C = [`TIME`], ε = 2⁻⁵² and S = d + Q₁ + Q₂, where Q₁ and Q₂ are the free
//! and the forced amplitudes of *both* neighbours, summed: shared amplitudes vanish from the gap,
//! but their roundings do not. Impacts that nearly graze are excepted: no double can decide them.
//!
//! Scenarios whose C ε S exceeds [`LARGEST`] of d are refused: near resonance S is the amplitude
//! over |ω² − Ω²|, however slowly the motion grows.

use super::Scenario;
use super::flight::{length, response};

/// The largest E = C ε S that a scenario may have, as a part of d.
pub const LARGEST: f64 = 1e-6;

/// `trace` reports E where it is a larger part of d than this.
pub const REPORTED: f64 = 1e-9;

/// C of the waiting time: eighteen times the largest value, 3.7, measured in 560 000 impacts of
/// extreme random chains against a simulator of 106 bits (`tests/physics/certified.rs`).
pub const TIME: f64 = 66.3;

/// Returns E = C ε S at the start, with a bound of S over all gaps: rounding may change the width
/// of a gap by E, and the time of an impact at closing speed v by E/v.
///
/// # Panics
/// Panics if a list of the scenario is shorter than its number of masses asks for.
/// [`Scenario::validate`] refuses these.
#[must_use]
pub fn gap_error(scenario: &Scenario) -> f64 {
    let amplitudes = (0..scenario.forcing.len()).map(|j| amplitude(scenario, j));
    let largest = amplitudes.fold(0.0, f64::max);
    // A gap that is wider at rest than both amplitudes cannot close.
    let mut mean = scenario.spacing;
    if scenario.places.is_some() {
        for m in 1..scenario.forcing.len() + 2 {
            let at_rest = (scenario.place(m) - scenario.place(m - 1)).abs();
            mean = mean.max(at_rest.min(2.0 * largest));
        }
    }
    TIME * f64::EPSILON * (mean + 2.0 * largest)
}

/// Adds up the free and the forced amplitudes of mass j, counted from 0.
fn amplitude(scenario: &Scenario, j: usize) -> f64 {
    let w = scenario.natural_frequency;
    let mut sum = 0.0;
    for (big_w, amplitudes) in scenario.components() {
        sum += length(response(w, big_w, amplitudes[j]));
    }
    sum + length(scenario.free_part(j))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Chain, Initial};

    /// Ω² − ω² = 1: amplitudes of 5 forced and 0.5 free, twice at most, and the spacing.
    #[test]
    fn gap_error_by_hand() {
        let chain = Chain { masses: 1, ..Chain::default() };
        let forced = Scenario::given(&chain, vec![[3.0, 4.0]]).unwrap();
        let scenario = Scenario { initial: Initial::Free(vec![[0.3, 0.4]]), ..forced };
        let bound = |size: f64| 66.3 * f64::EPSILON * size;
        assert!((gap_error(&scenario) / bound(12.0) - 1.0).abs() < 1e-14);
        // A gap that is 8 wide at rest counts with that, one of 100 with both amplitudes.
        for (wide, mean) in [(8.0, 8.0), (100.0, 11.0)] {
            let placed = Scenario { places: Some(vec![0.0, 1.0, 1.0 + wide]), ..scenario.clone() };
            assert!((gap_error(&placed) / bound(mean + 11.0) - 1.0).abs() < 1e-14, "{wide}");
        }
    }
}
