//! Holds what chains have in common that are simulated side by side: their constants, and a grid of
//! time with cosines and sines of both phases.

use crate::search::clock::{Instant, Rate};
use crate::topology::Topology;
use crate::{Boundary, Chain, HitGaps};
use std::borrow::Cow;

/// What chains side by side have in common. Lengths in units of d, times of 1/ω.
#[derive(Clone, Debug)]
pub struct Plan {
    pub omega: f64,
    /// ρ = Ω/ω.
    pub ratio: f64,
    pub restitution: f64,
    /// Length h of a step, half of it, and h²/8.
    pub step: f64,
    pub half: f64,
    pub eighth: f64,
    /// Unit of speeds, d ω.
    pub speed: f64,
    /// Number of the first gap in results.
    pub first: usize,
    /// For each gap those that share a mass with it; `usize::MAX` if there is none.
    pub neighbours: Vec<[usize; 2]>,
    /// For each gap the parts of its jump by which the rates of the gap before it, itself and the
    /// gap after it go back.
    pub weights: Vec<[f64; 4]>,
    pub ring: bool,
    /// A chain ends once so many gaps were hit after this time.
    pub end: (HitGaps, f64),
}

impl Plan {
    pub fn new(chain: &Chain, length: f64) -> Plan {
        let topology = Topology::new(chain.masses, chain.boundary);
        let step = chain.natural_frequency * length;
        let gaps = 0..topology.gaps();
        // The masses beside the gap jump by half of its jump each, or one by all at a wall.
        let weights = |gap| {
            let [left, right] = topology.inverse_masses(gap);
            [left / (left + right), -1.0, right / (left + right), 0.0]
        };
        let neighbours =
            |gap| topology.adjacent(gap).map(|near: Option<usize>| near.unwrap_or(usize::MAX));
        Plan {
            omega: chain.natural_frequency,
            ratio: chain.forcing_frequency / chain.natural_frequency,
            restitution: chain.restitution,
            step,
            half: 0.5 * step,
            eighth: step * step / 8.0,
            speed: chain.spacing * chain.natural_frequency,
            first: topology.label(0),
            neighbours: gaps.clone().map(neighbours).collect(),
            weights: gaps.map(weights).collect(),
            ring: chain.boundary == Boundary::Ring,
            end: (HitGaps::All, f64::INFINITY),
        }
    }
}

/// The longest step in units of 1/ω, and in units of 1/Ω.
const LONGEST: [f64; 2] = [0.25, 0.5];

/// Steps whose phases are kept; those of a longer run are computed in pieces of as many.
const KEPT: usize = 1 << 14;

/// cos ωt, sin ωt, cos Ωt and sin Ωt.
pub type Phases = [f64; 4];

#[derive(Clone, Copy, Debug)]
pub struct Step {
    pub middle: Phases,
    pub end: Phases,
}

/// Steps of equal length from t = 0, with their phases.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Length of a step in the scenario's units, a power of two: its multiples are exact.
    pub length: f64,
    rates: [Rate; 2],
    steps: usize,
    /// All steps, or none if there are more than are kept.
    table: Vec<Step>,
}

impl Grid {
    /// Tabulates the steps from 0 to `until` or a little later.
    pub fn new(frequencies: [f64; 2], until: f64) -> Grid {
        let [omega, big_omega] = frequencies;
        let longest = (LONGEST[0] / omega).min(LONGEST[1] / big_omega);
        // The power of two below: without its mantissa.
        let length = f64::from_bits(longest.to_bits() & !((1 << 52) - 1));
        let steps = (until / length).ceil() as usize;
        let rates = frequencies.map(Rate::new);
        let mut grid = Grid { length, rates, steps, table: Vec::new() };
        if steps <= KEPT {
            grid.table = grid.compute_steps(0, steps);
        }
        grid
    }

    pub fn start(&self) -> Phases {
        self.phases(0)
    }

    pub fn pieces(&self) -> impl Iterator<Item = Cow<'_, [Step]>> {
        (0..self.steps.div_ceil(KEPT)).map(|piece| match &self.table[..] {
            [] => Cow::Owned(self.compute_steps(piece * KEPT, KEPT.min(self.steps - piece * KEPT))),
            table => Cow::Borrowed(table),
        })
    }

    fn compute_steps(&self, first: usize, number: usize) -> Vec<Step> {
        let step = |i| Step { middle: self.phases(2 * i + 1), end: self.phases(2 * i + 2) };
        (first..first + number).map(step).collect()
    }

    /// Computes the phases after so many half steps, by the clock of the engine: not cos Ωt of a
    /// large t, whose argument is rounded.
    fn phases(&self, halves: usize) -> Phases {
        let instant = Instant::at(halves as f64 * (0.5 * self.length));
        let [(sin, cos), (forced_sin, forced_cos)] = self.rates.map(|rate| rate.sin_cos(instant));
        [cos, sin, forced_cos, forced_sin]
    }
}
