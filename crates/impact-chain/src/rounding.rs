//! How far rounding can move an impact: a bound counted operation by operation.
//!
//! # What is stated
//! Take the doubles of a scenario (free parts given, one component of the forcing; several are measured, not counted) as exact, and let gap Δ of two neighbours
//! close next, at t + s, falling with speed v = −Δ'(t + s). Then the engine's waiting time is off by at most
//!
//! |δs| ≤ C ε S/v, with C = [`TIME`] and S = d + Q₁ + Q₂,
//!
//! besides half a unit in the last place of t + s, which is lost in writing it down, and its closing speed by at most
//!
//! |δv| ≤ ε S (C′ max(ω, Ω) + C M₂/v), with C′ = [`SPEED`] and M₂ = ω² R₁ + Ω² R₂.
//!
//! Here ε = 2⁻⁵², and Q₁ and Q₂ are the free and the forced amplitudes of *both* neighbours, summed; R₁ and R₂ are those of
//! the gap, the lengths of the differences. Amplitudes that two neighbours share vanish from the gap, and yet their
//! roundings stay: each forced amplitude is divided by ω² − Ω² on its own, so near resonance d + R₁ + R₂ would be no unit.
//! M₂ bounds Δ'', and its term is what the error of the time does to the speed.
//!
//! The premise is that the impact is no graze: v² ≥ [`TRANSVERSAL`] M₂ C ε S. For it M₂ may be the smaller of ω² R₁ + Ω² R₂ and
//! ω² d + A, where A sums the amplitudes of both neighbours' forcing: by Eq. (2) Δ'' is no more near a root, and near resonance R₁ and R₂ say nothing.
//! Scenarios whose C ε S exceeds [`MOST`] of d are refused: near resonance S is the amplitude over |ω² − Ω²|, however slowly the motion grows. Below that Δ may reach but 25 C ε S below
//! zero, and at least of the shallowest dips no double can tell whether the gap closes.
//!
//! # Why
//! Let F be what the engine's computed Δ and the exact one differ by at one instant, |F| ≤ E. Between the exact root and the
//! computed one |Δ'| ≥ v − M₂ |δs|, so v |δs| − M₂ δs²/2 ≤ E, and with the premise |δs| ≤ (1 + 1/50) E/v. What
//! is left is to count E.
//!
//! To first order a rounding adds at most u = 2⁻⁵³ of what it rounds, times the derivative of the end by it. All that is
//! rounded is linear in d and the amplitudes, so the sum of the moduli, all signs being the worst, is at most a number times S:
//! the largest of the coefficients of d, Q₁ and Q₂. `tests/physics/roundings` goes this way on numbers that remember what
//! they were made of, takes the worst direction of each pair of amplitudes, phase, ratio Ω/ω and place of the root in
//! the reach, and holds the table against it. In units of u S for Δ, and of u S max(ω, Ω) for Δ':
//!
//! | stage | Δ | Δ' | what is rounded |
//! |---|---|---|---|
//! | amplitudes | 5 | 5 | ω − Ω, ω + Ω, their product (a difference of squares would cancel), the division, and the neighbours' difference |
//! | phases | 5 | 5 | sine and cosine of ωt and Ωt: fraction of a turn, 2π, their product, the polynomials; nothing at t = 0 |
//! | frame | 14 | 5 | rotation to the instant 1 + √2; f₀ 2; g₀ 2 (ω R₁ + Ω R₂), which grows with s for up to two reaches |
//! | advance | 40 | 33 | rotation by the reach: sine and cosine at 2.83, where the terms of their series are larger than they |
//! | evaluation | 51 | 40 | the Taylor coefficients about a node: sines and products of its table, the products and sums with the frame |
//! | root | 6 | 5 | the Taylor polynomial over 0.06/max(ω, Ω), and s itself: u s \|Δ'\| ≤ 2.83 u (R₁ + R₂) |
//! | convergence | 1 | 1 | the fourth-order step stops below 3.6e−6/max(ω, Ω) =: h and a share 1e−4 of its curvature, and leaves 5·10⁻¹² v h ≤ 0.2 u S |
//! | shut at the start | 8 | 0 | a gap within 4 ε of zero at t = 0 counts as shut, since the exact one may be |
//!
//! The coefficients of the sines count as exact, for their neighbours take up what they are rounded by (`numerics::trig`); what the series and the Taylor
//! polynomial leave out is below u/30 of S, and of a gap that steps found it is below the margin of `numerics::stepping`, and then put right.
//!
//! A gap that is nearly shut when it is framed anew keeps the error of its old frame, so after such a renewal the bound counts
//! twice. It takes a gap that stays below 1e−9 d from one search to the next.
//!
//! All these roundings never conspire: if they were independent, their sum would be about a tenth of C.

use super::simulation::response;
use super::{Initial, Scenario};

/// The largest E = C ε S that a scenario may have, as a part of d: a thousandth of what `certify` lets the
/// time of an impact differ by, at a closing speed of d ω. Every amplitude below it keeps the bound.
pub const MOST: f64 = 1e-6;

/// `trace` says so where E is a larger part of d than this.
pub const TOLD: f64 = 1e-9;

/// The stages of the table: what each adds to the error of Δ and of Δ'.
pub const STAGES: [(&str, [f64; 2]); 8] = [
    ("amplitudes", [5.0, 5.0]),
    ("phases", [5.0, 5.0]),
    ("frame", [14.0, 5.0]),
    ("advance", [40.0, 33.0]),
    ("evaluation", [51.0, 40.0]),
    ("root", [6.0, 5.0]),
    ("convergence", [1.0, 1.0]),
    ("shut at the start", [8.0, 0.0]),
];

/// An impact is no graze if v² is at least this many M₂ C ε S.
pub const TRANSVERSAL: f64 = 50.0;

/// C of the waiting time: two units 2⁻⁵³ are one ε.
pub const TIME: f64 = 0.5 * total(0) * (1.0 + 1.0 / TRANSVERSAL);

/// C′ of the closing speed.
pub const SPEED: f64 = 0.5 * total(1);

const fn total(of: usize) -> f64 {
    let mut sum = 0.0;
    let mut i = 0;
    while i < STAGES.len() {
        sum += STAGES[i].1[of];
        i += 1;
    }
    sum
}

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
            Initial::Zero => [0.0; 2],
            Initial::Free(parts) => parts[j],
        })
    };
    let largest = (0..scenario.forcing.len()).map(of).fold(0.0, f64::max);
    TIME * f64::EPSILON * (scenario.spacing + 2.0 * largest)
}
