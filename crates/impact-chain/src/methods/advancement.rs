//! Conservative advancement.

use super::prelude::*;
use crate::search::earliest::Earliest;

/// Flight in closed form; each gap is advanced to where the parabola below it comes to zero, and no gap can close before.
/// The parabola has the width and the rate of the gap and a bound on its second derivative. The gap that is open for the
/// shortest time is looked at next, and is hit when it is closing and no wider than the tolerance.
///
/// - Source: Mirtich (1996), Impulse-based dynamic simulation of rigid body systems, thesis, University of California,
///   Berkeley; the queue of gaps is that of the engine.
/// - Order: none, it has no step. An impact is early by up to the tolerance over its closing speed.
/// - Fails: no zero is passed, but a gap that comes near to zero, to within the tolerance, is hit, also one that opens and
///   turns back within it; near a graze the steps get short; a chatter has infinitely many impacts in a finite time, and
///   there is no rest in contact: the bound on work ends the run there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advancement {
    /// Width of a closing gap, in units of d, at which it is hit.
    pub tolerance: f64,
}

impl Method for Advancement {
    fn name(&self) -> &'static str {
        "advancement"
    }

    fn run(&self, (scenario, start, until): Task, sink: Sink) -> Result<Cost, Error> {
        let flights = Flights::new(scenario, start)?;
        check_tolerance(self.tolerance)?;
        check_end(until)?;
        let gaps = flights.topology.gaps();
        let mut queue = Earliest::new(gaps);
        (0..gaps).for_each(|k| queue.set(k, [Instant::at(start.time)]));
        let mut run = Run { flights, queue, reached: self.tolerance * scenario.spacing };
        let mut tally = Tally::new(scenario, sink);
        let ended = run.advance(Instant::at(until), &mut tally);
        tally.finish(ended)
    }
}

/// The shortest advance, without which a gap that is shut and at rest would not go on.
const LEAST: f64 = 1e-18;

struct Run {
    flights: Flights,
    /// For each gap the time up to which it is certainly open.
    queue: Earliest,
    /// Width at which a closing gap is hit.
    reached: f64,
}

impl Run {
    fn advance(&mut self, end: Instant, tally: &mut Tally) -> Result<(), Stop> {
        loop {
            let (k, now) = self.queue.first();
            if now > end {
                return Ok(());
            }
            tally.step()?;
            tally.cost.evaluations += 1;
            let phases = self.flights.phases(now);
            let mut look = self.flights.look(k, 0.0, &phases);
            if look.width <= self.reached && look.rate < 0.0 {
                let speed = -look.rate;
                self.flights.hit(k, speed, &phases);
                look.rate = self.flights.restitution * speed;
                let [left, right] = self.flights.topology.adjacent(k);
                for j in [left, right.filter(|right| Some(*right) != left)].into_iter().flatten() {
                    tally.cost.evaluations += 1;
                    let beside = self.flights.look(j, 0.0, &phases);
                    self.open(j, now, beside);
                }
                self.open(k, now, look);
                tally.impact(k, now.time(), speed)?;
            } else {
                // So near to zero the number of looks has no bound.
                if look.width <= self.reached {
                    tally.spend(k, now.time())?;
                }
                self.open(k, now, look);
            }
        }
    }

    /// Advances gap k from now to the zero of f + g s − b s²/2, with a bound b on its second derivative.
    fn open(&mut self, k: usize, now: Instant, Look { width, rate, .. }: Look) {
        let (f, b) = (width.max(0.0), self.flights.bend(k));
        let root = (rate * rate + 2.0 * b * f).sqrt();
        let s = if rate < 0.0 { 2.0 * f / (root - rate) } else { (rate + root) / b };
        // A gap that never moves has no zero.
        let s = if s.is_nan() { LATEST } else { s.clamp(LEAST, LATEST) };
        self.queue.set(k, [now.after(s)]);
    }
}
