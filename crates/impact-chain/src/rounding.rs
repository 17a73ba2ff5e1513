//! How far rounding can move an impact: a measured bound.
//!
//! Take the doubles of a scenario as exact, and let gap Δ of two neighbours close next, at t + s, falling with speed
//! v = −Δ'(t + s). Then the engine's waiting time is off by at most |δs| ≤ C ε S/v, with C = [`TIME`], ε = 2⁻⁵² and
//! S = d + Q₁ + Q₂, where Q₁ and Q₂ are the free and the forced amplitudes of *both* neighbours, summed. Amplitudes that two
//! neighbours share vanish from the gap, and yet their roundings stay: each forced amplitude is divided by ω² − Ω² on its
//! own, so near resonance the lengths of their differences would be no unit. An impact that all but grazes is excepted: there no
//! double can tell whether the gap closes.
//!
//! Scenarios whose C ε S exceeds [`MOST`] of d are refused: near resonance S is the amplitude over |ω² − Ω²|, however slowly the
//! motion grows.

use super::simulation::response;
use super::{Initial, Scenario};

/// The largest E = C ε S that a scenario may have, as a part of d.
pub const MOST: f64 = 1e-6;

/// `trace` says so where E is a larger part of d than this.
pub const TOLD: f64 = 1e-9;

/// C of the waiting time: eighteen times the worst that was measured. Of 560 000 impacts of random chains with a taste for
/// corners, held against a simulator of 106 bits (`tests/physics/certified.rs`), the worst had 3.7.
pub const TIME: f64 = 66.3;

/// E = C ε S at the start, S taken from above for all gaps at once: the width of a gap that rounding
/// may add or take. An impact that closes at speed v is off by at most E/v in time.
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
