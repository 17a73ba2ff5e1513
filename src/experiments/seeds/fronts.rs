//! Measures how fronts advance: how long each waits for the next gap.
//!
//! Ahead of a front no gap closes by itself, so it takes one gap after the other. A wait ends with
//! a step or with the run; a front at a wall has no wait any more.

use super::Trace;
use crate::experiments::prelude::*;
use std::f64::consts::TAU;

/// The fronts of one run, as numbers of fronts, steps and units of time.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fronts {
    /// Sides of the seed that are not at a wall.
    pub fronts: f64,
    /// Waits that ended with a step.
    pub steps: f64,
    /// Those of them that lasted one beat at most.
    pub short: f64,
    pub waited: f64,
    /// Fronts that have stood for the second half of the run when it ends.
    pub standing: f64,
}

/// Returns the beat 2π/|Ω − ω|: what present motions can close is closed by then, as a rule.
pub fn beat(chain: &Chain) -> f64 {
    TAU / (chain.forcing_frequency - chain.natural_frequency).abs()
}

impl Fronts {
    /// Counts the fronts of a run to both sides of its seed.
    pub(super) fn count(parameters: &SeedsParams, (seed, trace): (usize, &Trace)) -> Self {
        let (end, beat) = (parameters.until() as u32, beat(&parameters.chain) as u32);
        let mut sums = Fronts::default();
        let (left, right) = (trace.firsts[..seed].iter().rev(), trace.firsts[seed + 1..].iter());
        for ahead in [left.collect::<Vec<_>>(), right.collect()] {
            sums.fronts += f64::from(!ahead.is_empty());
            let mut last = 0;
            for first in ahead {
                let time = first.unwrap_or(end);
                let wait = time - last;
                sums.waited += f64::from(wait);
                if first.is_none() {
                    sums.standing += f64::from(wait > end / 2);
                    break;
                }
                sums.steps += 1.0;
                sums.short += f64::from(wait <= beat);
                last = time;
            }
        }
        sums
    }
}

/// Returns a share or a rate over all runs, with its error by the jackknife over runs.
pub(super) fn ratio_over_runs(runs: &[Fronts], parts: fn(&Fronts) -> [f64; 2]) -> Option<Estimate> {
    ratio(&runs.iter().map(parts).collect::<Vec<_>>())
}
