//! Flight in closed form, for methods that evaluate gaps at given times.

use super::forcing::{COMPONENTS, Component};
use super::prelude::*;
use crate::flight::INFLATION;

/// Width and rate of a gap, `s` after the beginning of a step.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    pub s: f64,
    pub width: f64,
    pub rate: f64,
}

/// The masses in flight: x_j = j d + a_j cos ωt + b_j sin ωt + forced response.
pub struct Flights {
    pub topology: Topology,
    spacing: f64,
    pub restitution: f64,
    omega: f64,
    rate: Rate,
    /// Free parts (a_j, b_j) of all bodies; 0 for the walls.
    free: Vec<[f64; 2]>,
    forced: Vec<Component>,
}

/// (sin, cos) of ωt and of each Ωt.
pub type Phases = ((f64, f64), [(f64, f64); COMPONENTS]);

impl Flights {
    pub fn new(scenario: &Scenario, start: &State) -> Result<Flights, Error> {
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

    pub fn phases(&self, at: Instant) -> Phases {
        let mut forced = [(0.0, 1.0); COMPONENTS];
        for (phase, component) in forced.iter_mut().zip(&self.forced) {
            *phase = component.phase(at);
        }
        (sin_cos_turn(self.rate.turn(at)), forced)
    }

    /// The phases `s` after the beginning of a step.
    pub fn phases_in(&self, step: &Step, s: f64) -> Phases {
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
    pub fn look(&self, k: usize, s: f64, phases: &Phases) -> Look {
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

    /// A bound on the second derivative of gap k: Σ R Ω² over its sinusoids of amplitude R, its free part among them.
    pub fn bend(&self, k: usize) -> f64 {
        let [left, right] = self.topology.sides(k);
        let length = |x: f64, y: f64| (x * x + y * y).sqrt();
        let [of_left, of_right] = [self.free[left], self.free[right]];
        let free = length(of_right[0] - of_left[0], of_right[1] - of_left[1]);
        let forced = self.forced.iter().map(|part| {
            let [c, s] =
                [&part.cos, &part.sin].map(|amplitudes| amplitudes[right] - amplitudes[left]);
            part.frequency * part.frequency * length(c, s)
        });
        INFLATION * (self.omega * self.omega * free + forced.sum::<f64>())
    }

    /// The impact law at gap k: a jump of velocity only rotates into the free part.
    pub fn hit(&mut self, k: usize, speed: f64, phases: &Phases) {
        let sides = self.topology.sides(k);
        let inverse = self.topology.inverse_masses(k);
        let (sin, cos) = phases.0;
        for (side, jump) in sides.into_iter().zip(jumps(speed, self.restitution, inverse)) {
            let kick = jump / self.omega;
            self.free[side][0] -= kick * sin;
            self.free[side][1] += kick * cos;
        }
    }
}
