//! Simulates contacts by penalty springs.

use super::bodies::{Bodies, push};
use super::method::Task;
use super::rival::{Rival, Run, Stepper, Stop, Tally, run_steps};
use super::steps::Step;
use crate::Error;
use fearless_simd::Simd;
use std::f64::consts::PI;

/// Penalty springs: a shut gap is a stiff spring with a damper that is tuned to the restitution;
/// velocity Verlet.
///
/// Alone, an overlapped gap follows Δ'' + 2ζω_c Δ' + ω_c² Δ = 0 and comes back with r times
/// its speed for ζ = −ln r/√(π² + ln² r). The stiffness follows from the step: half a
/// period of ω_c takes (0.4 h/ω)^(1/2), which is 20 steps at h = 0.001/ω and 200 at 0.00001/ω.
/// So the errors of the two sides balance: a contact takes time, and its beginning and end, known
/// to a step, change its restitution.
///
/// An impact is an episode of contact, counted once at its beginning; the damper acts until its
/// end, so it also pulls.
///
/// - Source: Cundall and Strack (1979), Géotechnique 29, 47; the damper for a given r: Schäfer,
///   Dippel and Wolf (1996), J. Phys. I France 6, 5.
/// - Order: 1/2 in the step, by the choice above; 1 in the duration of a contact.
/// - Fails: a neighbour that is hit while a contact lasts takes part in it, which changes both
///   impacts altogether (a row hit at its end, any cluster); near misses and grazes are decided by
///   the step; with r = 0 a gap creeps open and never ends its contact; a step for a hard contact
///   is tiny.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penalty {
    /// Length h of a step.
    pub step: f64,
}

/// The square of half a period of the contact's spring, in units of h/ω.
const DURATION: f64 = 0.4;

/// The fewest steps that half a period takes; with fewer the spring would not be integrated at all.
const STEPS: f64 = 5.0;

impl Rival for Penalty {
    const NAME: &'static str = "penalty";

    fn begin(&self, task: Task) -> Result<Run, Error> {
        let row = Bodies::new(task)?;
        let omega = task.scenario.natural_frequency;
        let steps = (DURATION / (self.step * omega)).sqrt().max(STEPS);
        let contact = PI / (steps * self.step);
        let rates = row.rates();
        // ζ, with which a contact ends with r times the first speed.
        let log = pxfm::f_log(row.restitution);
        let damping_ratio =
            if row.restitution == 0.0 { 1.0 } else { -log / (PI * PI + log * log).sqrt() };
        let springs = Springs {
            stiffness: contact * contact,
            damping: 2.0 * damping_ratio * contact,
            shut: Vec::new(),
            contacts: Vec::new(),
            row,
        };
        run_steps(task, self.step, rates, springs)
    }
}

struct Springs {
    row: Bodies,
    /// ω_c²: force per overlap and reduced mass.
    stiffness: f64,
    damping: f64,
    shut: Vec<usize>,
    /// Gaps in contact, with what opens them.
    contacts: Vec<(usize, f64)>,
}

impl Stepper for Springs {
    #[inline(always)]
    fn step<S: Simd>(&mut self, simd: S, step: &Step, tally: &mut Tally) -> Result<(), Stop> {
        let row = &mut self.row;
        let kick = 0.5 * (row.last + step.h);
        // The damper uses the velocity in the middle of the last step.
        for (k, impulse) in &mut self.contacts {
            let apart = -(self.stiffness * row.width(*k) + self.damping * row.rate(*k));
            let [left, right] = row.topology.inverse_masses(*k);
            *impulse = kick * apart / (left + right);
        }
        let before = std::mem::take(&mut self.contacts);
        for (k, impulse) in &before {
            push(&row.topology, *k, *impulse, &mut row.v);
        }
        row.leap(step);
        tally.cost.evaluations += row.masses() + row.topology.gaps() as u64;
        row.shut(simd, &row.u, &mut self.shut);
        for &k in self.shut.iter().filter(|k| row.width(**k) < 0.0) {
            let speed = -row.rate(k);
            let touches = before.iter().any(|(gap, _)| *gap == k);
            if !touches && speed > 0.0 {
                tally.impact(k, step.to.time(), speed)?;
            }
            if touches || speed > 0.0 {
                self.contacts.push((k, 0.0));
            }
        }
        Ok(())
    }
}
