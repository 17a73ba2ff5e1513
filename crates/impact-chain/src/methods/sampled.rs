//! Simulates by sampling gaps on a grid of times, and bisection.

use super::flights::{Flights, GapState};
use super::method::Task;
use super::rival::{Rival, Run, Stepper, run_steps};
use super::sign_change::closing_time;
use super::steps::Step;
use super::tally::{Stop, Tally};
use crate::Error;
use crate::search::clock::Instant;

/// Flight in closed form; every gap is sampled with a fixed step, and a change of its sign is
/// bisected down to neighbouring doubles.
///
/// - Source: the bracketing and bisection of every textbook (Press et al., Numerical Recipes, sec.
///   9.1); simulations of impacting oscillators are mostly written so.
/// - Order: none; an impact that is found is accurate to rounding, and the step decides whether it
///   is found.
/// - Fails: two roots within a step leave no change of sign, so grazes and short dips are missed,
///   of depth up to |Δ''| h²/8; three are taken for one, often the wrong one. A chatter has
///   infinitely many impacts in a finite time: the bound on work ends the run there,
///   unless a least rebound speed is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// Time h between two samples.
    pub step: f64,
    /// No impact leaves a gap opening more slowly.
    pub stop: f64,
}

impl Rival for Sampled {
    const NAME: &'static str = "sampled";

    fn begin(&self, task: Task) -> Result<Run, Error> {
        let mut flights = Flights::new(task)?;
        flights.stop = self.stop;
        let phases = flights.phases(Instant::at(task.1.time));
        let gaps = flights.topology.gaps();
        let begin = (0..gaps).map(|k| flights.gap_at(k, 0.0, &phases)).collect();
        let samples = Samples { flights, begin, end: Vec::new(), roots: vec![None; gaps] };
        let (stop, run) = (self.stop, run_steps(task, self.step, samples)?);
        Ok(Box::new(move |tally| {
            tally.stopping_at(stop);
            tally.cost.evaluations += gaps as u64;
            run(tally)
        }))
    }
}

struct Samples {
    flights: Flights,
    /// Gaps at the beginning of the step, or right after the last impact at or next to the gap.
    begin: Vec<GapState>,
    end: Vec<GapState>,
    /// The times between at which gaps close.
    roots: Vec<Option<f64>>,
}

impl Stepper for Samples {
    fn step(&mut self, step: &Step, tally: &mut Tally) -> Result<(), Stop> {
        let last = self.flights.phases_within(step, step.h);
        let gaps = self.begin.len();
        self.end.clear();
        self.end.extend((0..gaps).map(|k| self.flights.gap_at(k, step.h, &last)));
        tally.cost.evaluations += gaps as u64;
        for k in 0..gaps {
            self.roots[k] = self.locate(k, step, tally);
        }
        while let Some((k, s)) = self.earliest() {
            let flights = &mut self.flights;
            let phases = flights.phases_within(step, s);
            let time = step.from.after(s).time();
            let before = flights.gap_at(k, s, &phases);
            let speed = (-before.rate).max(0.0);
            let rate = flights.hit(k, speed, &phases);
            self.begin[k] = GapState { s, width: 0.0, rate };
            let near = flights.topology.near(k);
            for j in near.clone() {
                self.begin[j] = flights.gap_at(j, s, &phases);
            }
            for j in std::iter::once(k).chain(near) {
                self.end[j] = self.flights.gap_at(j, step.h, &last);
                tally.cost.evaluations += 2;
                self.roots[j] = self.locate(j, step, tally);
            }
            tally.event(k, time, speed)?;
        }
        for (begin, end) in self.begin.iter_mut().zip(&self.end) {
            *begin = GapState { s: 0.0, ..*end };
        }
        Ok(())
    }
}

impl Samples {
    /// Returns the time in the step at which gap k comes to zero, none if it changes no sign.
    fn locate(&self, k: usize, step: &Step, tally: &mut Tally) -> Option<f64> {
        let (from, to) = (self.begin[k], self.end[k]);
        if to.width >= 0.0 {
            return None;
        }
        Some(closing_time(from.s, to.s, from.width, |s| {
            tally.cost.evaluations += 1;
            self.flights.gap_at(k, s, &self.flights.phases_within(step, s)).width
        }))
    }

    /// Returns the gap that closes first, the lowest of several, and the time; none if none does.
    fn earliest(&self) -> Option<(usize, f64)> {
        let found = self.roots.iter().enumerate().filter_map(|(k, s)| Some((k, (*s)?)));
        found.reduce(|best, next| if next.1 < best.1 { next } else { best })
    }
}
