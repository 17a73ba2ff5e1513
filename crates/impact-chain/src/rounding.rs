//! How far rounding can move an impact: a measured bound.
//!
//! Take the doubles of a scenario as exact, and let gap Δ of two neighbours close next, at t + s, falling with speed
//! v = −Δ'(t + s). Then the engine's waiting time is off by at most |δs| ≤ C ε S/v, with C = [`TIME`], ε = 2⁻⁵² and
//! S = d + Q₁ + Q₂, where Q₁ and Q₂ are the free and the forced amplitudes of *both* neighbours, summed. Amplitudes that two
//! neighbours share vanish from the gap, but their roundings do not: each forced amplitude is divided by ω² − Ω²
//! separately. Impacts that nearly graze are excepted: there no double can decide whether the gap closes.
//!
//! Scenarios whose C ε S exceeds [`MOST`] of d are refused: near resonance S is the amplitude over |ω² − Ω²|, however slowly the
//! motion grows.

use super::simulation::response;
use super::{Initial, Scenario};

/// The largest E = C ε S that a scenario may have, as a part of d.
pub const MOST: f64 = 1e-6;

/// `trace` reports E where it is a larger part of d than this.
pub const REPORTED: f64 = 1e-9;

/// C of the waiting time: eighteen times the largest that was measured, 3.7 in 560 000 impacts of random chains biased
/// to extreme cases, against a simulator of 106 bits (`tests/physics/certified.rs`).
pub const TIME: f64 = 66.3;

/// E = C ε S at the start, with a bound of S over all gaps: rounding may change the width of a gap by E, and the time of
/// an impact at closing speed v by E/v.
pub fn width(scenario: &Scenario) -> f64 {
    let length = |[a, b]: [f64; 2]| (a * a + b * b).sqrt();
    let w = scenario.natural_frequency;
    let of = |j: usize| {
        let (mut sum, mut rest) = (0.0, [0.0; 2]);
        for (big_w, amplitudes) in scenario.components() {
            let [c, s] = response(w, big_w, amplitudes[j]);
            sum += length([c, s]);
            rest = [rest[0] - c, rest[1] - big_w / w * s];
        }
        sum + length(match &scenario.initial {
            Initial::Rest => rest,
            Initial::Free(parts) => parts[j],
        })
    };
    let largest = (0..scenario.forcing.len()).map(of).fold(0.0, f64::max);
    TIME * f64::EPSILON * (scenario.spacing + 2.0 * largest)
}
