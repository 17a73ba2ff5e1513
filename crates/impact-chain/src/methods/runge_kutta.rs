//! Integrates by a Runge–Kutta pair of orders 5 and 4 with events.

use super::bodies::Bodies;
use super::dormand_prince::Stages;
use super::method::Task;
use super::rival::{Rival, Run};
use super::sign_change::{closing_time, is_rounding};
use super::steps::check_tolerance;
use super::tally::{Stop, Tally};
use crate::Error;
use crate::search::clock::Instant;

/// The pair of Dormand and Prince with a tolerance; a gap that is negative at the end of a step is
/// an event, bisected on the dense output; the earliest ends the step, and integration starts
/// again.
///
/// The absolute tolerance is a thousandth of the relative one. The next step has 0.9 err^(−1/5)
/// times the length of the last, from 1/5 to 5 times; after an event it is the length tried before.
///
/// - Source: Dormand and Prince (1980), J. Comput. Appl. Math. 6, 19; step control and dense output
///   as in Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, secs. II.4 to
///   II.6 (DOPRI5); events by sign as in SciPy's solve_ivp or MATLAB's ode45 with an event
///   function.
/// - Order: 5 at the ends of steps, 4 between them, where impacts lie.
/// - Fails: two roots within a step leave no change of sign, so grazes and short dips are missed,
///   and the steps of a loose tolerance are long; the error in flight adds up; each event costs a
///   step of all masses; a chatter ends in the bound on work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RungeKutta {
    /// Error allowed in a step, relative.
    pub tolerance: f64,
}

/// The first step, in units of 1/max(ω, Ω).
const FIRST: f64 = 0.01;

impl Rival for RungeKutta {
    const NAME: &'static str = "runge-kutta";

    fn begin(&self, task: Task) -> Result<Run, Error> {
        let (scenario, start, until) = task;
        let (row, now) = (Bodies::new(task)?, Instant::at(start.time));
        check_tolerance(self.tolerance)?;
        let stages = Stages::new(&row, now);
        let mut steps = Steps { stages, row, now, tolerance: self.tolerance };
        let first = FIRST / scenario.fastest();
        Ok(Box::new(move |tally| steps.integrate(Instant::at(until), first, tally)))
    }
}

struct Steps {
    /// The row; its displacements and velocities are up to date at impacts only.
    row: Bodies,
    stages: Stages,
    now: Instant,
    tolerance: f64,
}

impl Steps {
    fn integrate(&mut self, end: Instant, first: f64, tally: &mut Tally) -> Result<(), Stop> {
        tally.cost.evaluations += self.row.masses();
        let mut wanted = first;
        while self.now < end {
            let left = end.since(self.now);
            let h = wanted.min(left);
            tally.step()?;
            tally.cost.evaluations += 6 * self.row.masses();
            let error = self.stages.attempt(&self.row, self.now, h, self.tolerance);
            let grown = h * growth(error);
            if error > 1.0 {
                wanted = grown;
                continue;
            }
            match self.event(h, tally) {
                Some((k, s)) => self.impact(k, s, h, tally)?,
                None => {
                    // A step that was cut short by the end of the run must not shorten the next.
                    wanted = if h < wanted { wanted.max(grown) } else { grown };
                    self.now = if h == left { end } else { self.now.after(h) };
                    self.stages.accept();
                }
            }
        }
        Ok(())
    }

    /// Returns the gap that closes first, and the time in the step at which it does; none if no gap
    /// is negative at the end of the step.
    fn event(&self, h: f64, tally: &mut Tally) -> Option<(usize, f64)> {
        let (row, stages) = (&self.row, &self.stages);
        let gaps = row.topology.gaps();
        tally.cost.evaluations += gaps as u64;
        let mut best: Option<(usize, f64)> = None;
        let (u, v) = stages.next.split_at(row.u.len());
        for k in 0..gaps {
            let [left, right] = row.topology.sides(k);
            let width = row.width_at(k, u);
            if width >= 0.0 || is_rounding(width, v[right] - v[left], row.spacing) {
                continue;
            }
            let s = closing_time(0.0, h, row.width_at(k, &stages.y), |s| {
                tally.cost.evaluations += 1;
                let u = |m| stages.dense(m, s / h);
                row.spacing + (u(right) - u(left))
            });
            if best.is_none_or(|(_, earliest)| s < earliest) {
                best = Some((k, s));
            }
        }
        best
    }

    /// Goes to the time s of the step, and applies the impact of gap k there.
    fn impact(&mut self, k: usize, s: f64, h: f64, tally: &mut Tally) -> Result<(), Stop> {
        if s > 0.0 {
            self.stages.cut(s / h);
            self.now = self.now.after(s);
        }
        let bodies = self.row.u.len();
        let (u, v) = self.stages.y.split_at_mut(bodies);
        self.row.u.copy_from_slice(u);
        self.row.v.copy_from_slice(v);
        let speed = (-self.row.rate(k)).max(0.0);
        self.row.hit(k, speed);
        v.copy_from_slice(&self.row.v);
        self.stages.restart(&self.row, self.now);
        tally.cost.evaluations += self.row.masses();
        // A gap at rest at zero is no impact, but counts as an event: it may stay there for ever.
        if speed > 0.0 {
            tally.impact(k, self.now.time(), speed)
        } else {
            tally.spend(k, self.now.time())
        }
    }
}

/// Returns the factor for the next step after one with this error.
fn growth(error: f64) -> f64 {
    if error == 0.0 {
        return 5.0;
    }
    (0.9 * pxfm::f_exp(-0.2 * pxfm::f_log(error))).clamp(0.2, 5.0)
}
