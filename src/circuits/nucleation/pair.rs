//! Two neighbouring gaps that both close by themselves.
//!
//! Neighbours share a mass, and with it the force on that mass: both amplitude differences contain it
//! with opposite signs, so their covariance is −σ². In polar coordinates for the radii of the two,
//! r_1 = s cos φ and r_2 = s sin φ, the integral over s is elementary, and three angles are left:
//!
//! P = ⟨ (1/D) ∫_0^{π/2} cos φ sin φ (2/Q²)(1 + Q m²/2) e^{−Q m²/2} dφ ⟩ over θ_1 and θ_2,
//! Q = (v_2 cos²φ + v_1 sin²φ + 2σ² cos φ sin φ cos(θ_1 − θ_2))/D,  D = v_1 v_2 − σ⁴,
//! m = max(d/(M(θ_1) cos φ), d/(M(θ_2) sin φ)),
//!
//! v_1 and v_2 being the variances of the differences.

use super::reach::Reach;
use crate::numerics::quadrature::GaussLegendre;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Points of the rule on each side of the corner of m, where it has a kink.
const POINTS: usize = 20;

/// The probability that two neighbouring gaps both close by themselves, of variances v_1 and v_2
/// (2σ² between masses, σ² at a wall). The rule over the angles has the points of the reach.
pub fn both(reach: &Reach, spacing: f64, sigma: f64, [v_1, v_2]: [f64; 2]) -> f64 {
    let rule = GaussLegendre::new(POINTS);
    let shared = sigma * sigma;
    let determinant = v_1 * v_2 - shared * shared;
    let angles = reach.radii.len();
    let cosines: Vec<f64> =
        (0..angles).map(|i| pxfm::f_cos(TAU * i as f64 / angles as f64)).collect();
    let mut sum = 0.0;
    for (i, first) in reach.radii.iter().enumerate() {
        for (j, second) in reach.radii.iter().enumerate() {
            if *first <= 0.0 || *second <= 0.0 {
                continue;
            }
            let (least_1, least_2) = (spacing / first, spacing / second);
            let together = 2.0 * shared * cosines[(angles + i - j) % angles];
            // On one side of the corner r_1 decides, on the other r_2.
            let corner = pxfm::f_atan2(least_2, least_1);
            let side = |from: f64, until: f64, decides_1: bool| {
                rule.integrate(from, until, |phi| {
                    let (sin, cos) = pxfm::f_sincos(phi);
                    let q =
                        (v_2 * cos * cos + v_1 * sin * sin + together * cos * sin) / determinant;
                    let m = if decides_1 { least_1 / cos } else { least_2 / sin };
                    let half = 0.5 * q * m * m;
                    cos * sin * 2.0 / (q * q) * (1.0 + half) * pxfm::f_exp(-half)
                })
            };
            sum += side(0.0, corner, false) + side(corner, FRAC_PI_2, true);
        }
    }
    sum / ((angles * angles) as f64 * determinant)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circuits::nucleation::reach::closes_by_itself;
    use crate::numerics::random::NormalPairs;
    use crate::params::Chain;

    #[test]
    fn sampled_neighbours_close_as_often() {
        // Four masses' forces in a row between walls: a wall gap and its neighbour, and two gaps
        // between masses; five standard errors of 60 000 draws.
        let chain = Chain::default();
        let (sigma, draws) = (0.15_f64, 60_000);
        let reach = Reach::ever(&chain, 48);
        let (mass, wall) = (2.0 * sigma * sigma, sigma * sigma);
        let mut normals = NormalPairs::new("test of neighbouring gaps", 1, 0);
        let mut hits = [0_u32; 2];
        for _ in 0..draws {
            let forces: [[f64; 2]; 3] = std::array::from_fn(|_| normals.pair().map(|x| sigma * x));
            let closes =
                |a: [f64; 2], b: [f64; 2]| closes_by_itself(&chain, [b[0] - a[0], b[1] - a[1]]);
            let between = closes(forces[0], forces[1]);
            hits[0] += u32::from(closes([0.0; 2], forces[0]) && between);
            hits[1] += u32::from(between && closes(forces[1], forces[2]));
        }
        for (hits, pair) in hits.into_iter().zip([[wall, mass], [mass, mass]]) {
            let p = both(&reach, 1.0, sigma, pair);
            let error = (p * (1.0 - p) / f64::from(draws)).sqrt();
            assert!((f64::from(hits) / f64::from(draws) - p).abs() < 5.0 * error, "{hits} {p}");
            // Sharing a mass makes it more likely than by chance.
            let alone = pair.map(|variance| reach.probability(1.0, variance));
            assert!(p > 1.5 * alone[0] * alone[1], "{p} {alone:?}");
        }
    }

    #[test]
    fn order_does_not_matter_and_finer_rules_agree() {
        let chain = Chain::default();
        let (mass, wall) = (2.0 * 0.0144, 0.0144);
        // 64 angles are used where chains are looked at.
        let [coarse, fine] = [64, 96].map(|angles| Reach::ever(&chain, angles));
        let p = |reach, pair| both(reach, 1.0, 0.12, pair);
        let there = p(&coarse, [wall, mass]);
        assert!((there / p(&coarse, [mass, wall]) - 1.0).abs() < 1e-12);
        let finer = p(&fine, [wall, mass]);
        assert!((there / finer - 1.0).abs() < 1e-9, "{there} {finer}");
    }
}
