//! Integrates by Verlet with a flip of velocities, in double or in single precision.

use super::method::Task;
use super::rival::{Rival, Run, Stepper, run_steps};
use super::steps::Step;
use super::tally::{Stop, Tally};
use crate::forcing::Component;
use crate::impact::jumps;
use crate::search::clock::Instant;
use crate::topology::Topology;
use crate::{Boundary, Error};
use fearless_simd::{Simd, SimdFloat, SimdFloatElement, prelude::*};

/// Velocity Verlet; at the end of a step each gap that is negative and closing, from the left, gets
/// the impact law.
///
/// - Source: Verlet (1967), Phys. Rev. 159, 98, in the form of Swope et al. (1982), J. Chem. Phys.
///   76, 637; the flip is common in simulations for pictures and games.
/// - Order: 2 in flight, 1 as soon as there is an impact, whose time is late by up to a step.
/// - Fails: each impact is late by half a step in the mean, and the way back takes as long, so that
///   the delays of all impacts add up; grazes and near misses are decided by the error of flight,
///   and a dip that opens again within a step is missed (tunnelling); overlaps of up to a step
///   times the speed stay, and r < 1 takes its part of the wrong energy there; a gap pressed shut
///   is flipped, and counted, again and again. With r = 1 and no forcing the energy is kept: flips
///   only exchange it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verlet {
    /// Length h of a step.
    pub step: f64,
}

impl Rival for Verlet {
    const NAME: &'static str = "verlet";

    fn begin(&self, task: Task) -> Result<Run, Error> {
        begin::<f64>(task, self.step)
    }
}

/// [`Verlet`] with displacements, velocities and forces in single precision: for means, where the
/// orbit is lost after a few impacts anyway, and twice as many masses fill a register.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VerletSingle {
    /// Length h of a step.
    pub step: f64,
}

impl Rival for VerletSingle {
    const NAME: &'static str = "verlet-single";

    fn begin(&self, task: Task) -> Result<Run, Error> {
        begin::<f32>(task, self.step)
    }
}

/// A number of one of the precisions, and the vectors of a processor that hold such numbers.
trait Real: SimdFloatElement + PartialOrd + Into<f64> + 'static {
    type Lanes<S: Simd>: SimdFloat<S, Element = Self>;

    fn of(x: f64) -> Self;
}

impl Real for f64 {
    type Lanes<S: Simd> = S::f64s;

    fn of(x: f64) -> f64 {
        x
    }
}

impl Real for f32 {
    type Lanes<S: Simd> = S::f32s;

    fn of(x: f64) -> f32 {
        x as f32
    }
}

/// Bodies in a word of bits; a multiple of the numbers in a register.
const WORD: usize = 64;

struct Flip<T> {
    topology: Topology,
    ring: bool,
    spacing: f64,
    restitution: f64,
    stiffness: f64,
    masses: usize,
    /// Displacements and velocities of the bodies; 0 for walls and what fills the last register.
    u: Vec<T>,
    v: Vec<T>,
    /// Amplitudes of cosine and sine of each component.
    forces: Vec<[Vec<T>; 2]>,
    /// Phases at the end of the last step, and its length.
    phases: Vec<(f64, f64)>,
    last: f64,
    /// A bit for each body whose gap to the next is negative.
    shut: Vec<u64>,
}

fn begin<T: Real>(task: Task, h: f64) -> Result<Run, Error> {
    let (scenario, start, _) = task;
    scenario.check_uniform()?;
    let u = start.displacements(scenario)?;
    let masses = scenario.forcing.len();
    // One more than a register at the end: each body is compared with the next.
    let length = u.len().next_multiple_of(16) + 16;
    let filled = |values: &[f64]| {
        let mut all = vec![T::of(0.0); length];
        all.iter_mut().zip(values).for_each(|(all, x)| *all = T::of(*x));
        all
    };
    let forcing = Component::forces(scenario);
    let begin = Instant::at(start.time);
    let flip = Flip {
        topology: Topology::new(masses, scenario.boundary),
        ring: scenario.boundary == Boundary::Ring,
        spacing: scenario.spacing,
        restitution: scenario.restitution,
        stiffness: scenario.natural_frequency * scenario.natural_frequency,
        masses,
        v: filled(&[&[0.0][..], &start.velocities].concat()),
        forces: forcing.iter().map(|of| [filled(&of.cos), filled(&of.sin)]).collect(),
        phases: forcing.iter().map(|of| of.phase(begin)).collect(),
        last: 0.0,
        shut: vec![0; length.div_ceil(WORD)],
        u: filled(&u),
    };
    run_steps(task, h, forcing.iter().map(|of| of.rate).collect(), flip)
}

impl<T: Real> Stepper for Flip<T> {
    #[inline(always)]
    fn step<S: Simd>(&mut self, simd: S, step: &Step, tally: &mut Tally) -> Result<(), Stop> {
        self.leap(simd, step);
        tally.cost.evaluations += (self.masses + self.topology.gaps()) as u64;
        if self.find_shut(simd) {
            self.flip(step, tally)?;
        }
        Ok(())
    }
}

impl<T: Real> Flip<T> {
    /// Moves all bodies; between steps velocities are those half of the last step ago.
    #[inline(always)]
    fn leap<S: Simd>(&mut self, simd: S, step: &Step) {
        let width = T::Lanes::<S>::LEN;
        let kick = 0.5 * (self.last + step.h);
        let (pull, h) = (T::of(-kick * self.stiffness), T::of(step.h));
        for (i, ([cos, sin], phase)) in self.forces.iter().zip(&self.phases).enumerate() {
            let [c, s] = [phase.1, phase.0].map(|x| T::of(kick * x));
            let forces = cos.chunks_exact(width).zip(sin.chunks_exact(width));
            let bodies = self.u.chunks_exact_mut(width).zip(self.v.chunks_exact_mut(width));
            for ((u_at, v_at), (cos, sin)) in bodies.zip(forces) {
                let load = |x: &[T]| T::Lanes::<S>::from_slice(simd, x);
                let (u, v, change) = (load(u_at), load(v_at), load(cos) * c + load(sin) * s);
                let (u, v) = if i == 0 {
                    let v = (v + u * pull) + change;
                    (u + v * h, v)
                } else {
                    (u + change * h, v + change)
                };
                u.store_slice(u_at);
                v.store_slice(v_at);
            }
        }
        if self.ring {
            self.u[self.masses + 1] = self.u[1];
        }
        self.phases.copy_from_slice(step.phases);
        self.last = step.h;
    }

    /// Marks the gaps that are negative; returns whether there is any.
    #[inline(always)]
    fn find_shut<S: Simd>(&mut self, simd: S) -> bool {
        let width = T::Lanes::<S>::LEN;
        let d = T::Lanes::<S>::splat(simd, T::of(self.spacing));
        let bodies = self.u.len() - 16;
        let (left, right) = (&self.u[..bodies], &self.u[1..=bodies]);
        let words = left.chunks(WORD).zip(right.chunks(WORD));
        let mut any = 0;
        for (word, (left, right)) in self.shut.iter_mut().zip(words) {
            *word = 0;
            let pairs = left.chunks_exact(width).zip(right.chunks_exact(width));
            for (place, (left, right)) in (0..).step_by(width).zip(pairs) {
                let load = |x: &[T]| T::Lanes::<S>::from_slice(simd, x);
                let gap = (load(right) - load(left)) + d;
                *word |= gap.simd_lt(T::of(0.0)).to_bitmask() << place;
            }
            any |= *word;
        }
        any != 0
    }

    /// Applies the impact law to each marked gap that closes.
    #[inline(always)]
    fn flip(&mut self, step: &Step, tally: &mut Tally) -> Result<(), Stop> {
        let (first, gaps) = (self.topology.sides(0)[0], self.topology.gaps());
        for word in 0..self.shut.len() {
            let mut bits = self.shut[word];
            while bits != 0 {
                let body = WORD * word + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                // On a ring, body 0 is no neighbour of body 1, and n + 1 stands for 1.
                let Some(k) = body.checked_sub(first).filter(|k| *k < gaps) else { continue };
                let [left, right] = self.topology.sides(k);
                let bend = 0.5 * step.h * (self.acceleration(right) - self.acceleration(left));
                let [before, after] = [left, right].map(|m| self.v[m].into());
                let speed = -(after - before + bend);
                if speed > 0.0 {
                    let jumps = jumps(speed, self.restitution, self.topology.inverse_masses(k));
                    self.v[left] = T::of(before + jumps[0]);
                    self.v[right] = T::of(after + jumps[1]);
                    tally.impact(k, step.to().time(), speed)?;
                }
            }
        }
        Ok(())
    }

    /// Returns the acceleration of a body in flight at the end of the step.
    #[inline(always)]
    fn acceleration(&self, m: usize) -> f64 {
        let forces = self.forces.iter().zip(&self.phases);
        let sum = forces
            .fold(0.0, |sum, ([c, s], (sin, cos))| sum + (c[m].into() * cos + s[m].into() * sin));
        sum - self.stiffness * self.u[m].into()
    }
}
