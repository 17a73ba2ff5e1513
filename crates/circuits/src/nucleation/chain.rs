//! At least one gap of a chain that closes by itself.
//!
//! The gaps are 1-dependent: gaps that share no mass know nothing of one another, neighbours do, and
//! those that close by themselves come in clumps. Let a clump begin at a gap that closes when the gap to its left does
//! not. There is a gap that closes if and only if there is a clump, and beginnings of clumps are nearly
//! independent: with their mean number λ, none begins with a probability near e^{−λ}.
//!
//! Dependence only makes chains without such a gap more frequent. In unlimited time a gap does not close if the
//! difference of its forces lies in a set that is convex and symmetric about zero, and forces are jointly normal. By the
//! Gaussian correlation inequality (Royen 2014) all gaps stay open with at least the product of their probabilities
//! to do so: as if gaps were independent is a bound on the share of chains with a gap that closes.

use super::pair::both;
use super::reach::Reach;
use impact_chain::{Boundary, Chain};
use impact_numerics::regula_falsi::crossing;
use serde::{Deserialize, Serialize};

/// How likely it is that single gaps and neighbours close by themselves, of a chain from rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chances {
    /// A gap between masses.
    pub p: f64,
    /// A gap at a wall.
    pub wall: f64,
    /// Both of two neighbouring gaps between masses.
    pub pair: f64,
    /// A gap at a wall and its neighbour.
    pub wall_pair: f64,
}

/// The probability that at least one gap of a chain closes by itself.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AtLeastOne {
    /// As if gaps knew nothing of one another.
    pub independent: f64,
    /// The mean number λ of clumps.
    pub clumps: f64,
    /// 1 − e^{−λ}.
    pub value: f64,
}

impl Chances {
    /// The chances within a reach, for forces of standard deviation `sigma`; for neighbours, which take
    /// the square of the number of angles, that reach may be at `fewer` angles.
    pub fn new(chain: &Chain, reach: &Reach, fewer: &Reach, sigma: f64) -> Chances {
        let (mass, wall) = (2.0 * sigma * sigma, sigma * sigma);
        let d = chain.spacing;
        Chances {
            p: reach.probability(d, mass),
            wall: reach.probability(d, wall),
            pair: both(fewer, d, sigma, [mass, mass]),
            wall_pair: both(fewer, d, sigma, [wall, mass]),
        }
    }

    /// For a chain of `masses` masses, one at least, between walls or in a ring.
    pub fn at_least_one(&self, masses: usize, boundary: Boundary) -> AtLeastOne {
        // Each gap's chance to close, and that of a clump to begin there.
        let walls = boundary == Boundary::Walls && masses > 1;
        let gaps = if boundary == Boundary::Walls { masses + 1 } else { masses };
        let closes =
            |gap: usize| if walls && (gap == 0 || gap == masses) { self.wall } else { self.p };
        let begins = |gap: usize| match (walls, gap) {
            (true, 0) => self.wall,
            (true, 1) => self.p - self.wall_pair,
            (true, gap) if gap == masses => self.wall - self.wall_pair,
            _ => self.p - self.pair,
        };
        let (mut clumps, mut none) = (0.0, 1.0);
        for gap in 0..gaps {
            clumps += begins(gap);
            none *= 1.0 - closes(gap);
        }
        let value = -pxfm::f_expm1(-clumps);
        AtLeastOne { independent: 1.0 - none, clumps, value }
    }
}

/// The σ at which half of such chains have a gap that closes by itself, to about 1e-6 of itself; the sum over
/// angles is less exact.
pub fn half(chain: &Chain, reach: &Reach, fewer: &Reach) -> f64 {
    let share = |sigma: f64| {
        Chances::new(chain, reach, fewer, sigma).at_least_one(chain.masses, chain.boundary).value
    };
    let logarithms = [0.02, 2.0].map(|times: f64| pxfm::f_log(times * chain.spacing));
    pxfm::f_exp(crossing(logarithms, 1e-6, |log_sigma| share(pxfm::f_exp(log_sigma)) - 0.5))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nucleation::reach::closes_by_itself;
    use impact_numerics::random::NormalPairs;

    #[test]
    fn drawn_chains_are_near_the_value() {
        let chain = Chain { masses: 30, ..Chain::default() };
        let reach = Reach::ever(&chain, 32);
        let draws = 4000;
        let half = half(&chain, &reach, &reach);
        for (sigma, index) in [(0.08, 0), (0.11, 1), (half, 2)] {
            let mut normals = NormalPairs::new("test of clumps", 1, index);
            let (mut some, mut clumps) = (0_u32, 0_u32);
            for _ in 0..draws {
                let mut forces: Vec<[f64; 2]> =
                    (0..30).map(|_| normals.pair().map(|x| sigma * x)).collect();
                forces.insert(0, [0.0; 2]);
                forces.push([0.0; 2]);
                let closes: Vec<bool> = forces
                    .windows(2)
                    .map(|pair| {
                        let delta = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
                        closes_by_itself(&chain, delta)
                    })
                    .collect();
                some += u32::from(closes.contains(&true));
                clumps += u32::from(closes[0]);
                clumps += closes.windows(2).map(|pair| u32::from(!pair[0] && pair[1])).sum::<u32>();
            }
            let found =
                Chances::new(&chain, &reach, &reach, sigma).at_least_one(30, Boundary::Walls);
            let n = f64::from(draws);
            let (share, mean) = (f64::from(some) / n, f64::from(clumps) / n);
            let error = (share * (1.0 - share) / n).sqrt();
            assert!((share - found.value).abs() < 0.01 + 5.0 * error, "{share} {found:?}");
            assert!((mean - found.clumps).abs() < 5.0 * (mean / n).sqrt(), "{mean} {found:?}");
            assert!(found.independent > found.value);
            // That independent gaps are a bound is the Gaussian correlation inequality.
            assert!(share < found.independent + 3.0 * error, "{share} {found:?}");
            assert!(sigma != half || (found.value - 0.5).abs() < 1e-5, "{found:?}");
        }
    }

    #[test]
    fn without_sharing_it_is_poisson() {
        // 1 − (1 − p)^n and 1 − e^{−np} differ by less than Le Cam's n p².
        let chances = Chances { p: 0.003, wall: 0.003, pair: 9e-6, wall_pair: 9e-6 };
        for boundary in [Boundary::Walls, Boundary::Ring] {
            let found = chances.at_least_one(200, boundary);
            assert!((found.independent - found.value).abs() < 201.0 * 9e-6);
        }
    }

    /// The mean number of clumps is that of gaps less that of neighbours that both close.
    #[test]
    fn clumps_are_gaps_less_neighbours() {
        let own = Chances { p: 0.03, wall: 0.01, pair: 0.004, wall_pair: 0.002 };
        let found = own.at_least_one(12, Boundary::Walls);
        let pairs = 2.0 * own.wall_pair + 10.0 * own.pair;
        assert!((found.clumps - (2.0 * own.wall + 11.0 * own.p - pairs)).abs() < 1e-15);
    }
}
