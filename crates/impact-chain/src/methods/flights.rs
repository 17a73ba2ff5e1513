//! Flight in closed form, looked at on a grid of times: what the sampling rivals share.

use super::crossing::is_rounding;
use super::forcing::{COMPONENTS, Component};
use super::tally::{Grid, Step, Stop, Tally};
use super::{Cost, State};
use crate::impact::jumps;
use crate::topology::Topology;
use crate::{Error, Impact, Scenario};
use impact_numerics::clock::{Instant, Rate};
use impact_numerics::trig::sin_cos_turn;

/// Width and rate of a gap, `s` after the beginning of a step.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    pub s: f64,
    pub width: f64,
    pub rate: f64,
}

/// How a method finds the time within a step at which a gap closes.
pub trait Locate {
    /// The time s after the beginning of the step at which the gap comes to zero, from < s ≤ to, if
    /// the method finds one. Right after an impact `from` has the width 0 exactly.
    fn locate(&self, from: Look, to: Look, at: impl FnMut(f64) -> Look) -> Option<f64>;
}

/// The masses in flight: x_j = j d + a_j cos ωt + b_j sin ωt + forced response.
struct Flights {
    topology: Topology,
    spacing: f64,
    restitution: f64,
    omega: f64,
    rate: Rate,
    /// Free parts (a_j, b_j) of all bodies; 0 for the walls.
    free: Vec<[f64; 2]>,
    forced: Vec<Component>,
}

/// (sin, cos) of ωt and of each Ωt.
type Phases = ((f64, f64), [(f64, f64); COMPONENTS]);

impl Flights {
    /// # Errors
    /// As [`super::Method::run`].
    fn new(scenario: &Scenario, start: &State) -> Result<Flights, Error> {
        let u = start.displacements(scenario)?;
        let w = scenario.natural_frequency;
        let mut flights = Flights {
            topology: Topology::new(scenario.forcing.len(), scenario.boundary),
            spacing: scenario.spacing,
            restitution: scenario.restitution,
            omega: w,
            rate: Rate::new(w),
            free: vec![[0.0; 2]; u.len()],
            forced: Component::response(scenario),
        };
        let phases = flights.phases(Instant::at(start.time));
        let (sin, cos) = phases.0;
        for (j, v) in start.velocities.iter().enumerate() {
            let [forced, rate] = flights.response([0, j + 1], &phases);
            let (u, quadrature) = (u[j + 1] - forced, (v - rate) / w);
            flights.free[j + 1] = [u * cos - quadrature * sin, u * sin + quadrature * cos];
        }
        Ok(flights)
    }

    fn phases(&self, at: Instant) -> Phases {
        let mut forced = [(0.0, 1.0); COMPONENTS];
        for (phase, component) in forced.iter_mut().zip(&self.forced) {
            *phase = component.phase(at);
        }
        (sin_cos_turn(self.rate.turn(at)), forced)
    }

    /// The phases `s` after the beginning of a step.
    fn phases_in(&self, step: &Step, s: f64) -> Phases {
        self.phases(if s == step.h { step.to } else { step.from.after(s) })
    }

    /// The forced response of the right one of two bodies less that of the left one, and its rate.
    fn response(&self, [left, right]: [usize; 2], phases: &Phases) -> [f64; 2] {
        let [mut v, mut rate] = [0.0; 2];
        for (component, (sin, cos)) in self.forced.iter().zip(&phases.1) {
            let of = |amplitudes: &[f64]| amplitudes[right] - amplitudes[left];
            let [c, s] = [of(&component.cos), of(&component.sin)];
            v += c * cos + s * sin;
            rate += component.frequency * (s * cos - c * sin);
        }
        [v, rate]
    }

    /// Gap k at a time whose phases are given.
    fn look(&self, k: usize, s: f64, phases: &Phases) -> Look {
        let sides = self.topology.sides(k);
        let [of_left, of_right] = sides.map(|m| self.free[m]);
        let [a, b] = [of_right[0] - of_left[0], of_right[1] - of_left[1]];
        let (sin, cos) = phases.0;
        let [v, forced_rate] = self.response(sides, phases);
        let width = self.spacing + (a * cos + b * sin + v);
        let rate = self.omega * (b * cos - a * sin) + forced_rate;
        let width = if is_rounding(width, rate, self.spacing) { 0.0 } else { width };
        Look { s, width, rate }
    }

    /// The impact law at gap k: a jump of velocity only rotates into the free part.
    fn hit(&mut self, k: usize, speed: f64, phases: &Phases) {
        let sides = self.topology.sides(k);
        let inverse = sides.map(|m| self.topology.inverse_mass(m));
        let (sin, cos) = phases.0;
        for (side, jump) in sides.into_iter().zip(jumps(speed, self.restitution, inverse)) {
            let kick = jump / self.omega;
            self.free[side][0] -= kick * sin;
            self.free[side][1] += kick * cos;
        }
    }
}

/// Samples all gaps with a fixed step; in each step the earliest time that `method` locates is an
/// impact, until it locates no more.
pub fn run_samples(
    method: &impl Locate,
    (scenario, start): (&Scenario, &State),
    until: f64,
    step: f64,
    sink: &mut dyn FnMut(Impact) -> bool,
) -> Result<Cost, Error> {
    let mut flights = Flights::new(scenario, start)?;
    let grid = Grid::new(scenario, start, until, step)?;
    let mut tally = Tally::new(scenario, sink);
    let gaps = flights.topology.gaps();
    let phases = flights.phases(Instant::at(start.time));
    let begin = (0..gaps).map(|k| flights.look(k, 0.0, &phases)).collect();
    tally.cost.evaluations += gaps as u64;
    let mut samples = Samples { begin, end: Vec::new(), roots: vec![None; gaps] };
    let ended = grid.steps().try_for_each(|step| {
        tally.cost.steps += 1;
        samples.step(method, &mut flights, &step, &mut tally)
    });
    tally.finish(ended)
}

/// All gaps in one step.
struct Samples {
    /// At the beginning of the step, or right after the last impact beside the gap.
    begin: Vec<Look>,
    /// At the end of the step.
    end: Vec<Look>,
    /// When the gap closes between.
    roots: Vec<Option<f64>>,
}

impl Samples {
    fn step(
        &mut self,
        method: &impl Locate,
        flights: &mut Flights,
        step: &Step,
        tally: &mut Tally,
    ) -> Result<(), Stop> {
        let last = flights.phases_in(step, step.h);
        let gaps = self.begin.len();
        self.end.clear();
        self.end.extend((0..gaps).map(|k| flights.look(k, step.h, &last)));
        tally.cost.evaluations += gaps as u64;
        for k in 0..gaps {
            self.roots[k] = self.locate(k, method, flights, step, tally);
        }
        while let Some((k, s)) = self.earliest() {
            let phases = flights.phases_in(step, s);
            let time = step.from.after(s).time();
            let before = flights.look(k, s, &phases);
            let speed = (-before.rate).max(0.0);
            flights.hit(k, speed, &phases);
            self.begin[k] = Look { s, width: 0.0, rate: flights.restitution * speed };
            let [left, right] = flights.topology.adjacent(k);
            let near = [left, right.filter(|right| Some(*right) != left)];
            for j in near.into_iter().flatten() {
                self.begin[j] = flights.look(j, s, &phases);
            }
            for j in [Some(k)].into_iter().chain(near).flatten() {
                self.end[j] = flights.look(j, step.h, &last);
                tally.cost.evaluations += 2;
                self.roots[j] = self.locate(j, method, flights, step, tally);
            }
            // A gap that stands still at zero is no impact, but it is work: it may do so for ever.
            if speed > 0.0 {
                tally.impact(k, time, speed)?;
            } else {
                tally.spend(k, time)?;
            }
        }
        for (begin, end) in self.begin.iter_mut().zip(&self.end) {
            *begin = Look { s: 0.0, ..*end };
        }
        Ok(())
    }

    fn locate(
        &self,
        k: usize,
        method: &impl Locate,
        flights: &Flights,
        step: &Step,
        tally: &mut Tally,
    ) -> Option<f64> {
        method.locate(self.begin[k], self.end[k], |s| {
            tally.cost.evaluations += 1;
            flights.look(k, s, &flights.phases_in(step, s))
        })
    }

    /// The gap that closes first, the lowest of equals.
    fn earliest(&self) -> Option<(usize, f64)> {
        let found = self.roots.iter().enumerate().filter_map(|(k, s)| Some((k, (*s)?)));
        found.reduce(|best, next| if next.1 < best.1 { next } else { best })
    }
}
