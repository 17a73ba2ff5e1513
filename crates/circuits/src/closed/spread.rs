//! The mean count of gaps with an impact, for a chain from rest between walls, and nothing measured.
//!
//! A gap is hit for the first time when it closes by itself, at a time that its forces tell
//! ([`nucleation`](crate::nucleation)), or when a front comes from a neighbour and has waited for it ([`front`](super::front)). So the time t_x of
//! the first impact at the gap x is
//!
//! t_x = min( own_x, l_{x−1} + wait from the left, l_{x+1} + wait from the right ),
//!
//! where l_x is the time at which a front leaves x: when one has come there, or when x has closed by itself and warmed up. Impacts take
//! energy at the rate (1 − r²)ν of what there is, and in a steady state forces give as much, so this takes 1/(1 − r²)ν. This is first-passage
//! percolation on a line: fronts never turn, and one pass from each end finds it.
//!
//! A gap with t_x in the window counts; one that was hit before has further impacts at the rate ν of its place
//! ([`masses`](super::masses)), and counts with 1 − e^{−νW}. What is left is a mean over forces and waits, which is taken over a sample: forces are
//! scaled from the same numbers at every σ. Gaps that nearly close by themselves are near each other, an obstacle is one for the fronts from
//! both sides, and fronts meet: all of this is in it, since forces are drawn and not averaged.
//!
//! *Where it fails.* The first few waits next to a gap that closes by itself are too short, by a factor of three and more. And at r ≤ 0.6 places fall
//! quiet for long, a third and more of what was reached, though impacts never end; here all are as active as in the mean.
//! At r = 0.6 fronts come to up to twice as many gaps as those of runs, and after long times the count is too high by some 40 gaps of 101. It is no matter of a
//! second solution: the balance of all masses comes to the same from a cold start.

use super::front::{Draws, Passage, passage};
use super::heat;
use super::masses::masses;
use super::ordered::OrderedGas;
use crate::Error;
use crate::nucleation::reach::{closes_by_itself, curve};
use impact_chain::{Boundary, Chain, Start};
use impact_numerics::estimates::average;
use impact_numerics::random::NormalPairs;
use impact_numerics::statistics::Estimate;
use std::f64::consts::TAU;

/// How often waits are drawn for each drawn chain.
const WAITS: usize = 4;

/// Steps of the search for gaps that close by themselves, in a unit of ωt, and how far it goes: what is missing
/// falls with the square of the time.
const STEPS: f64 = 10.0;
const FARTHEST: f64 = 2000.0;

/// What is computed once for all chains and forces.
#[derive(Clone, Debug)]
pub struct Spreading {
    chain: Chain,
    gas: OrderedGas,
    draws: Draws,
    /// The curve E of the start from rest, at equal steps of time.
    course: Vec<[f64; 2]>,
}

/// One chain with its forces: what decides when each of its gaps is hit first. Gaps are counted from the left wall's.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// When a gap closes by itself; infinite if it does not.
    pub alone: Vec<f64>,
    /// How a front from its left gets over each gap (none comes to the first) ...
    pub rightward: Vec<Passage>,
    /// ... and from its right (none comes to the last).
    pub leftward: Vec<Passage>,
    /// ν of each gap in a chain that impacts everywhere.
    pub rate: Vec<f64>,
    /// 1/(1 − r²)ν, how long each gap takes to warm up if it has closed by itself.
    pub warming: Vec<f64>,
    /// 2π/ω, after which a mass that was hit for the first time has had its first draw.
    pub period: f64,
}

impl Spreading {
    /// For this chain, and σ chosen later.
    ///
    /// # Errors
    /// [`Error::Input`] for a ring, another start than from rest, r = 1, and at resonance.
    pub fn new(chain: &Chain) -> Result<Self, Error> {
        if chain.boundary != Boundary::Walls || chain.start != Start::Rest {
            let problem = "the law of spreading is for a chain from rest between walls";
            return Err(Error::input("chain", problem, "leave boundary and start as they are"));
        }
        heat::check(chain, 1.0)?;
        let points = (FARTHEST * STEPS) as usize;
        let time = |i: usize| i as f64 / (STEPS * chain.natural_frequency);
        Ok(Spreading {
            chain: chain.clone(),
            gas: OrderedGas::new(),
            draws: Draws::new(),
            course: (0..=points).map(|i| curve(chain, time(i)).0).collect(),
        })
    }

    /// A chain with these forces, [α, β] each, of standard deviation σ.
    ///
    /// # Errors
    /// [`Error::Input`] for a σ that is not positive.
    pub fn drawn(&self, sigma: f64, forcing: &[[f64; 2]]) -> Result<Drawn, Error> {
        let chain = &self.chain;
        let own = masses(&self.gas, chain, sigma, forcing)?;
        let n = forcing.len();
        let force = |mass: usize| {
            mass.checked_sub(1).and_then(|j| forcing.get(j)).copied().unwrap_or_default()
        };
        let alone = |gap: usize| {
            let ([a, b], [c, d]) = (force(gap), force(gap + 1));
            let delta = [c - a, d - b];
            if !closes_by_itself(chain, delta) {
                return f64::INFINITY;
            }
            let closes = |at: &[f64; 2]| at[0] * delta[0] + at[1] * delta[1] >= chain.spacing;
            let step = 1.0 / (STEPS * chain.natural_frequency);
            self.course.iter().position(closes).map_or(f64::INFINITY, |i| i as f64 * step)
        };
        let reach = |edge, mass| passage(&self.draws, chain, edge, force(mass));
        // A front from the left stands at mass j and looks at mass j + 1, from 1; j's gaps are j − 1 and j.
        let rightward = (1..=n).map(|j| reach(&own.rightward[j - 1], j + 1));
        let leftward = (1..=n).map(|j| reach(&own.leftward[j - 1], j - 1));
        let kept = 1.0 - chain.restitution * chain.restitution;
        Ok(Drawn {
            alone: (0..=n).map(alone).collect(),
            rightward: std::iter::once(Passage::default()).chain(rightward).collect(),
            leftward: leftward.chain(std::iter::once(Passage::default())).collect(),
            warming: own.rate.iter().map(|rate| 1.0 / (kept * rate)).collect(),
            rate: own.rate,
            period: TAU / chain.natural_frequency,
        })
    }

    /// Half the sum of squares of all free amplitudes at a time, expected from these forces. A mass that was hit by then has s² of
    /// [`heat`], another one what cancels its forced motion at rest.
    ///
    /// # Errors
    /// [`Error::Input`] for a σ that is not positive.
    pub fn free(
        &self,
        sigma: f64,
        forcing: &[[f64; 2]],
        time: f64,
        normals: &mut NormalPairs,
    ) -> Result<f64, Error> {
        let (omega, big_omega) = (self.chain.natural_frequency, self.chain.forcing_frequency);
        let detuning = omega * omega - big_omega * big_omega;
        let hot = heat::heat(&self.gas, &self.chain, sigma)?.map(|own| own.free);
        let drawn = self.drawn(sigma, forcing)?;
        let mut sum = 0.0;
        for _ in 0..WAITS {
            let first = drawn.first_impacts(normals);
            for ([alpha, beta], gaps) in forcing.iter().zip(first.windows(2)) {
                let (a, b) = (alpha / detuning, big_omega / omega * beta / detuning);
                let hit = gaps[0].min(gaps[1]) <= time;
                sum += hot.filter(|_| hit).unwrap_or(0.5 * (a * a + b * b));
            }
        }
        Ok(sum / WAITS as f64)
    }

    /// The mean count for each pair of a transient and a window, from so many drawn chains, with what their number leaves open.
    ///
    /// # Errors
    /// [`Error::Input`] for a σ that is not positive, and for fewer than two chains.
    pub fn mean_counts(
        &self,
        sigma: f64,
        times: &[[f64; 2]],
        chains: u64,
        seed: u64,
    ) -> Result<Vec<Estimate>, Error> {
        let mut counts = vec![Vec::new(); times.len()];
        for index in 0..chains {
            let mut normals = NormalPairs::new("closed theory", seed, index);
            let forcing: Vec<[f64; 2]> =
                (0..self.chain.masses).map(|_| normals.pair().map(|x| sigma * x)).collect();
            let found = self.drawn(sigma, &forcing)?.mean_counts(times, &mut normals);
            for (own, count) in counts.iter_mut().zip(found) {
                own.push(count);
            }
        }
        let few = || Error::input("chains", format!("{chains}"), "give two at least, for an error");
        counts.iter().map(|own| average(own).ok_or_else(few)).collect()
    }
}

impl Drawn {
    /// The expected number of gaps with an impact for each pair of a transient and a window, over waits that are drawn.
    pub fn mean_counts(&self, times: &[[f64; 2]], normals: &mut NormalPairs) -> Vec<f64> {
        let mut sums = vec![0.0; times.len()];
        for _ in 0..WAITS {
            let first = self.first_impacts(normals);
            for (sum, [transient, window]) in sums.iter_mut().zip(times) {
                *sum += self.count(&first, *transient, *window);
            }
        }
        sums.into_iter().map(|sum| sum / WAITS as f64).collect()
    }

    /// When each gap is hit first, for waits that are drawn.
    pub fn first_impacts(&self, normals: &mut NormalPairs) -> Vec<f64> {
        let waits: Vec<[f64; 2]> = self
            .rightward
            .iter()
            .zip(&self.leftward)
            .map(|(right, left)| {
                [right.wait(self.period, normals), left.wait(self.period, normals)]
            })
            .collect();
        let gaps = self.alone.len();
        let mut first = self.alone.clone();
        let leaves: Vec<f64> =
            self.alone.iter().zip(&self.warming).map(|(alone, warming)| alone + warming).collect();
        let (mut right, mut left) = (leaves.clone(), leaves);
        for gap in 1..gaps {
            let comes = right[gap - 1] + waits[gap][0];
            right[gap] = right[gap].min(comes);
            first[gap] = first[gap].min(comes);
        }
        for gap in (1..gaps).rev() {
            let comes = left[gap] + waits[gap - 1][1];
            left[gap - 1] = left[gap - 1].min(comes);
            first[gap - 1] = first[gap - 1].min(comes);
        }
        first
    }

    /// The expected number of gaps with an impact in a window.
    pub fn count(&self, first: &[f64], transient: f64, window: f64) -> f64 {
        let counts = |(first, rate): (&f64, &f64)| {
            if *first > transient + window {
                0.0
            } else if *first > transient {
                1.0
            } else {
                -pxfm::f_expm1(-rate * window)
            }
        };
        first.iter().zip(&self.rate).map(counts).fold(0.0, |sum, x| sum + x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each gap by all gaps that it could be reached from, and not in two passes.
    #[test]
    fn first_impacts_are_the_nearest_of_all_ways() {
        let passage = |rate: f64| Passage { rate, chance: 0.5 * rate };
        let drawn = Drawn {
            alone: vec![f64::INFINITY, 3.0, f64::INFINITY, f64::INFINITY, 9.0],
            rightward: [0.0, 0.5, 0.2, 0.05, 0.3].map(passage).into(),
            leftward: [0.1, 0.4, 0.3, 0.2, 0.0].map(passage).into(),
            rate: vec![0.2; 5],
            warming: vec![1.0, 2.0, 3.0, 4.0, 5.0],
            period: 6.0,
        };
        let mut normals = NormalPairs::new("test of passages", 1, 0);
        for _ in 0..50 {
            let mut again = normals.clone();
            let first = drawn.first_impacts(&mut normals);
            let waits: Vec<[f64; 2]> = drawn
                .rightward
                .iter()
                .zip(&drawn.leftward)
                .map(|(a, b)| [a.wait(6.0, &mut again), b.wait(6.0, &mut again)])
                .collect();
            for (gap, first) in first.iter().enumerate() {
                let from = |other: usize| {
                    let way: f64 = if other < gap {
                        (other + 1..=gap).map(|x| waits[x][0]).sum()
                    } else {
                        (gap..other).map(|x| waits[x][1]).sum()
                    };
                    let warming = if other == gap { 0.0 } else { drawn.warming[other] };
                    drawn.alone[other] + warming + way
                };
                let nearest = (0..5).map(from).fold(f64::INFINITY, f64::min);
                assert!((first - nearest).abs() < 1e-9 * nearest, "{gap}");
            }
        }
        // Two before the window, one in it, one after it; the last has 1 − e^{−0.2·10} more than nothing.
        let count = drawn.count(&[1.0, 4.0, 12.0, 30.0, 31.0], 5.0, 10.0);
        assert!((count - (1.0 + 2.0 * (1.0 - pxfm::f_exp(-2.0)))).abs() < 1e-12);
    }

    /// Mean counts of all chains that the engine gave, 200 chains at each σ.
    #[test]
    fn counts_are_those_of_chains_that_were_run() {
        let spreading = Spreading::new(&Chain::default()).unwrap();
        for (sigma, short, long) in [(0.1, 6.2, 13.3), (0.12, 28.3, 54.8), (0.14, 62.1, 91.2)] {
            let found =
                spreading.mean_counts(sigma, &[[100.0, 100.0], [500.0, 200.0]], 120, 1).unwrap();
            for (found, expected) in found.iter().zip([short, long]) {
                let room = 3.0 + 3.0 * found.error;
                assert!((found.value - expected).abs() < room, "{sigma}: {found:?} {expected}");
            }
        }
    }

    /// At once nothing was hit, and in the end all.
    #[test]
    fn free_motion_is_that_of_rest_and_then_that_of_the_running_chain() {
        let spreading = Spreading::new(&Chain { masses: 3, ..Chain::default() }).unwrap();
        let forcing = [[0.6, 0.1], [-0.7, 0.2], [0.5, -0.4]];
        let mut normals = NormalPairs::new("test of free motion", 1, 0);
        let mut at = |time| spreading.free(0.3, &forcing, time, &mut normals).unwrap();
        // Amplitudes −α/D and −(Ω/ω)β/D with D = −1, Ω² = 2.
        let rest: f64 = forcing.iter().map(|[a, b]| 0.5 * (a * a + 2.0 * b * b)).sum();
        assert!((at(0.0) - rest).abs() < 1e-12);
        let hot = heat::heat(&spreading.gas, &spreading.chain, 0.3).unwrap().unwrap();
        assert!((at(1e9) - 3.0 * hot.free).abs() < 1e-12);
    }

    #[test]
    fn other_chains_are_refused() {
        let ring = Chain { boundary: Boundary::Ring, ..Chain::default() };
        assert!(Spreading::new(&ring).is_err());
        let own = Spreading::new(&Chain { masses: 3, ..Chain::default() }).unwrap();
        assert!(own.mean_counts(0.0, &[[1.0, 1.0]], 2, 1).is_err());
    }
}
