//! How fronts advance: how long they stand before a gap.
//!
//! Ahead of a front no mass was ever hit, and no gap closes by itself there. So a front takes one gap after the
//! other, and between two first impacts it waits for the gap ahead. A wait ends with a step or is cut off by the
//! end of the run; a front at a wall has no wait any more.

use super::run::Trace;
use crate::experiments::prelude::*;
use crate::params::SeedsParams;
use impact_numerics::estimates::ratio;
use std::f64::consts::TAU;

/// What the fronts of one run did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Waits {
    /// Fronts: sides of a seed that is not at the wall there.
    pub fronts: u64,
    /// Waits that ended with a step, in ticks.
    pub ended: Vec<usize>,
    /// Waits that the end of the run cut off, in ticks.
    pub cut: Vec<usize>,
}

/// The fronts of all runs at one σ; errors are by the jackknife over runs.
pub(super) struct Fronts<'a> {
    pub parameters: &'a SeedsParams,
    pub runs: Vec<Waits>,
}

/// The time 2π/|Ω − ω| after which a free and a forced motion meet again in any relation that they had: what can
/// be passed at all with the motions at hand is passed by then, as a rule.
pub fn beat(chain: &Chain) -> f64 {
    TAU / (chain.forcing_frequency - chain.natural_frequency).abs()
}

impl Waits {
    /// Of a run and its seed.
    pub(super) fn of(parameters: &SeedsParams, (seed, trace): (usize, &Trace)) -> Self {
        let mut waits = Waits::default();
        waits.follow(parameters, (0..seed).rev().map(|gap| trace.firsts[gap]));
        waits.follow(parameters, (seed + 1..trace.firsts.len()).map(|gap| trace.firsts[gap]));
        waits
    }

    /// Counts one front, from the ticks of the first impacts at the gaps ahead of it.
    fn follow(
        &mut self,
        parameters: &SeedsParams,
        ahead: impl ExactSizeIterator<Item = Option<u32>>,
    ) {
        self.fronts += u64::from(ahead.len() > 0);
        let mut at = 0;
        for first in ahead {
            let Some(tick) = first else {
                self.cut.push(parameters.ticks() - at);
                break;
            };
            self.ended.push(tick as usize - at);
            at = tick as usize;
        }
    }

    pub(super) fn steps(&self) -> u64 {
        self.ended.len() as u64
    }
}

impl Fronts<'_> {
    fn ratio(&self, of: impl Fn(&Waits) -> [u64; 2]) -> Option<Estimate> {
        let pairs = self.runs.iter().map(|run| of(run).map(|n| n as f64));
        ratio(&pairs.collect::<Vec<_>>())
    }

    /// Gaps in a unit of time, as long as there is a gap ahead: steps over the time of all waits.
    pub fn speed(&self) -> Option<Estimate> {
        let tick = self.parameters.tick;
        let time = |run: &Waits| run.ended.iter().chain(&run.cut).sum::<usize>() as f64 * tick;
        let pairs = self.runs.iter().map(|run| [run.steps() as f64, time(run)]);
        ratio(&pairs.collect::<Vec<_>>())
    }

    /// Share of the steps after a wait of at most one beat.
    pub fn bursts(&self) -> Option<Estimate> {
        let beat = (beat(&self.parameters.chain) / self.parameters.tick) as usize;
        let short = |run: &Waits| run.ended.iter().filter(|wait| **wait <= beat).count() as u64;
        self.ratio(|run| [short(run), run.steps()])
    }

    /// What it would be for waits with a constant hazard and the same speed.
    pub fn even(&self) -> f64 {
        let beat = beat(&self.parameters.chain);
        self.speed().map_or(0.0, |speed| -pxfm::f_expm1(-speed.value * beat))
    }

    /// Share of the fronts that have stood for the second half of the run when it ends.
    pub fn standing(&self) -> Option<Estimate> {
        let half = self.parameters.ticks() / 2;
        let long = |run: &Waits| run.cut.iter().filter(|wait| **wait > half).count() as u64;
        self.ratio(|run| [long(run), run.fronts])
    }
}
