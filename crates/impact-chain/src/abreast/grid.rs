//! Tabulates cosines and sines of both phases on the common grid of time.

use crate::search::clock::{Instant, Rate};
use std::borrow::Cow;

/// The longest step in units of 1/ω, and in units of 1/Ω.
const LONGEST: [f64; 2] = [0.25, 0.5];

/// Steps whose phases are kept; those of a longer run are computed in pieces of as many.
const KEPT: usize = 1 << 14;

/// cos ωt, sin ωt, cos Ωt and sin Ωt.
pub type Phases = [f64; 4];

/// The phases in the middle and at the end of a step.
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

    /// Lists all steps in pieces.
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
