//! Computes flight in closed form, for methods that evaluate gaps at given times.

use super::forcing::{Component, Phases, phases};
use super::method::Task;
use crate::Error;
use crate::flight::{INFLATION, length};
use crate::impact::share_change;
use crate::search::clock::{Instant, Rate};
use crate::topology::Topology;

/// Width, in units of d, above which an opening gap that has just been hit may be below zero.
const ROUNDING: f64 = 1e-12;

/// Returns whether a gap of this width and rate is not below zero, or by rounding only, as one just
/// hit.
#[inline]
pub fn is_open(width: f64, rate: f64, spacing: f64) -> bool {
    width >= 0.0 || rate >= 0.0 && width >= -ROUNDING * spacing
}

pub struct GapState {
    pub width: f64,
    pub rate: f64,
}

/// The masses in flight: x_j = j d + a_j cos ωt + b_j sin ωt + forced response.
pub struct Flights {
    pub topology: Topology,
    pub spacing: f64,
    pub restitution: f64,
    /// The speed with which an impact opens its gap at least.
    pub least_rebound: f64,
    pub omega: f64,
    /// ω, in turns.
    turns: Rate,
    /// Free parts (a_j, b_j) of all bodies; 0 for the walls.
    pub free: Vec<[f64; 2]>,
    /// The responses to the components of the forcing.
    pub forced: Vec<Component>,
}

/// (sin, cos) of ωt and of each Ωt.
pub type FlightPhases = ((f64, f64), Phases);

impl Flights {
    pub fn new(Task { scenario, start, .. }: Task) -> Result<Flights, Error> {
        scenario.check_uniform()?;
        let u = start.displacements(scenario)?;
        let w = scenario.natural_frequency;
        let mut flights = Flights {
            topology: Topology::new(scenario.forcing.len(), scenario.boundary),
            spacing: scenario.spacing,
            restitution: scenario.restitution,
            least_rebound: 0.0,
            omega: w,
            turns: Rate::new(w),
            free: vec![[0.0; 2]; u.len()],
            forced: Component::responses(scenario),
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

    pub fn phases(&self, instant: Instant) -> FlightPhases {
        (self.turns.sin_cos(instant), phases(&self.forced, instant))
    }

    /// Returns the forced response of the right body less that of the left one, and its rate.
    fn response(&self, [left, right]: [usize; 2], phases: &FlightPhases) -> [f64; 2] {
        let [mut v, mut rate] = [0.0; 2];
        for (component, (sin, cos)) in self.forced.iter().zip(&phases.1) {
            let c = component.cos[right] - component.cos[left];
            let s = component.sin[right] - component.sin[left];
            v += c * cos + s * sin;
            rate += component.frequency * (s * cos - c * sin);
        }
        [v, rate]
    }

    pub fn gap_at(&self, k: usize, phases: &FlightPhases) -> GapState {
        let sides = self.topology.sides(k);
        let [free_left, free_right] = sides.map(|m| self.free[m]);
        let [a, b] = [free_right[0] - free_left[0], free_right[1] - free_left[1]];
        let (sin, cos) = phases.0;
        let [v, forced_rate] = self.response(sides, phases);
        let width = self.spacing + (a * cos + b * sin + v);
        let rate = self.omega * (b * cos - a * sin) + forced_rate;
        let width = if is_open(width, rate, self.spacing) { width.max(0.0) } else { width };
        GapState { width, rate }
    }

    /// Bounds how far gap k is from d, Σ R over its sinusoids, and its second derivative, Σ R Ω².
    pub fn bounds(&self, k: usize) -> [f64; 2] {
        let [left, right] = self.topology.sides(k);
        let [free_left, free_right] = [self.free[left], self.free[right]];
        let free = length([free_right[0] - free_left[0], free_right[1] - free_left[1]]);
        let (mut reach, mut curvature) = (free, self.omega * self.omega * free);
        for part in &self.forced {
            let [c, s] = [&part.cos, &part.sin].map(|of_bodies| of_bodies[right] - of_bodies[left]);
            let forced = length([c, s]);
            reach += forced;
            curvature += part.frequency * part.frequency * forced;
        }
        [INFLATION * reach, INFLATION * curvature]
    }

    /// Applies the impact law at gap k to the free parts. Returns the rate at which the gap opens.
    pub fn hit(&mut self, k: usize, speed: f64, phases: &FlightPhases) -> f64 {
        let rebound = (self.restitution * speed).max(self.least_rebound);
        let sides = self.topology.sides(k);
        let inverse = self.topology.inverse_masses(k);
        let (sin, cos) = phases.0;
        for (side, jump) in sides.into_iter().zip(share_change(speed + rebound, inverse)) {
            let kick = jump / self.omega;
            self.free[side][0] -= kick * sin;
            self.free[side][1] += kick * cos;
        }
        rebound
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_is_open_down_to_rounding_if_it_opens() {
        for (width, rate, spacing, expected) in [
            (0.0, -1.0, 1.0, true),
            (-0.9e-12, 0.0, 1.0, true),
            (-0.9e-12, -1e-3, 1.0, false),
            (-1.1e-12, 1.0, 1.0, false),
            (-1.1e-12, 1.0, 2.0, true),
        ] {
            assert_eq!(is_open(width, rate, spacing), expected, "{width}, {rate}, {spacing}");
        }
    }
}
