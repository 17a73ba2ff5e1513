//! Integrates by Verlet with a flip of velocities.

use super::bodies::Bodies;
use super::method::Task;
use super::rival::{Rival, Run, Stepper, Stop, Tally, run_steps};
use super::steps::Step;
use crate::Error;
use crate::impact::jumps;
use fearless_simd::Simd;

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
        let row = Bodies::new(task)?;
        run_steps(task, self.step, row.rates(), Flip { row, shut: Vec::new() })
    }
}

struct Flip {
    row: Bodies,
    shut: Vec<usize>,
}

impl Stepper for Flip {
    #[inline(always)]
    fn step<S: Simd>(&mut self, simd: S, step: &Step, tally: &mut Tally) -> Result<(), Stop> {
        let Flip { row, shut } = self;
        row.leap(step);
        tally.cost.evaluations += row.masses() + row.topology.gaps() as u64;
        row.shut(simd, &row.u, shut);
        for &k in &*shut {
            let sides = row.topology.sides(k);
            let [left, right] = sides.map(|m| row.acceleration(m));
            let speed = -(row.rate(k) + 0.5 * step.h * (right - left));
            if speed > 0.0 && row.width(k) < 0.0 {
                let jumps = jumps(speed, row.restitution, row.topology.inverse_masses(k));
                sides.into_iter().zip(jumps).for_each(|(m, jump)| row.v[m] += jump);
                tally.impact(k, step.to.time(), speed)?;
            }
        }
        Ok(())
    }
}
