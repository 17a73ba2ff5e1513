//! Simulates by conservative advancement.

use super::flights::{Flights, GapState};
use super::method::Task;
use super::rival::{Rival, Run, Stop, Tally};
use super::steps::check_tolerance;
use crate::Error;
use crate::search::clock::{Instant, LATEST};
use crate::search::earliest::Earliest;

/// Conservative advancement: flight in closed form; each gap is advanced to where the parabola
/// below it comes to zero, and no gap can close before. The parabola has the width and the rate of
/// the gap and a bound on its second derivative. The gap that is certainly open for the shortest
/// time is evaluated next, and is hit when it is closing and no wider than the tolerance.
///
/// - Source: Mirtich (1996), Impulse-based dynamic simulation of rigid body systems, thesis,
///   University of California, Berkeley; the queue of gaps is that of the engine.
/// - Order: none, it has no step. An impact is early by up to the tolerance over its closing speed.
/// - Fails: no zero is passed, but a gap that comes within the tolerance of zero is hit, also one
///   that opens and turns back within it; near a graze the steps get short; a chatter has
///   infinitely many impacts in a finite time, and there is no rest in contact: the bound on work
///   ends the run there, unless a least rebound speed is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advancement {
    /// Width of a closing gap, in units of d, at which it is hit.
    pub tolerance: f64,
    /// The speed with which an impact opens its gap at least.
    pub least_rebound: f64,
}

impl Rival for Advancement {
    const NAME: &'static str = "advancement";

    fn begin(&self, task: Task) -> Result<Run, Error> {
        let Task { scenario, start, until } = task;
        let mut flights = Flights::new(task)?;
        flights.least_rebound = self.least_rebound;
        check_tolerance(self.tolerance)?;
        let gaps = flights.topology.gaps();
        let mut queue = Earliest::new(gaps);
        for k in 0..gaps {
            queue.set(k, [Instant::at(start.time)]);
        }
        let mut gaps = Gaps { flights, queue, reached: self.tolerance * scenario.spacing };
        Ok(Box::new(move |tally| {
            tally.limit_chatter(gaps.flights.least_rebound);
            gaps.advance(Instant::at(until), tally)
        }))
    }
}

/// The shortest advance, without which a gap that is shut and at rest would stay at one instant.
const SHORTEST: f64 = 1e-18;

struct Gaps {
    flights: Flights,
    /// The time up to which each gap is certainly open.
    queue: Earliest,
    reached: f64,
}

impl Gaps {
    fn advance(&mut self, end: Instant, tally: &mut Tally) -> Result<(), Stop> {
        loop {
            let (k, now) = self.queue.first();
            if now > end {
                return Ok(());
            }
            tally.step()?;
            tally.cost.evaluations += 1;
            let phases = self.flights.phases(now);
            let mut gap = self.flights.gap_at(k, &phases);
            if gap.width <= self.reached && gap.rate < 0.0 {
                let speed = -gap.rate;
                gap.rate = self.flights.hit(k, speed, &phases);
                for j in self.flights.topology.near(k) {
                    tally.cost.evaluations += 1;
                    let neighbour = self.flights.gap_at(j, &phases);
                    self.advance_gap(j, now, neighbour);
                }
                tally.impact(k, now.time(), speed)?;
            } else if gap.width <= self.reached {
                // So near to zero the number of evaluations has no bound.
                tally.spend(k, now.time())?;
            }
            self.advance_gap(k, now, gap);
        }
    }

    /// Advances gap k from now to the zero of f + g s − b s²/2, with a bound b on its second
    /// derivative; for ever if its amplitudes add up to less than d, until an impact next to it.
    fn advance_gap(&mut self, k: usize, now: Instant, GapState { width, rate, .. }: GapState) {
        let [reach, bend] = self.flights.bounds(k);
        let is_safe = reach + self.reached < self.flights.spacing;
        let s = if is_safe { LATEST } else { certainly_open(width.max(0.0), rate, bend) };
        self.queue.set(k, [now.after(s.clamp(SHORTEST, LATEST))]);
    }
}

/// Returns the zero s ≥ 0 of f + g s − b s²/2 for a width f ≥ 0, without cancellation.
fn certainly_open(f: f64, g: f64, b: f64) -> f64 {
    let root = (g * g + 2.0 * b * f).sqrt();
    if g < 0.0 { 2.0 * f / (root - g) } else { (g + root) / b }
}

#[cfg(test)]
mod tests {
    use super::certainly_open;

    #[test]
    fn zeros_of_parabolas_do_not_cancel() {
        for (f, g, b, s) in [
            (1e-20, -1.0, 1.0, 1e-20),
            (3.5, -1.0, 2.0, 1.436_491_673_103_708_5),
            (0.0, 3.0, 2.0, 3.0),
        ] {
            let off = certainly_open(f, g, b) / s - 1.0;
            assert!(off.abs() < 1e-15, "{f}, {g}, {b}: {off:e}");
        }
    }
}
