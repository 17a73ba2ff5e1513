//! Computes the probabilities that a gap, or some gap, of a chain from rest closes by itself.
//!
//! A gap that closes by itself, before any impact beside it, is a seed; impacts nucleate there.
//!
//! # One gap
//! A chain from rest has free parts that cancel the forced positions and velocities at t = 0. With
//! the differences δα = ρ cos θ, δβ = ρ sin θ of the amplitudes on both sides of a gap, its
//! width is
//!
//! Δ(t) = d − ρ E(t) · (cos θ, sin θ), E(t) = (cos ωt − cos Ωt, (Ω/ω) sin ωt − sin Ωt)/(ω² − Ω²),
//!
//! the same plane curve E for every gap of every chain. The gap closes by T where ρ M_T(θ) ≥ d,
//! with M_T(θ) the largest value of E · (cos θ, sin θ) on [0, T]: how far the convex hull of
//! the curve reaches in that direction. The differences are normal, so ρ is Rayleigh distributed,
//! θ uniform, and for a gap between two masses
//!
//! p_T = (1/2π) ∮ exp(−(d/(2σ M_T(θ)))²) dθ.
//!
//! At a wall only one of the amplitudes differs from zero: σ/√2 stands for σ. For
//! incommensurable frequencies M_T rises to M(θ) = (1 + √(cos²θ + (Ω/ω)² sin²θ))/|ω²
//! − Ω²|, and p_T to p_rest. A gap closes late only if it closes barely: the phases that it
//! needs form an ellipse of size √ε, for ρ M = d + ε, which a straight line of length T in the
//! torus of phases misses for ε of order T^{−2} only.
//!
//! # Two adjacent gaps
//! Adjacent gaps share a mass, and with it the force on that mass: both amplitude differences
//! contain it with opposite signs, so their covariance is −σ². In polar coordinates for the radii
//! of the two, r_1 = s cos φ and r_2 = s sin φ, the integral over s is elementary, and three angles
//! are left. Where tan φ < m_2/m_1, m_i = d/M(θ_i), the second radius decides whether both close,
//! and with t = tan φ
//!
//! P = ⟨ ∫_0^{m_2/m_1} (2 t D/Q²)(1 + h) e^{−h} dt ⟩ over θ_1 and θ_2, and the same with 1 and 2
//! exchanged, Q = v_2 + v_1 t² + 2σ² t cos(θ_1 − θ_2), D = v_1 v_2 − σ⁴, h = m_2² Q/(2 D t²),
//!
//! v_1 and v_2 being the variances of the differences. The exponential is the only function needed.
//!
//! # At least one gap of a chain
//! The gaps are 1-dependent: gaps that share no mass are independent, adjacent gaps are not, and
//! those that close by themselves come in clumps. A clump begins at a gap that closes when the gap
//! to its left does not. There is a gap that closes if and only if there is a clump, and beginnings
//! of clumps are nearly independent: if their mean number is λ, there is no clump with a
//! probability near e^{−λ}.
//!
//! Dependence only makes chains without such a gap more frequent: in unlimited time a gap stays
//! open in a set of forces that is convex and symmetric about zero, so that by the Gaussian
//! correlation inequality (Royen 2014) independent gaps give an upper bound.

use impact_chain::{Boundary, Chain};
use impact_numerics::quadrature::GaussLegendre;
use impact_numerics::roots::crossing;
use std::f64::consts::TAU;

/// M_T(θ) at equally spaced angles θ from 0, in units of length per unit of amplitude of the force.
#[derive(Clone, Debug, PartialEq)]
pub struct Reach {
    pub radii: Vec<f64>,
}

/// Angles that are enough for one gap.
pub const ANGLES: usize = 256;

/// Angles of the rule for two adjacent gaps, whose cost grows as their square.
pub const PAIR_ANGLES: usize = 64;

/// Steps of the search for maxima in a unit of ωt.
const STEPS: usize = 8;

/// The curve E at a time, and its derivative.
struct CurvePoint {
    value: [f64; 2],
    slope: [f64; 2],
}

fn curve(chain: &Chain, time: f64) -> CurvePoint {
    let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
    let scale = 1.0 / (omega * omega - big_omega * big_omega);
    let (sin, cos) = pxfm::f_sincos(omega * time);
    let (forced_sin, forced_cos) = pxfm::f_sincos(big_omega * time);
    let value = [cos - forced_cos, big_omega / omega * sin - forced_sin];
    let slope = [big_omega * forced_sin - omega * sin, big_omega * (cos - forced_cos)];
    CurvePoint { value: value.map(|x| scale * x), slope: slope.map(|x| scale * x) }
}

fn dot([x, y]: [f64; 2], [cos, sin]: [f64; 2]) -> f64 {
    x * cos + y * sin
}

impl Reach {
    /// Computes the reach up to each of `times`, which must rise and are rounded down to eighths of
    /// 1/ω. Maxima are exact to rounding, except two of them less than an eighth apart.
    pub fn within_times(chain: &Chain, times: &[f64], angles: usize) -> Vec<Reach> {
        let step = 1.0 / (STEPS as f64 * chain.natural_frequency);
        let directions: Vec<[f64; 2]> = directions(angles).collect();
        let mut radii = vec![0.0_f64; angles];
        let mut reaches = Vec::with_capacity(times.len());
        let (mut before, mut i) = (curve(chain, 0.0), 0_u64);
        for time in times {
            while (i + 1) as f64 * step <= *time {
                let (from, until) = (i as f64 * step, (i + 1) as f64 * step);
                let after = curve(chain, until);
                for (radius, direction) in radii.iter_mut().zip(&directions) {
                    let [rises, falls] =
                        [&before, &after].map(|point| dot(point.slope, *direction));
                    *radius = radius.max(dot(after.value, *direction));
                    // Between a rise and a fall the values stay below both tangents.
                    let upper_bound = dot(before.value, *direction) + rises * step;
                    if rises > 0.0 && falls < 0.0 && upper_bound > *radius {
                        let time = turning_time(chain, *direction, from, until);
                        *radius = radius.max(dot(curve(chain, time).value, *direction));
                    }
                }
                (before, i) = (after, i + 1);
            }
            reaches.push(Reach { radii: radii.clone() });
        }
        reaches
    }

    /// Computes the reach in unlimited time, for frequencies that have no common multiple.
    pub fn in_unlimited_time(chain: &Chain, angles: usize) -> Reach {
        let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
        let scale = 1.0 / (omega * omega - big_omega * big_omega).abs();
        let ratio = big_omega / omega;
        let radius =
            |[cos, sin]: [f64; 2]| scale * (1.0 + (cos * cos + ratio * ratio * sin * sin).sqrt());
        Reach { radii: directions(angles).map(radius).collect() }
    }

    /// Returns p of a gap with amplitude differences of this `variance`: 2σ², at a wall σ².
    pub fn probability(&self, spacing: f64, variance: f64) -> f64 {
        let beyond = |radius: &f64| {
            let least = spacing / radius;
            pxfm::f_exp(-0.5 * least * least / variance)
        };
        let chances = self.radii.iter().filter(|radius| **radius > 0.0).map(beyond);
        chances.fold(0.0, |sum, chance| sum + chance) / self.radii.len() as f64
    }
}

/// Lists |ω² − Ω²| (R₁ + R₂) of each gap between bodies that start at rest under these `forces`, R₁
/// and R₂ the amplitudes of its free and forced parts; the force of a wall is zero.
pub fn pulls(chain: &Chain, forces: &[[f64; 2]]) -> impl Iterator<Item = f64> {
    let ratio = chain.forcing_frequency / chain.natural_frequency;
    forces.windows(2).map(move |pair| {
        let [alpha, beta] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let turned = ratio * beta;
        (alpha * alpha + turned * turned).sqrt() + (alpha * alpha + beta * beta).sqrt()
    })
}

/// Returns |ω² − Ω²| d: a gap with at least so large a pull closes in unlimited time.
pub fn closing_pull(chain: &Chain) -> f64 {
    let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
    chain.spacing * (omega * omega - big_omega * big_omega).abs()
}

fn directions(angles: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..angles).map(move |i| {
        let (sin, cos) = pxfm::f_sincos(TAU * i as f64 / angles as f64);
        [cos, sin]
    })
}

/// Returns when the curve turns back in a direction, between a rise and a fall.
fn turning_time(chain: &Chain, direction: [f64; 2], mut from: f64, mut until: f64) -> f64 {
    // The slope is nearly straight: false position, and a bisection now and then moves both ends.
    let slope = |time: f64| dot(curve(chain, time).slope, direction);
    let (mut rises, mut falls) = (slope(from), slope(until));
    for round in 0..24 {
        let share = if round % 3 == 2 { 0.5 } else { rises / (rises - falls) };
        let time = from + share * (until - from);
        let rate = slope(time);
        if rate.abs() <= 1e-9 || time <= from || time >= until {
            return time;
        }
        if rate > 0.0 { (from, rises) = (time, rate) } else { (until, falls) = (time, rate) }
    }
    0.5 * (from + until)
}

/// Nodes of the rule in t, for each of the two cases of which gap decides.
const POINTS: usize = 20;

/// Returns the probability that two adjacent gaps of variances v_1, v_2 both close by themselves.
fn pair_probability(reach: &Reach, spacing: f64, sigma: f64, [v_1, v_2]: [f64; 2]) -> f64 {
    let rule = GaussLegendre::new(POINTS);
    let shared = sigma * sigma;
    let determinant = v_1 * v_2 - shared * shared;
    let step = (reach.radii.len() / PAIR_ANGLES).max(1);
    let radii: Vec<f64> = reach.radii.iter().copied().step_by(step).collect();
    let angles = radii.len();
    let cosines: Vec<f64> = directions(angles).map(|[cos, _]| cos).collect();
    // The part where the gap of the least radius `m` and the variance `v` decides.
    let decided_by = |(m, v): (f64, f64), (other_m, other_v): (f64, f64), twice_shared: f64| {
        rule.integrate(0.0, m / other_m, |t| {
            let q = v + t * (twice_shared + other_v * t);
            let half = 0.5 * m * m * q / (determinant * t * t);
            t / (q * q) * (1.0 + half) * pxfm::f_exp(-half)
        })
    };
    let mut sum = 0.0;
    for (i, first) in radii.iter().enumerate() {
        // With equal variances the order of the angles does not matter.
        let others = if v_1 == v_2 { i + 1 } else { angles };
        for (j, second) in radii[..others].iter().enumerate() {
            if *first <= 0.0 || *second <= 0.0 {
                continue;
            }
            let (one, two) = ((spacing / first, v_1), (spacing / second, v_2));
            let twice_shared = 2.0 * shared * cosines[(angles + i - j) % angles];
            let both = decided_by(two, one, twice_shared) + decided_by(one, two, twice_shared);
            sum += if v_1 == v_2 && j < i { 2.0 * both } else { both };
        }
    }
    2.0 * determinant * sum / (angles * angles) as f64
}

/// The probabilities that single gaps and adjacent ones of a chain from rest close by themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
pub struct Chances {
    /// A gap between masses.
    pub p: f64,
    /// A gap at a wall.
    pub wall: f64,
    /// Both of two adjacent gaps between masses.
    pub pair: f64,
    /// Both a gap at a wall and the adjacent one.
    pub wall_pair: f64,
}

impl Chances {
    /// Computes the chances within a reach, for forces of standard deviation `sigma`.
    pub fn new(chain: &Chain, reach: &Reach, sigma: f64) -> Chances {
        let (mass, wall) = (2.0 * sigma * sigma, sigma * sigma);
        let d = chain.spacing;
        Chances {
            p: reach.probability(d, mass),
            wall: reach.probability(d, wall),
            pair: pair_probability(reach, d, sigma, [mass, mass]),
            wall_pair: pair_probability(reach, d, sigma, [wall, mass]),
        }
    }

    /// Returns 1 − e^{−λ}: that at least one gap of `masses` ≥ 1 masses closes by itself. The only
    /// two gaps of a chain are mirror images, of which in unlimited time both close or none.
    pub fn at_least_one(&self, masses: usize, boundary: Boundary) -> f64 {
        let walls = boundary == Boundary::Walls;
        if boundary.gaps(masses) == 2 {
            return if walls { self.wall } else { self.p };
        }
        let mut clumps = 0.0;
        for gap in 0..boundary.gaps(masses) {
            // The chance that a clump begins at this gap.
            clumps += match gap {
                0 if walls => self.wall,
                1 if walls => self.p - self.wall_pair,
                last if walls && last == masses => self.wall - self.wall_pair,
                _ => self.p - self.pair,
            };
        }
        -pxfm::f_expm1(-clumps)
    }
}

/// Returns the σ at which half of such chains have a gap that closes by itself, to about 1e-6.
pub fn sigma_at_which_half_close(chain: &Chain, reach: &Reach) -> f64 {
    let chances = |sigma: f64| Chances::new(chain, reach, sigma);
    let share = |sigma: f64| chances(sigma).at_least_one(chain.masses, chain.boundary);
    let logarithms = [0.02, 2.0].map(|times: f64| pxfm::f_log(times * chain.spacing));
    pxfm::f_exp(crossing(logarithms, 1e-6, |log_sigma| share(pxfm::f_exp(log_sigma)) - 0.5))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact_probability::ImpactProbability;
    use impact_chain::{NormalPairs, Seed};

    /// With ω = 1, Ω = 3 the curve is −½ sin² t (cos t, sin t).
    #[test]
    fn the_reach_of_a_closed_curve() {
        let chain = Chain { forcing_frequency: 3.0, ..Chain::default() };
        let [early, late] = &Reach::within_times(&chain, &[2.0, 5.0], 4)[..] else { panic!() };
        let most = 1.0 / 27.0_f64.sqrt();
        for (reach, exact) in [(early, [0.0, 0.0, most, 0.5]), (late, [most, 0.5, most, 0.5])] {
            let off = |i: usize| (reach.radii[i] - exact[i]).abs();
            assert!((0..4).all(|i| off(i) < 1e-12 || exact[i] == 0.0), "{reach:?}");
        }
    }

    #[test]
    fn no_sample_of_the_curve_lies_beyond_its_reach() {
        let chain = Chain::default();
        let times = [5.0, 40.0, 300.0];
        let reaches = Reach::within_times(&chain, &times, 90);
        let ever = Reach::in_unlimited_time(&chain, 90);
        let samples: Vec<_> =
            (0..=300_000).map(|i| curve(&chain, f64::from(i) * 1e-3).value).collect();
        for (time, reach) in times.iter().zip(&reaches) {
            for (angle, direction) in directions(90).enumerate() {
                let sampled = samples[..=(time * 1e3) as usize].iter();
                let sampled = sampled.map(|point| dot(*point, direction)).fold(0.0, f64::max);
                let radius = reach.radii[angle];
                // Samples 10⁻³ apart miss at most |E″| 10⁻⁶/8.
                assert!((0.0..1e-6).contains(&(radius - sampled + 1e-12)), "{time} {angle}");
                assert!(radius <= ever.radii[angle] + 1e-12);
            }
        }
    }

    /// Probabilities of disjoint beginnings of clumps add up, with both walls and without.
    #[test]
    fn clumps_begin_at_every_gap() {
        let chances = Chances { p: 0.1, wall: 0.02, pair: 0.03, wall_pair: 0.005 };
        for (masses, boundary, clumps) in [
            (4, Boundary::Walls, 0.02_f64 + 0.095 + 0.07 + 0.07 + 0.015),
            (2, Boundary::Walls, 0.02 + 0.095 + 0.015),
            (4, Boundary::Ring, 4.0 * 0.07),
            (1, Boundary::Walls, -0.98_f64.ln()),
            (2, Boundary::Ring, -0.9_f64.ln()),
        ] {
            let share = chances.at_least_one(masses, boundary);
            assert!((share - (1.0 - (-clumps).exp())).abs() < 1e-15, "{masses}: {share}");
        }
    }

    #[test]
    fn reach_and_pull_by_hand() {
        // e^−1/4, no reach, and e^−1.
        let reach = Reach { radii: vec![2.0, 0.0, 1.0] };
        let p = ((-0.25_f64).exp() + (-1.0_f64).exp()) / 3.0;
        assert!((reach.probability(1.0, 0.5) - p).abs() < 1e-15);
        let chain = Chain { forcing_frequency: 2.0, spacing: 1.5, ..Chain::default() };
        let pulls: Vec<f64> = pulls(&chain, &[[0.0; 2], [3.0, 4.0], [2.0, 4.0]]).collect();
        assert_eq!((pulls, closing_pull(&chain)), (vec![73.0_f64.sqrt() + 5.0, 2.0], 4.5));
        let reach = Reach::in_unlimited_time(&chain, PAIR_ANGLES);
        let share = Chances::new(&chain, &reach, sigma_at_which_half_close(&chain, &reach))
            .at_least_one(chain.masses, chain.boundary);
        assert!((share - 0.5).abs() < 1e-4, "{share}");
    }

    /// Adjacent gaps that both close, in 200 000 draws of forces, within four deviations; the
    /// reach differs between opposite angles, so that the sign of what the two share counts.
    #[test]
    fn adjacent_gaps_close_as_often_as_in_draws_of_their_forces() {
        let (chain, sigma, draws) = (Chain::default(), 0.6, 200_000);
        let radii = directions(ANGLES).map(|[cos, _]| 1.0 + 0.5 * cos).collect();
        let chances = Chances::new(&chain, &Reach { radii }, sigma);
        let mut normals = NormalPairs::new("neighbours", Seed(1), 0);
        let mut counts = [0_u32; 4];
        for _ in 0..draws {
            let [a, b, c] = [normals.pair(), normals.pair(), normals.pair()];
            let closes = |from: [f64; 2], to: [f64; 2]| {
                let [x, y] = [sigma * (to[0] - from[0]), sigma * (to[1] - from[1])];
                x.hypot(y) + 0.5 * x >= chain.spacing
            };
            let [wall, first, second] = [closes([0.0; 2], a), closes(a, b), closes(b, c)];
            let closed = [first, wall, first && second, wall && first];
            counts = std::array::from_fn(|i| counts[i] + u32::from(closed[i]));
        }
        let exact = [chances.p, chances.wall, chances.pair, chances.wall_pair];
        for (count, p) in counts.into_iter().zip(exact) {
            let (share, n) = (f64::from(count) / f64::from(draws), f64::from(draws));
            assert!((share - p).abs() < 4.0 * (p * (1.0 - p) / n).sqrt(), "{counts:?} {chances:?}");
        }
    }

    #[test]
    fn in_unlimited_time_it_is_the_integral_of_the_start_from_rest() {
        let chain = Chain::default();
        for sigma in [0.08, 0.12, 0.2] {
            let law = ImpactProbability::of_paper(sigma).unwrap();
            let p = Reach::in_unlimited_time(&chain, 256).probability(1.0, 2.0 * sigma * sigma);
            assert!((p / law.p_from_rest().unwrap() - 1.0).abs() < 1e-13, "{sigma}: {p}");
        }
    }
}
