//! How far the first motion of a gap reaches, and with it the probability that it closes by itself.
//!
//! A chain at rest has free parts that cancel the forced positions and velocities at t = 0. With the
//! differences δα = ρ cos θ, δβ = ρ sin θ of the amplitudes on both sides of a gap, its width is
//!
//! Δ(t) = d − ρ E(t) · (cos θ, sin θ),
//! E(t) = (cos ωt − cos Ωt, (Ω/ω) sin ωt − sin Ωt)/(ω² − Ω²),
//!
//! the same plane curve E for every gap of every chain. The gap closes by T where ρ M_T(θ) ≥ d, with
//! M_T(θ) the largest value of E · (cos θ, sin θ) on [0, T]: how far the convex hull of the curve
//! reaches in that direction. The differences are normal, so ρ is Rayleigh distributed, θ uniform,
//! and for a gap between two masses
//!
//! p_T = (1/2π) ∮ exp(−(d/(2σ M_T(θ)))²) dθ.
//!
//! At a wall only one of the amplitudes differs from zero: σ/√2 stands for σ. For incommensurable
//! frequencies M_T rises to M(θ) = (1 + √(cos²θ + (Ω/ω)² sin²θ))/|ω² − Ω²|, and p_T to p_rest. A gap
//! closes late only if it closes barely: the phases that it needs form an ellipse of size √ε, for ρ M = d + ε,
//! which a straight line of length T in the torus of phases misses for ε of order T^{−2} only.

use impact_chain::Chain;
use std::f64::consts::TAU;

/// M_T(θ) at equally spaced angles θ from 0, in units of length per unit of amplitude of the force.
#[derive(Clone, Debug, PartialEq)]
pub struct Reach {
    /// M_T at each angle.
    pub radii: Vec<f64>,
}

/// Steps of the search for maxima in a unit of ωt.
const STEPS: usize = 8;

/// The curve E and its first derivative at a time.
fn curve(chain: &Chain, time: f64) -> ([f64; 2], [f64; 2]) {
    let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
    let scale = 1.0 / (omega * omega - big_omega * big_omega);
    let (sin, cos) = pxfm::f_sincos(omega * time);
    let (forced_sin, forced_cos) = pxfm::f_sincos(big_omega * time);
    let at = [cos - forced_cos, big_omega / omega * sin - forced_sin];
    let slope = [big_omega * forced_sin - omega * sin, big_omega * (cos - forced_cos)];
    (at.map(|x| scale * x), slope.map(|x| scale * x))
}

fn along([x, y]: [f64; 2], [cos, sin]: [f64; 2]) -> f64 {
    x * cos + y * sin
}

impl Reach {
    /// The reach within each of some rising times, at `angles` angles. Times are rounded down to
    /// eighths of 1/ω; maxima are exact to rounding but for two of them less than an eighth apart.
    pub fn within(chain: &Chain, times: &[f64], angles: usize) -> Vec<Reach> {
        let step = 1.0 / (STEPS as f64 * chain.natural_frequency);
        let directions: Vec<[f64; 2]> = directions(angles).collect();
        let mut radii = vec![0.0_f64; angles];
        let mut reaches = Vec::with_capacity(times.len());
        let mut before = curve(chain, 0.0);
        let mut i: u64 = 0;
        for time in times {
            while (i + 1) as f64 * step <= *time {
                let (from, until) = (i as f64 * step, (i + 1) as f64 * step);
                let after = curve(chain, until);
                for (radius, direction) in radii.iter_mut().zip(&directions) {
                    let [rises, falls] = [before.1, after.1].map(|slope| along(slope, *direction));
                    *radius = radius.max(along(after.0, *direction));
                    // Between a rise and a fall the values stay below both tangents.
                    let most = along(before.0, *direction) + rises * step;
                    if rises > 0.0 && falls < 0.0 && most > *radius {
                        let top = top(chain, *direction, from, until);
                        *radius = radius.max(along(curve(chain, top).0, *direction));
                    }
                }
                (before, i) = (after, i + 1);
            }
            reaches.push(Reach { radii: radii.clone() });
        }
        reaches
    }

    /// The reach in unlimited time, for frequencies that have no common multiple.
    pub fn ever(chain: &Chain, angles: usize) -> Reach {
        let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
        let scale = 1.0 / (omega * omega - big_omega * big_omega).abs();
        let ratio = big_omega / omega;
        let radius =
            |[cos, sin]: [f64; 2]| scale * (1.0 + (cos * cos + ratio * ratio * sin * sin).sqrt());
        Reach { radii: directions(angles).map(radius).collect() }
    }

    /// The same at every `step`-th angle only.
    pub fn every(&self, step: usize) -> Reach {
        Reach { radii: self.radii.iter().copied().step_by(step.max(1)).collect() }
    }

    /// The probability that a gap closes by itself whose two amplitudes differ by normals with
    /// variance `variance` each: 2σ² between masses, σ² at a wall; d is the `spacing`.
    pub fn probability(&self, spacing: f64, variance: f64) -> f64 {
        let beyond = |radius: &f64| {
            let least = spacing / radius;
            pxfm::f_exp(-0.5 * least * least / variance)
        };
        self.radii.iter().filter(|radius| **radius > 0.0).map(beyond).fold(0.0, |sum, x| sum + x)
            / self.radii.len() as f64
    }
}

/// Whether a gap between amplitudes that differ by these of a chain at rest closes in unlimited
/// time.
pub fn closes_by_itself(chain: &Chain, [delta_alpha, delta_beta]: [f64; 2]) -> bool {
    let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
    let turned = big_omega / omega * delta_beta;
    let free = (delta_alpha * delta_alpha + turned * turned).sqrt();
    let forced = (delta_alpha * delta_alpha + delta_beta * delta_beta).sqrt();
    free + forced >= chain.spacing * (omega * omega - big_omega * big_omega).abs()
}

/// (cos θ, sin θ) at equally spaced angles.
fn directions(angles: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..angles).map(move |i| {
        let (sin, cos) = pxfm::f_sincos(TAU * i as f64 / angles as f64);
        [cos, sin]
    })
}

/// Where the curve turns back in a direction, between times of which the first still rises.
fn top(chain: &Chain, direction: [f64; 2], mut from: f64, mut until: f64) -> f64 {
    // The slope is nearly straight in an eighth: false position halves the number of bits left, and
    // bisection in turn keeps both ends moving.
    let slope = |time: f64| along(curve(chain, time).1, direction);
    let (mut rises, mut falls) = (slope(from), slope(until));
    for round in 0..24 {
        let share = if round % 3 == 2 { 0.5 } else { rises / (rises - falls) };
        let time = from + share * (until - from);
        let found = slope(time);
        if found.abs() <= 1e-9 || time <= from || time >= until {
            return time;
        }
        if found > 0.0 { (from, rises) = (time, found) } else { (until, falls) = (time, found) }
    }
    0.5 * (from + until)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact_probability::ImpactProbability;

    #[test]
    fn the_curve_is_the_motion_of_a_chain_at_rest() {
        // E solves E″ + ω² E = −(cos Ωt, sin Ωt), E(0) = E′(0) = 0; central differences.
        let chain = Chain { natural_frequency: 1.3, ..Chain::default() };
        let h = 1e-4;
        for time in [0.3, 2.0, 17.5] {
            let [left, here, right] = [time - h, time, time + h].map(|t| curve(&chain, t));
            let (sin, cos) = pxfm::f_sincos(chain.forcing_frequency * time);
            for (axis, force) in [cos, sin].into_iter().enumerate() {
                let second = (left.0[axis] - 2.0 * here.0[axis] + right.0[axis]) / (h * h);
                assert!((second + 1.69 * here.0[axis] + force).abs() < 1e-6);
                let first = (right.0[axis] - left.0[axis]) / (2.0 * h);
                assert!((first - here.1[axis]).abs() < 1e-7);
            }
        }
        assert_eq!(curve(&chain, 0.0), ([0.0; 2], [0.0; 2]));
    }

    #[test]
    fn no_sample_of_the_curve_lies_beyond_its_reach() {
        let chain = Chain::default();
        let times = [5.0, 40.0, 300.0];
        let reaches = Reach::within(&chain, &times, 90);
        let ever = Reach::ever(&chain, 90);
        let samples: Vec<_> = (0..=300_000).map(|i| curve(&chain, f64::from(i) * 1e-3).0).collect();
        for (time, reach) in times.iter().zip(&reaches) {
            for (angle, direction) in directions(90).enumerate() {
                let sampled = samples[..=(time * 1e3) as usize].iter();
                let sampled = sampled.map(|at| along(*at, direction)).fold(0.0, f64::max);
                let found = reach.radii[angle];
                // Samples 10⁻³ apart miss at most |E″| 10⁻⁶/8.
                assert!((0.0..1e-6).contains(&(found - sampled + 1e-12)), "{time} {angle}");
                assert!(found <= ever.radii[angle] + 1e-12);
            }
        }
    }

    #[test]
    fn in_unlimited_time_it_is_the_integral_of_the_start_from_rest() {
        let chain = Chain::default();
        for sigma in [0.08, 0.12, 0.2] {
            let law = ImpactProbability::of_paper(sigma).unwrap();
            let p = Reach::ever(&chain, 256).probability(1.0, 2.0 * sigma * sigma);
            assert!((p / law.p_from_rest().unwrap() - 1.0).abs() < 1e-13, "{sigma}: {p}");
        }
    }

    #[test]
    fn what_is_missing_falls_like_the_square_of_the_time() {
        let chain = Chain::default();
        let variance = 2.0 * 0.12 * 0.12;
        let ever = Reach::ever(&chain, 512).probability(1.0, variance);
        let missing: Vec<f64> = Reach::within(&chain, &[100.0, 400.0, 1600.0], 512)
            .iter()
            .map(|reach| 1.0 - reach.probability(1.0, variance) / ever)
            .collect();
        // A factor of 4 in T is one of 16, but for the arithmetic of √2.
        for pair in missing.windows(2) {
            assert!((6.0..40.0).contains(&(pair[0] / pair[1])), "{missing:?}");
        }
    }

    #[test]
    fn a_gap_that_closes_is_one_within_reach() {
        let chain = Chain::default();
        let ever = Reach::ever(&chain, 8);
        for (radius, [cos, sin]) in ever.radii.iter().zip(directions(8)) {
            for (rho, closes) in [(0.999 / radius, false), (1.001 / radius, true)] {
                assert_eq!(closes_by_itself(&chain, [rho * cos, rho * sin]), closes);
            }
        }
    }
}
