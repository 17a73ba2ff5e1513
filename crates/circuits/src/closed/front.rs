//! How soon the mass at an edge reaches a neighbour that was never hit.
//!
//! *Ahead.* Masses that were never hit move as they have from rest, which is known: with X = F/D the amplitude of the forced motion,
//! Re X e^{iΩt}, the free part that cancels it at t = 0 has the amplitude |z|, z = (Re X, (Ω/ω) Im X). Against such a
//! neighbour the mass at the edge has a forced motion of amplitude Q = |X_edge − X|.
//!
//! *A draw.* Each impact from behind gives the mass at the edge another free motion. Let u² be the variance of the random part of its velocity
//! and w² that of all of it, and the mass behind be like it. An impact at the closing speed V leaves the sum S of their velocities, of which 2u² is random and independent of
//! V, and turns the difference into −rV. So the mass at the edge leaves at (S + rV)/2, outwards as a rule, where V, being hit in
//! proportion to itself, is Rayleigh distributed with ⟨V²⟩ = 4w². Both masses are normal about places d apart, and touch: so it leaves from
//! −d/2, give or take √(⟨x²⟩/2), ⟨x²⟩ being that of [`ordered`](super::ordered) masses. These make the amplitude A of its free motion, and with the free part ahead, at any
//! phase χ of it, A' = √(A² + |z|² + 2A|z| cos χ). The larger r, the farther it swings; this is how restitution decides about fronts.
//!
//! *A swing.* A mass that swings far enough out swings as far back and meets the mass behind. So a draw is one swing, and this reaches the neighbour
//! if A' + Q cos φ > d at the phase φ of the forced motion at its top, with the probability arccos((d − A')/Q)/π. Averaged over draws this is P, the chance
//! of one impact from behind.
//!
//! *A wait.* The impact that opens a gap is slow, the last of a swing that just reached. But two masses that parted are back
//! within a free period 2π/ω, and the mass at the edge has its first draw by then; more follow at the rate ν of the gap behind. So a front waits for longer than t
//! with the probability e^{−νPt}, and with 1 − P times that from 2π/ω on. Forces do not change, and so P belongs to the
//! gap: over many gaps the share of long waits falls the more slowly the longer they last.
//!
//! Tried and left: Rice's rate of closings for a random motion that is drawn afresh all the time. Its mean counts are as good at r = 0.8, but early
//! waits are too few, and it does not know restitution: fronts are too slow at r = 0.9. Draws that swing on until the next impact are too fast.

use super::masses::Edge;
use impact_chain::Chain;
use impact_numerics::random::NormalPairs;
use impact_numerics::statistics::normal_quantile;
use std::f64::consts::{PI, SQRT_2};

/// Draws over which P is averaged, a prime, and the multiplier of their lattice: found by trial, the best of all for P.
const DRAWS: [u64; 2] = [251, 141];

/// How a front gets over a gap.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Passage {
    /// P, of one draw.
    pub chance: f64,
    /// νP, of all draws after the first in a unit of time.
    pub rate: f64,
}

/// Draws that fill the space of all draws evenly.
#[derive(Clone, Debug)]
pub struct Draws {
    /// In units of their spreads: the normal part of the place, S/2, V/2, and the cosine of the phase
    /// of the free motion ahead.
    points: Vec<[f64; 4]>,
}

impl Draws {
    /// The usual number: P is exact to 0.01, and to a fortieth of itself.
    pub fn new() -> Self {
        Self::lattice(DRAWS)
    }

    /// A lattice of Korobov's: the point i is (1, a, a², a³) i/N modulo 1, in the middle of its cell.
    fn lattice([number, multiplier]: [u64; 2]) -> Self {
        let point = |i: u64| {
            let mut own = i;
            let [a, b, c, phase] = std::array::from_fn(|_| {
                let share = (own as f64 + 0.5) / number as f64;
                own = own * multiplier % number;
                share
            });
            // The quantile is asked for by the probability of both sides.
            let normal = |share: f64| normal_quantile(2.0 * share - 1.0);
            let rayleigh = (-2.0 * pxfm::f_log1p(-c)).sqrt();
            [normal(a), normal(b), rayleigh, pxfm::f_cos(PI * phase)]
        };
        Draws { points: (0..number).map(point).collect() }
    }
}

impl Default for Draws {
    fn default() -> Self {
        Self::new()
    }
}

impl Passage {
    /// The probability that a front waits for longer than `time`; the free period is 2π/ω.
    pub fn longer(&self, time: f64, period: f64) -> f64 {
        let first = if time < period { 1.0 } else { 1.0 - self.chance };
        first * pxfm::f_exp(-self.rate * time)
    }

    /// A wait. Half the square of the length of a normal pair is exponential of mean one: the hazard that is used up when the
    /// wait ends, νP in a unit of time and −ln(1 − P) at the first draw.
    pub fn wait(&self, period: f64, normals: &mut NormalPairs) -> f64 {
        let [x, y] = normals.pair();
        let hazard = 0.5 * (x * x + y * y);
        let rest = hazard + pxfm::f_log1p(-self.chance.min(1.0 - f64::EPSILON));
        (hazard / self.rate).min(period.max(rest / self.rate))
    }
}

/// How the mass at an edge gets over the gap to a neighbour that was never hit and has this force; a wall has none.
pub fn passage(draws: &Draws, chain: &Chain, edge: &Edge, [alpha, beta]: [f64; 2]) -> Passage {
    let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
    let detuning = omega * omega - big_omega * big_omega;
    let (cos, sin) = (alpha / detuning, -beta / detuning);
    let apart = [edge.kept[0] - cos, edge.kept[1] - sin];
    let forced = (apart[0] * apart[0] + apart[1] * apart[1]).sqrt();
    let turned = big_omega / omega * sin;
    let ahead = (cos * cos + turned * turned).sqrt();
    // In units of d.
    let width = edge.square.sqrt() / (SQRT_2 * omega * chain.spacing);
    let (forced, ahead) = (forced / chain.spacing, ahead / chain.spacing);
    let wide = (0.5 * edge.position).sqrt() / chain.spacing;
    let broad = edge.all.sqrt() / (SQRT_2 * omega * chain.spacing);
    let mut sum = 0.0;
    for [x, s, v, phase] in &draws.points {
        let (x, v) = (wide * x - 0.5, width * s + chain.restitution * broad * v);
        let square = x * x + v * v;
        let reach = (square + ahead * ahead + 2.0 * square.sqrt() * ahead * phase).sqrt();
        let short = 1.0 - reach;
        if short < forced {
            let p = if short <= -forced { 1.0 } else { pxfm::f_acos(short / forced) / PI };
            sum += p;
        }
    }
    let chance = sum / draws.points.len() as f64;
    Passage { chance, rate: edge.rate * chance }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_normal_and_rayleigh() {
        let draws = Draws::new();
        let mean = |f: fn(&[f64; 4]) -> f64| {
            draws.points.iter().map(f).sum::<f64>() / draws.points.len() as f64
        };
        for (found, expected) in [
            (mean(|p| p[0]), 0.0),
            (mean(|p| p[0] * p[0]), 1.0),
            (mean(|p| p[1] * p[1]), 1.0),
            (mean(|p| p[2] * p[2]), 2.0),
            (mean(|p| p[0] * p[1]), 0.0),
            (mean(|p| p[1] * p[2]), 0.0),
            (mean(|p| p[3]), 0.0),
            (mean(|p| p[0] * p[3]), 0.0),
            (mean(|p| p[1] * p[3]), 0.0),
        ] {
            assert!((found - expected).abs() < 0.06, "{found} {expected}");
        }
    }

    /// The second route: two masses that meet are drawn whole, one impact is made, and the motion after it is followed in small steps.
    #[test]
    fn drawn_impacts_reach_as_often() {
        let chain = Chain::default();
        let (u, position) = (0.5_f64, 0.15_f64);
        let edge = Edge { square: u * u, kept: [-0.1, 0.2], position, all: u * u, rate: 0.1 };
        let mut normals = NormalPairs::new("test of fronts", 1, 0);
        for force in [[0.12_f64, -0.1], [0.05, 0.1]] {
            let ahead = [-force[0], force[1]];
            let frozen = (ahead[0] * ahead[0] + 2.0 * ahead[1] * ahead[1]).sqrt();
            let apart: [f64; 2] = std::array::from_fn(|k| edge.kept[k] - ahead[k]);
            let forced = (apart[0] * apart[0] + apart[1] * apart[1]).sqrt();
            let (mut weight, mut reached) = (0.0, 0.0);
            for _ in 0..20_000 {
                let [behind, own] = normals.pair().map(|x| u * x);
                let closing = behind - own;
                if closing <= 0.0 {
                    continue;
                }
                let after = own + 0.5 * (1.0 + chain.restitution) * closing;
                let [x, _] = normals.pair();
                let x = -0.5 + x * (0.5 * position).sqrt();
                // The phases of both other motions, from directions of normal pairs.
                let [turn, late] = [(); 2].map(|()| {
                    let [c, d] = normals.pair();
                    c / (c * c + d * d).sqrt()
                });
                // At the top of the swing.
                let top = (x * x + after * after).sqrt();
                let all = (top * top + frozen * frozen + 2.0 * top * frozen * turn).sqrt();
                weight += closing;
                reached += if all + forced * late > 1.0 { closing } else { 0.0 };
            }
            let found = reached / weight;
            let expected = passage(&Draws::new(), &chain, &edge, force);
            assert!((found - expected.chance).abs() < 0.02, "{found} {expected:?}");
            assert!((expected.rate - 0.1 * expected.chance).abs() < 1e-15);
        }
    }

    /// Drawn waits, counted.
    #[test]
    fn waits_have_their_law() {
        let passage = Passage { rate: 0.05, chance: 0.3 };
        let mut normals = NormalPairs::new("test of waits", 1, 0);
        let waits: Vec<f64> = (0..40_000).map(|_| passage.wait(6.0, &mut normals)).collect();
        for time in [3.0, 5.99, 6.01, 20.0, 60.0] {
            let found = waits.iter().filter(|wait| **wait > time).count() as f64 / 40_000.0;
            let expected = passage.longer(time, 6.0);
            assert!((found - expected).abs() < 0.012, "{time}: {found}");
        }
        // A gap that no draw opens is never passed.
        assert_eq!(Passage::default().wait(6.0, &mut normals), f64::INFINITY);
    }

    #[test]
    fn more_draws_change_little_and_lengths_scale() {
        let (few, many, chain) = (Draws::new(), Draws::lattice([65_521, 12_345]), Chain::default());
        let double = Chain { spacing: 2.0, ..Chain::default() };
        for (square, kept, force) in [
            (0.3, [0.1, 0.1], [0.1, -0.2]),
            (0.12, [0.2, -0.1], [0.15, 0.15]),
            (0.5, [-0.3, 0.0], [0.3, 0.1]),
        ] {
            let edge = Edge { square, kept, position: 0.7 * square, all: 1.2 * square, rate: 0.1 };
            let [a, b] = [&few, &many].map(|own| passage(own, &chain, &edge, force).chance);
            assert!((a - b).abs() < 0.015, "{square}: {a} {b}");
            let wide = Edge {
                square: 4.0 * square,
                kept: kept.map(|x| 2.0 * x),
                position: 2.8 * square,
                all: 4.8 * square,
                rate: 0.1,
            };
            let c = passage(&few, &double, &wide, force.map(|x| 2.0 * x)).chance;
            assert!((a - c).abs() < 1e-12, "{a} {c}");
        }
    }
}
