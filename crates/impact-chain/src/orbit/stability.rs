//! Floquet multipliers of a periodic orbit.

use super::Orbit;
use crate::Scenario;
use impact_numerics::dense::Square;
use impact_numerics::eigenvalues::eigenvalues;

/// Whether motions near a periodic orbit come nearer.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    /// The multipliers (re, im) that are not neutral, by falling modulus.
    pub multipliers: Vec<[f64; 2]>,
    /// Pairs of neutral multipliers e^{±iωP}: one for each mass that is not hit, and one for each row of
    /// gaps that are hit of which none is at a wall, since no impact changes its momentum.
    pub neutral: usize,
    /// How far the neutral ones, as computed, are from e^{±iωP}.
    pub error: f64,
}

impl Stability {
    /// Of an orbit; none if the multipliers cannot be computed.
    pub fn new(scenario: &Scenario, orbit: &Orbit) -> Option<Stability> {
        let mut multipliers = eigenvalues(&monodromy(scenario, orbit))?;
        let neutral = neutral_pairs(scenario.forcing.len(), &orbit.gaps);
        let (sin, cos) = pxfm::f_sincos(scenario.natural_frequency * orbit.period);
        let mut error: f64 = 0.0;
        for sign in [1.0, -1.0] {
            for _ in 0..neutral {
                let distance = |m: &[f64; 2]| modulus([m[0] - cos, m[1] - sign * sin]);
                let nearest = (0..multipliers.len()).min_by(|&i, &j| {
                    distance(&multipliers[i]).total_cmp(&distance(&multipliers[j]))
                })?;
                error = error.max(distance(&multipliers.remove(nearest)));
            }
        }
        Some(Stability { multipliers, neutral, error })
    }

    /// The largest modulus of a multiplier that is not neutral.
    pub fn radius(&self) -> f64 {
        self.multipliers.first().map_or(0.0, |own| modulus(*own))
    }

    /// All of them are inside the unit circle.
    pub fn stable(&self) -> bool {
        self.radius() < 1.0
    }
}

/// The modulus √(x² + y²).
fn modulus([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

/// Masses that are not hit, and rows of hit gaps without a wall.
fn neutral_pairs(masses: usize, gaps: &[usize]) -> usize {
    let hit: Vec<bool> = (0..=masses).map(|gap| gaps.contains(&gap)).collect();
    let mut pairs = 0;
    let mut at = 0;
    // A row of masses held together by hit gaps: from the open gap before it to the one after it.
    while at < masses {
        let mut end = at + 1;
        while end < masses && hit[end] {
            end += 1;
        }
        let walls = (at == 0 && hit[0]) || (end == masses && hit[masses]);
        pairs += usize::from(!walls);
        at = end;
    }
    pairs
}

/// The derivative, by the free parts (a_1, b_1, a_2, …) at t = 0, of those after one period, seen from
/// there.
///
/// In flight nothing changes them. Where a gap closes at speed V, a shift of its place by x shifts the
/// time of the impact by x/V and so its direction in (a, b), and the speed by the acceleration times
/// that: the saltation matrix. Its determinant is r².
pub(super) fn monodromy(scenario: &Scenario, orbit: &Orbit) -> Square {
    let n = scenario.forcing.len();
    let (w, big_w) = (scenario.natural_frequency, scenario.forcing_frequency);
    let factor = (w - big_w) * (w + big_w);
    let mut parts = orbit.free.clone();
    let mut product = Square::identity(2 * n);
    for i in 0..orbit.gaps.len() {
        let (sin, cos) = pxfm::f_sincos(w * orbit.times[i]);
        let (forced_sin, forced_cos) = pxfm::f_sincos(big_w * orbit.times[i]);
        // The gap's place, speed of opening and acceleration, as functions of the free parts.
        let (mut place, mut rate) = (vec![0.0; 2 * n], vec![0.0; 2 * n]);
        let (mut kick, mut turn) = (vec![0.0; 2 * n], vec![0.0; 2 * n]);
        let mut acceleration = 0.0;
        let mut inverse_mass = 0.0;
        for (mass, sign) in [(orbit.gaps[i], -1.0), (orbit.gaps[i] + 1, 1.0)] {
            let Some(j) = mass.checked_sub(1).filter(|&j| j < n) else { continue };
            inverse_mass += 1.0;
            (place[2 * j], place[2 * j + 1]) = (sign * cos, sign * sin);
            (rate[2 * j], rate[2 * j + 1]) = (-sign * w * sin, sign * w * cos);
            (kick[2 * j], kick[2 * j + 1]) = (-sign * sin / w, sign * cos / w);
            (turn[2 * j], turn[2 * j + 1]) = (-sign * cos, -sign * sin);
            let [a, b] = parts[j];
            let [alpha, beta] = scenario.forcing[j];
            let forced = (alpha * forced_cos + beta * forced_sin) / factor;
            acceleration -= sign * (w * w * (a * cos + b * sin) + big_w * big_w * forced);
        }
        let (speed, impulse) = (orbit.speeds[i], orbit.impulses[i]);
        let share = (1.0 + scenario.restitution) / inverse_mass;
        let mut saltation = Square::identity(2 * n);
        for column in 0..2 * n {
            let shift = place[column] / speed;
            let faster = -rate[column] - acceleration * shift;
            for row in 0..2 * n {
                saltation[(row, column)] +=
                    kick[row] * share * faster + turn[row] * impulse * shift;
            }
        }
        product = saltation.times(&product);
        for (j, part) in parts.iter_mut().enumerate() {
            part[0] += kick[2 * j] * impulse;
            part[1] += kick[2 * j + 1] * impulse;
        }
    }
    // After one period the phases ωt start anew.
    let (sin, cos) = pxfm::f_sincos(w * orbit.period);
    let mut turned = Square::zero(2 * n);
    for column in 0..2 * n {
        for j in 0..n {
            let (a, b) = (product[(2 * j, column)], product[(2 * j + 1, column)]);
            turned[(2 * j, column)] = a * cos + b * sin;
            turned[(2 * j + 1, column)] = b * cos - a * sin;
        }
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::super::{Solver, replay};
    use super::*;
    use crate::Chain;
    use crate::{Engine, Initial};
    use impact_numerics::random::{NormalPairs, generator};
    use rand::RngExt;

    /// The first orbit of a circuit that the engine confirms, over random forcings.
    fn found(circuit: &[usize], sigma: f64) -> (Scenario, Orbit) {
        let chain = Chain { masses: 3, ..Chain::default() };
        let mut random = generator("test", 1, 0);
        for index in 0..200 {
            let scenario = Scenario::draw(&chain, sigma, &mut NormalPairs::new("test", 2, index));
            let solver = Solver::new(&scenario, circuit, 1).unwrap();
            for _ in 0..12 {
                let mut times: Vec<f64> =
                    circuit.iter().map(|_| random.random::<f64>() * solver.period()).collect();
                times.sort_by(f64::total_cmp);
                if let Some(orbit) = solver.from(&times)
                    && let Some(told) = replay(&scenario, &orbit).unwrap()
                {
                    assert!(told.late < 1e-9 && told.off < 1e-9, "{told:?}");
                    return (scenario, orbit);
                }
            }
        }
        panic!("no orbit of {circuit:?}");
    }

    /// The free parts after one period, seen from there, by the engine.
    fn after(scenario: &Scenario, period: f64, free: Vec<[f64; 2]>) -> Vec<f64> {
        let start = Scenario { initial: Initial::Free(free), ..scenario.clone() };
        let mut engine = Engine::new(&start).unwrap();
        engine.run(period, |_| true).unwrap();
        let (sin, cos) = pxfm::f_sincos(scenario.natural_frequency * period);
        let turned = |[a, b]: [f64; 2]| [a * cos + b * sin, b * cos - a * sin];
        engine.free_parts().into_iter().flat_map(turned).collect()
    }

    #[test]
    fn the_matrix_is_the_derivative_of_what_the_engine_does() {
        for circuit in [&[1][..], &[0, 1], &[0, 2, 1], &[0, 1, 2, 3]] {
            let (scenario, orbit) = found(circuit, 0.3);
            let matrix = monodromy(&scenario, &orbit);
            let h = 1e-7;
            let mut largest: f64 = 0.0;
            for column in 0..6 {
                let shifted = |by: f64| {
                    let mut free = orbit.free.clone();
                    free[column / 2][column % 2] += by;
                    after(&scenario, orbit.period, free)
                };
                let (up, down) = (shifted(h), shifted(-h));
                for row in 0..6 {
                    let slope = (up[row] - down[row]) / (2.0 * h);
                    let size = matrix[(row, column)].abs();
                    largest = largest.max(size);
                    let off = (slope - matrix[(row, column)]).abs();
                    assert!(off < 1e-5 * (1.0 + size * size), "{circuit:?} {row} {column}: {off}");
                }
            }
            assert!(largest > 0.5);
            // Each impact takes r² of the volume.
            let k = circuit.len() as f64;
            let expected = pxfm::f_exp(2.0 * k * pxfm::f_log(0.8));
            assert!((matrix.determinant() / expected - 1.0).abs() < 1e-9, "{circuit:?}");
        }
    }

    #[test]
    fn neutral_multipliers_are_those_of_momenta_that_no_impact_changes() {
        let pairs = [
            (&[0][..], 2),
            (&[1], 2),
            (&[0, 3], 1),
            (&[1, 2], 1),
            (&[0, 2], 1),
            (&[0, 1, 3], 0),
            (&[0, 1, 2, 3], 0),
        ];
        for (gaps, expected) in pairs {
            assert_eq!(neutral_pairs(3, gaps), expected, "{gaps:?}");
        }
        for circuit in [&[1][..], &[1, 2], &[0, 1]] {
            let (scenario, orbit) = found(circuit, 0.3);
            let stability = Stability::new(&scenario, &orbit).unwrap();
            assert!(stability.error < 1e-10, "{}", stability.error);
            assert_eq!(stability.multipliers.len() + 2 * stability.neutral, 6);
        }
    }
}
