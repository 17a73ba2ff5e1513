//! Two neighbouring gaps that both close by themselves.
//!
//! Neighbours share a mass, and with it the force on that mass: both amplitude differences contain it
//! with opposite signs, so their covariance is −σ². In polar coordinates for the radii of the two,
//! r_1 = s cos φ and r_2 = s sin φ, the integral over s is elementary, and three angles are left. Where
//! tan φ < m_2/m_1, m_i = d/M(θ_i), the second radius decides whether both close, and with t = tan φ
//!
//! P = ⟨ ∫_0^{m_2/m_1} (2 t D/Q²)(1 + h) e^{−h} dt ⟩ over θ_1 and θ_2, and the same with 1 and 2 exchanged,
//! Q = v_2 + v_1 t² + 2σ² t cos(θ_1 − θ_2),  D = v_1 v_2 − σ⁴,  h = m_2² Q/(2 D t²),
//!
//! v_1 and v_2 being the variances of the differences. No function but the exponential is asked for.

use super::reach::Reach;
use impact_numerics::quadrature::GaussLegendre;
use std::f64::consts::TAU;

/// Points of the rule on each side of the angle from which on the other radius decides.
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
    // The part where the gap of the least radius `m` and the variance `v` decides.
    let decides = |(m, v): (f64, f64), (other_m, other_v): (f64, f64), twice_shared: f64| {
        rule.integrate(0.0, m / other_m, |t| {
            let q = v + t * (twice_shared + other_v * t);
            let half = 0.5 * m * m * q / (determinant * t * t);
            t / (q * q) * (1.0 + half) * pxfm::f_exp(-half)
        })
    };
    let mut sum = 0.0;
    for (i, first) in reach.radii.iter().enumerate() {
        // With equal variances the order of the angles does not matter.
        let others = if v_1 == v_2 { i + 1 } else { angles };
        for (j, second) in reach.radii[..others].iter().enumerate() {
            if *first <= 0.0 || *second <= 0.0 {
                continue;
            }
            let (one, two) = ((spacing / first, v_1), (spacing / second, v_2));
            let twice_shared = 2.0 * shared * cosines[(angles + i - j) % angles];
            let both = decides(two, one, twice_shared) + decides(one, two, twice_shared);
            sum += if v_1 == v_2 && j < i { 2.0 * both } else { both };
        }
    }
    2.0 * determinant * sum / (angles * angles) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nucleation::reach::closes_by_itself;
    use impact_chain::Chain;
    use impact_numerics::random::NormalPairs;

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
