//! Holds the row of masses for integrators: displacements, velocities, forces, impact law.

use super::forcing::{Component, Phases, phases};
use super::method::Task;
use super::steps::Step;
use crate::Error;
use crate::scenario::COMPONENTS;
use crate::search::clock::{Instant, Rate};
use crate::topology::Topology;
use fearless_simd::{f64x8, prelude::*};

/// The bodies of a chain with state and forces, from the left wall (0) to the right one (n + 1).
pub struct Bodies {
    pub topology: Topology,
    pub spacing: f64,
    pub restitution: f64,
    /// The speed with which an impact opens its gap at least.
    pub least_rebound: f64,
    /// ω².
    pub stiffness: f64,
    forcing: Vec<Component>,
    /// Displacements from the places j d; 0 for the walls.
    pub u: Vec<f64>,
    /// Velocities; 0 for the walls.
    pub v: Vec<f64>,
    /// The phases at the end of the last step, and its length.
    pub phases: Phases,
    pub last: f64,
}

impl Bodies {
    pub fn new(Task { scenario, start, .. }: Task) -> Result<Bodies, Error> {
        scenario.check_uniform()?;
        let u = start.displacements(scenario)?;
        let masses = scenario.forcing.len();
        let forcing = Component::forces(scenario);
        let mut row = Bodies {
            topology: Topology::new(masses, scenario.boundary),
            spacing: scenario.spacing,
            restitution: scenario.restitution,
            least_rebound: 0.0,
            stiffness: scenario.natural_frequency * scenario.natural_frequency,
            phases: phases(&forcing, Instant::at(start.time)),
            forcing,
            v: vec![0.0; u.len()],
            u,
            last: 0.0,
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

    pub fn hit(&mut self, k: usize, speed: f64) {
        let [left, right] = self.topology.inverse_masses(k);
        let change = speed + (self.restitution * speed).max(self.least_rebound);
        push(&self.topology, k, change / (left + right), &mut self.v);
    }

    pub fn rates(&self) -> Vec<Rate> {
        self.forcing.iter().map(|component| component.rate).collect()
    }

    /// Returns the phases at the end of a step, filled up.
    #[inline(always)]
    pub fn phases_of(step: &Step) -> Phases {
        let mut phases = [(0.0, 1.0); COMPONENTS];
        phases[..step.phases.len()].copy_from_slice(step.phases);
        phases
    }

    /// Computes the accelerations in flight at displacements `u` and an instant; walls have none.
    pub fn accelerations(&self, instant: Instant, u: &[f64], accelerations: &mut [f64]) {
        for (acceleration, u) in accelerations.iter_mut().zip(u) {
            *acceleration = -self.stiffness * u;
        }
        for (component, (sin, cos)) in self.forcing.iter().zip(phases(&self.forcing, instant)) {
            add_forces(component, [cos, sin], accelerations);
        }
    }

    /// Makes a step of flight with all bodies: v' = `keep` v + `pull` u + forces, where `waves` has
    /// the factors of the amplitudes (cos, sin) of a component; then u' = u + `drift` (v, v').
    #[inline(always)]
    pub fn fly(
        &mut self,
        [keep, pull]: [f64; 2],
        waves: impl Fn(usize) -> [f64; 2],
        drift: [f64; 2],
    ) {
        let Bodies { u, v, forcing, .. } = self;
        step(u, v, &forcing[0], [keep, pull], waves(0), drift);
        for (i, component) in forcing.iter().enumerate().skip(1) {
            let [c, s] = waves(i);
            add_forces(component, [c, s], v);
            add_forces(component, [drift[1] * c, drift[1] * s], u);
        }
    }

    /// Makes a step of Verlet; between steps velocities are those half of the last step ago.
    #[inline(always)]
    pub fn leap(&mut self, step: &Step) {
        let (kick, phases) = (0.5 * (self.last + step.h), self.phases);
        let waves = |i: usize| [kick * phases[i].1, kick * phases[i].0];
        self.fly([1.0, -kick * self.stiffness], waves, [0.0, step.h]);
        (self.phases, self.last) = (Bodies::phases_of(step), step.h);
    }

    /// Returns the acceleration in flight of a body at the end of the last step.
    #[inline(always)]
    pub fn acceleration(&self, m: usize) -> f64 {
        let forces = self.forcing.iter().zip(&self.phases);
        let sum = forces.fold(0.0, |sum, (component, (sin, cos))| {
            sum + (component.cos[m] * cos + component.sin[m] * sin)
        });
        sum - self.stiffness * self.u[m]
    }

    /// Lists the gaps that are shut at displacements `u`, in their order.
    #[inline(always)]
    pub fn shut<S: Simd>(&self, simd: S, u: &[f64], shut: &mut Vec<usize>) {
        shut.clear();
        // Neighbours in the array are neighbours in the row; a ring has one gap more.
        let first = self.topology.sides(0)[0];
        let bodies = &u[first..u.len() - first];
        let gaps = bodies.len() - 1;
        let [left, right] = [&bodies[..gaps], &bodies[1..]].map(|x| x.chunks_exact(8));
        let rest = gaps - left.remainder().len();
        for (from, (left, right)) in (0..).step_by(8).zip(left.zip(right)) {
            let [left, right] = [left, right].map(|x| f64x8::from_slice(simd, x));
            let mut bits = ((right - left) + self.spacing).simd_le(0.0).to_bitmask();
            while bits != 0 {
                shut.push(from + bits.trailing_zeros() as usize);
                bits &= bits - 1;
            }
        }
        shut.extend((rest..gaps).filter(|&k| self.spacing + (bodies[k + 1] - bodies[k]) <= 0.0));
        if gaps < self.topology.gaps() && self.width_at(gaps, u) <= 0.0 {
            shut.push(gaps);
        }
    }

    pub fn masses(&self) -> u64 {
        self.u.len() as u64 - 2
    }
}

/// Adds the forces of a component, given the factors of its amplitudes.
#[inline(always)]
fn add_forces(component: &Component, [c, s]: [f64; 2], sums: &mut [f64]) {
    for (sum, (cos, sin)) in sums.iter_mut().zip(component.cos.iter().zip(&component.sin)) {
        *sum += c * cos + s * sin;
    }
}

/// One step of flight under one component, in a loop that the compiler turns into vectors.
#[inline(always)]
fn step(
    u: &mut [f64],
    v: &mut [f64],
    component: &Component,
    [keep, pull]: [f64; 2],
    [c, s]: [f64; 2],
    [before, after]: [f64; 2],
) {
    let amplitudes = component.cos.iter().zip(&component.sin);
    for ((u, v), (cos, sin)) in u.iter_mut().zip(v).zip(amplitudes) {
        let new = (keep * *v + pull * *u) + (c * cos + s * sin);
        *u += before * *v + after * new;
        *v = new;
    }
}

/// Changes velocities (or displacements) by an impulse (or that times a time) that opens gap k.
pub fn push(topology: &Topology, k: usize, impulse: f64, velocities: &mut [f64]) {
    let [left, right] = topology.sides(k);
    let [inverse_left, inverse_right] = topology.inverse_masses(k);
    velocities[left] -= impulse * inverse_left;
    velocities[right] += impulse * inverse_right;
}
