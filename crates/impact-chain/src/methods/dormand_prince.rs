//! Advances by the pair of Dormand and Prince: its coefficients, one step, its dense output.

use super::bodies::Bodies;
use crate::search::clock::Instant;

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

/// The absolute tolerance over the relative one, as in the defaults of solve_ivp in SciPy and of
/// ode45 in MATLAB, 1e-6 and 1e-3.
const ABSOLUTE: f64 = 1e-3;

/// Below this an error is rounding, in units of the spacing.
const LEAST: f64 = 1e-15;

/// One step from `y` to `next`: displacements of all bodies, then their velocities.
pub struct Stages {
    pub y: Vec<f64>,
    pub next: Vec<f64>,
    /// The derivatives k_1..k_7.
    k: [Vec<f64>; 7],
    h: f64,
}

impl Stages {
    /// Starts from the displacements and velocities of `row`.
    pub fn new(row: &Bodies, at: Instant) -> Stages {
        let y: Vec<f64> = row.u.iter().chain(&row.v).copied().collect();
        let zero = vec![0.0; y.len()];
        let k = std::array::from_fn(|_| zero.clone());
        let mut stages = Stages { next: y.clone(), y, k, h: 0.0 };
        stages.restart(row, at);
        stages
    }

    /// Restarts at `y`, which an impact has changed.
    pub fn restart(&mut self, row: &Bodies, at: Instant) {
        derivative(row, at, &self.y, &mut self.k[0]);
    }

    /// Tries a step of length `h`. Returns its error in units of that which `tolerance` allows:
    /// root mean square over all components, absolute and relative.
    pub fn attempt(&mut self, row: &Bodies, from: Instant, h: f64, tolerance: f64) -> f64 {
        self.h = h;
        for (stage, coefficients) in STAGES.iter().enumerate() {
            for i in 0..self.y.len() {
                self.next[i] = self.y[i] + h * self.weighted(&coefficients[..=stage], i);
            }
            derivative(row, from.after(NODES[stage] * h), &self.next, &mut self.k[stage + 1]);
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
    pub fn dense(&self, i: usize, theta: f64) -> f64 {
        let (h, rest) = (self.h, 1.0 - theta);
        let difference = self.next[i] - self.y[i];
        let bend = h * self.k[0][i] - difference;
        let third = difference - h * self.k[6][i] - bend;
        let fourth = h * self.weighted(&DENSE, i);
        self.y[i] + theta * (difference + rest * (bend + theta * (third + rest * fourth)))
    }

    /// Accepts the step: the next one starts from its end.
    pub fn accept(&mut self) {
        std::mem::swap(&mut self.y, &mut self.next);
        self.k.swap(0, 6);
    }

    /// Cuts the step at its fraction θ; [`Stages::restart`] must follow.
    pub fn cut(&mut self, theta: f64) {
        for i in 0..self.y.len() {
            self.next[i] = self.dense(i, theta);
        }
        std::mem::swap(&mut self.y, &mut self.next);
    }
}

/// (u, v)' = (v, −ω² u + forcing).
fn derivative(row: &Bodies, at: Instant, y: &[f64], out: &mut [f64]) {
    let bodies = row.u.len();
    out[..bodies].copy_from_slice(&y[bodies..]);
    row.accelerations(at, &y[..bodies], &mut out[bodies..]);
}
