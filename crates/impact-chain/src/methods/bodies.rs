//! Holds the row of masses for integrators: displacements, velocities, forces, impact law.

use super::method::{Cost, Task};
use super::steps::{Step, steps};
use super::tally::{Stop, Tally};
use crate::forcing::Component;
use crate::impact::jumps;
use crate::search::clock::Instant;
use crate::topology::Topology;
use crate::{Boundary, Error, Scenario, Sink, State};

/// The bodies of a chain with their state and forces; bodies are numbered from the left wall (0) to
/// the right one (n + 1).
pub struct Bodies {
    pub topology: Topology,
    is_ring: bool,
    pub spacing: f64,
    pub restitution: f64,
    /// ω².
    pub stiffness: f64,
    forcing: Vec<Component>,
    /// Displacements from the places j d; 0 for the walls.
    pub u: Vec<f64>,
    /// Velocities; 0 for the walls.
    pub v: Vec<f64>,
}

impl Bodies {
    pub fn new(scenario: &Scenario, start: &State) -> Result<Bodies, Error> {
        scenario.check_uniform()?;
        let u = start.displacements(scenario)?;
        let masses = scenario.forcing.len();
        let mut row = Bodies {
            topology: Topology::new(masses, scenario.boundary),
            is_ring: scenario.boundary == Boundary::Ring,
            spacing: scenario.spacing,
            restitution: scenario.restitution,
            stiffness: scenario.natural_frequency * scenario.natural_frequency,
            forcing: Component::forces(scenario),
            v: vec![0.0; u.len()],
            u,
        };
        row.v[1..=masses].copy_from_slice(&start.velocities);
        Ok(row)
    }

    #[inline]
    pub fn width_at(&self, k: usize, u: &[f64]) -> f64 {
        let [left, right] = self.topology.sides(k);
        self.spacing + (u[right] - u[left])
    }

    #[inline]
    pub fn width(&self, k: usize) -> f64 {
        self.width_at(k, &self.u)
    }

    #[inline]
    pub fn rate(&self, k: usize) -> f64 {
        let [left, right] = self.topology.sides(k);
        self.v[right] - self.v[left]
    }

    /// Applies an impulse P ≥ 0 that opens gap k, for masses 1/`lightness`.
    #[inline]
    pub fn push(&mut self, k: usize, impulse: f64, lightness: f64) {
        let [left, right] = self.topology.sides(k);
        let [inverse_left, inverse_right] = self.topology.inverse_masses(k);
        self.v[left] -= impulse * inverse_left * lightness;
        self.v[right] += impulse * inverse_right * lightness;
    }

    /// Applies the impact law at gap k.
    pub fn hit(&mut self, k: usize, speed: f64) {
        let [left, right] = self.topology.sides(k);
        let jumps = jumps(speed, self.restitution, self.topology.inverse_masses(k));
        self.v[left] += jumps[0];
        self.v[right] += jumps[1];
    }

    pub fn forces(&self, at: Instant, out: &mut [f64]) {
        for (i, component) in self.forcing.iter().enumerate() {
            let (sin, cos) = component.phase(at);
            let amplitudes = component.cos.iter().zip(&component.sin);
            for (out, (alpha, beta)) in out.iter_mut().zip(amplitudes) {
                let force = alpha * cos + beta * sin;
                *out = if i == 0 { force } else { *out + force };
            }
        }
    }

    /// Computes the accelerations in flight at displacements `u` and an instant. The walls have
    /// none.
    pub fn accelerations(&self, at: Instant, u: &[f64], out: &mut [f64]) {
        self.forces(at, out);
        for (out, u) in out.iter_mut().zip(u) {
            *out -= self.stiffness * u;
        }
    }

    /// Whether any gap would be shut after a time `ahead` at its present rate. The test is cheap,
    /// as it mostly fails.
    pub fn any_shut(&self, ahead: f64) -> bool {
        let (u, v) = (&self.u, &self.v);
        let is_shut =
            |u: [f64; 2], v: [f64; 2]| self.spacing + (u[1] - u[0]) + ahead * (v[1] - v[0]) <= 0.0;
        // Neighbours in the array are neighbours in the row; a ring has one gap more.
        let (first, last) = if self.is_ring { (1, u.len() - 2) } else { (0, u.len() - 1) };
        let mut any = self.is_ring && is_shut([u[last], u[first]], [v[last], v[first]]);
        for (u, v) in u[first..=last].windows(2).zip(v[first..=last].windows(2)) {
            any |= is_shut([u[0], u[1]], [v[0], v[1]]);
        }
        any
    }

    /// Returns the number of masses, the unit of counted work.
    pub fn masses(&self) -> u64 {
        self.u.len() as u64 - 2
    }
}

/// A method with a fixed step.
pub trait Stepper {
    /// Advances the row by one step and hands its impacts to the tally.
    fn step(&mut self, row: &mut Bodies, step: &Step, tally: &mut Tally) -> Result<(), Stop>;
}

/// Runs a method with a fixed step, made by `begin` from the start.
pub fn run_steps<S: Stepper>(
    (scenario, start, until): Task,
    step: f64,
    sink: Sink,
    begin: impl FnOnce(&Bodies) -> S,
) -> Result<Cost, Error> {
    let mut row = Bodies::new(scenario, start)?;
    let mut steps = steps(scenario, start, until, step)?;
    let mut tally = Tally::new(scenario, sink);
    let mut stepper = begin(&row);
    let ended = steps.try_for_each(|step| {
        tally.cost.steps += 1;
        stepper.step(&mut row, &step, &mut tally)
    });
    tally.finish(ended)
}
