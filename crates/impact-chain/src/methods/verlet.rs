//! Integrates by Verlet with a flip of velocities.

use super::bodies::{Bodies, Stepper, run_steps};
use super::method::{Cost, Method, Task};
use super::steps::Step;
use super::tally::{Stop, Tally};
use crate::search::clock::Instant;
use crate::{Error, Sink};

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

impl Method for Verlet {
    fn name(&self) -> &'static str {
        "verlet"
    }

    fn run(&self, (scenario, start, until): Task, sink: Sink) -> Result<Cost, Error> {
        let begin = |row: &Bodies| Flip::begin(row, Instant::at(start.time));
        run_steps((scenario, start, until), self.step, sink, begin)
    }
}

struct Flip {
    accelerations: Vec<f64>,
}

impl Flip {
    fn begin(row: &Bodies, at: Instant) -> Flip {
        let mut accelerations = vec![0.0; row.u.len()];
        row.accelerations(at, &row.u, &mut accelerations);
        Flip { accelerations }
    }
}

impl Stepper for Flip {
    fn step(&mut self, row: &mut Bodies, step: &Step, tally: &mut Tally) -> Result<(), Stop> {
        let half = 0.5 * step.h;
        for ((u, v), a) in row.u.iter_mut().zip(&mut row.v).zip(&self.accelerations) {
            *v += half * a;
            *u += step.h * *v;
        }
        row.accelerations(step.to, &row.u, &mut self.accelerations);
        for (v, a) in row.v.iter_mut().zip(&self.accelerations) {
            *v += half * a;
        }
        let gaps = row.topology.gaps();
        tally.cost.evaluations += row.masses() + gaps as u64;
        if !row.any_shut(0.0) {
            return Ok(());
        }
        for k in 0..gaps {
            let speed = -row.rate(k);
            if row.width(k) < 0.0 && speed > 0.0 {
                row.hit(k, speed);
                tally.impact(k, step.to.time(), speed)?;
            }
        }
        Ok(())
    }
}
