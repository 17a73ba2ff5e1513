//! Integrates by a Runge–Kutta pair of orders 5 and 4 with events.

use super::bodies::Bodies;
use super::flights::is_open;
use super::method::Task;
use super::rival::{Rival, Run, Stop, Tally};
use super::steps::check_tolerance;
use crate::Error;
use crate::search::clock::Instant;
use impact_numerics::roots::bracket;
use std::mem::swap;

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
///   step of all masses; a chatter ends in the bound on work, or a least rebound speed is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RungeKutta {
    /// Error allowed in a step, relative.
    pub tolerance: f64,
    /// The speed with which an impact opens its gap at least.
    pub least_rebound: f64,
}

/// The first step, in units of 1/max(ω, Ω).
const FIRST: f64 = 0.01;

impl Rival for RungeKutta {
    const NAME: &'static str = "runge-kutta";

    fn begin(&self, task: Task) -> Result<Run, Error> {
        let Task { scenario, start, until } = task;
        let (mut row, now) = (Bodies::new(task)?, Instant::at(start.time));
        row.least_rebound = self.least_rebound;
        check_tolerance(self.tolerance)?;
        let stages = Stages::new(&row, now);
        let mut steps = Steps { stages, row, now, tolerance: self.tolerance };
        let first = FIRST / scenario.fastest();
        Ok(Box::new(move |tally| {
            tally.limit_chatter(steps.row.least_rebound);
            steps.integrate(Instant::at(until), first, tally)
        }))
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
                    // The next step starts from the end of this one.
                    swap(&mut self.stages.y, &mut self.stages.next);
                    self.stages.k.swap(0, 6);
                }
            }
        }
        Ok(())
    }

    /// Returns the gap that closes first and its time in the step, or `None` if no gap ends
    /// negative.
    fn event(&self, h: f64, tally: &mut Tally) -> Option<(usize, f64)> {
        let (row, stages) = (&self.row, &self.stages);
        let gaps = row.topology.gaps();
        tally.cost.evaluations += gaps as u64;
        let mut first: Option<(usize, f64)> = None;
        let (u, v) = stages.next.split_at(row.u.len());
        for k in 0..gaps {
            let [left, right] = row.topology.sides(k);
            let width = row.width_at(k, u);
            if is_open(width, v[right] - v[left], row.spacing) {
                continue;
            }
            let s = closing_time(h, row.width_at(k, &stages.y), |s| {
                tally.cost.evaluations += 1;
                let u = |m| stages.dense(m, s / h);
                row.spacing + (u(right) - u(left))
            });
            if first.is_none_or(|(_, earliest)| s < earliest) {
                first = Some((k, s));
            }
        }
        first
    }

    /// Goes to the time s of the step, and applies the impact of gap k there.
    fn impact(&mut self, k: usize, s: f64, h: f64, tally: &mut Tally) -> Result<(), Stop> {
        if s > 0.0 {
            self.stages.cut(s / h);
            self.now = self.now.after(s);
        }
        let (u, v) = self.stages.y.split_at_mut(self.row.u.len());
        self.row.u.copy_from_slice(u);
        self.row.v.copy_from_slice(v);
        let speed = (-self.row.rate(k)).max(0.0);
        self.row.hit(k, speed);
        v.copy_from_slice(&self.row.v);
        self.stages.restart(&self.row, self.now);
        tally.cost.evaluations += self.row.masses();
        tally.event(k, self.now.time(), speed)
    }
}

/// Halvings of the time after an impact until a width above zero is found.
const HALVINGS: u32 = 64;

/// Returns the last time in [0, end] before `width` becomes negative, given its value `first` ≥ 0
/// at 0 and a negative one at the end. At most 128 evaluations.
///
/// A gap that has just been hit has the width 0; first a time at which it is open is found by
/// halving. If there is none, the gap is shut from 0 on.
pub fn closing_time(end: f64, first: f64, mut width: impl FnMut(f64) -> f64) -> f64 {
    let (mut open, mut shut) = (0.0, end);
    if first <= 0.0 {
        for _ in 0..HALVINGS {
            let middle = 0.5 * shut;
            if width(middle) > 0.0 {
                open = middle;
                break;
            }
            shut = middle;
        }
        if open == 0.0 {
            return 0.0;
        }
    }
    bracket(open, shut, |s| width(s) < 0.0)[0]
}

/// Returns the factor for the next step after one with this error.
fn growth(error: f64) -> f64 {
    (0.9 * pxfm::f_exp(-0.2 * pxfm::f_log(error))).clamp(0.2, 5.0)
}

/// Nodes c_i of the stages 2 to 7.
const NODES: [f64; 6] = [1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];

/// Coefficients a_ij of the stages 2 to 7; the last row is the solution of order 5.
const STAGES: [[f64; 6]; 6] = [
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// Order 5 less order 4.
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// The coefficients of the last term of the dense output, of order 4.
const DENSE: [f64; 7] = [
    -12715105075.0 / 11282082432.0,
    0.0,
    87487479700.0 / 32700410799.0,
    -10690763975.0 / 1880347072.0,
    701980252875.0 / 199316789632.0,
    -1453857185.0 / 822651844.0,
    69997945.0 / 29380423.0,
];

/// The absolute tolerance over the relative one, as in solve_ivp (SciPy) and ode45 (MATLAB).
const ABSOLUTE: f64 = 1e-3;

/// Below this an error is rounding, in units of the spacing.
const LEAST: f64 = 1e-15;

/// One step from `y` to `next`: displacements of all bodies, then their velocities.
struct Stages {
    y: Vec<f64>,
    next: Vec<f64>,
    k: [Vec<f64>; 7],
    h: f64,
}

impl Stages {
    fn new(row: &Bodies, instant: Instant) -> Stages {
        let y: Vec<f64> = row.u.iter().chain(&row.v).copied().collect();
        let k = std::array::from_fn(|_| vec![0.0; y.len()]);
        let mut stages = Stages { next: y.clone(), y, k, h: 0.0 };
        stages.restart(row, instant);
        stages
    }

    fn restart(&mut self, row: &Bodies, instant: Instant) {
        differentiate(row, instant, &self.y, &mut self.k[0]);
    }

    /// Tries a step of length `h`. Returns the root mean square of its errors over those allowed.
    fn attempt(&mut self, row: &Bodies, from: Instant, h: f64, tolerance: f64) -> f64 {
        self.h = h;
        for (stage, coefficients) in STAGES.iter().enumerate() {
            for i in 0..self.y.len() {
                self.next[i] = self.y[i] + h * self.weighted(&coefficients[..=stage], i);
            }
            differentiate(row, from.after(NODES[stage] * h), &self.next, &mut self.k[stage + 1]);
        }
        let mut sum = 0.0;
        for (i, (y, next)) in self.y.iter().zip(&self.next).enumerate() {
            let error = h * self.weighted(&ERROR, i);
            let allowed = (tolerance * (ABSOLUTE + y.abs().max(next.abs()))).max(LEAST);
            sum += (error / allowed) * (error / allowed);
        }
        (sum / self.y.len() as f64).sqrt()
    }

    /// Returns Σ a_j k_j of component i over the given coefficients.
    #[inline(always)]
    fn weighted(&self, a: &[f64], i: usize) -> f64 {
        a.iter().zip(&self.k).fold(0.0, |sum, (a, k)| sum + a * k[i])
    }

    /// Interpolates component i at the fraction θ of the step.
    fn dense(&self, i: usize, theta: f64) -> f64 {
        let (h, rest) = (self.h, 1.0 - theta);
        let difference = self.next[i] - self.y[i];
        let bend = h * self.k[0][i] - difference;
        let third = difference - h * self.k[6][i] - bend;
        let fourth = h * self.weighted(&DENSE, i);
        self.y[i] + theta * (difference + rest * (bend + theta * (third + rest * fourth)))
    }

    /// Cuts the step at its fraction θ; [`Stages::restart`] must follow.
    fn cut(&mut self, theta: f64) {
        for i in 0..self.y.len() {
            self.next[i] = self.dense(i, theta);
        }
        swap(&mut self.y, &mut self.next);
    }
}

/// Computes (u, v)' = (v, −ω² u + forcing).
fn differentiate(row: &Bodies, instant: Instant, y: &[f64], derivative: &mut [f64]) {
    let bodies = row.u.len();
    derivative[..bodies].copy_from_slice(&y[bodies..]);
    row.accelerations(instant, &y[..bodies], &mut derivative[bodies..]);
}
