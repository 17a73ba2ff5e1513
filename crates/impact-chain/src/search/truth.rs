//! Makes functions for the tests of bounds, and evaluates them in double-doubles.

use super::local_frame::{Frame, Frequencies};
use impact_numerics::double_double::{DoubleDouble, sin_cos};

/// Returns the frame of a mean and two parts, each as value and quadrature, with the least bound.
pub fn frame(mean: f64, parts: [[f64; 2]; 2], frequencies: &Frequencies<1>) -> Frame<1> {
    let (w, [big_w]) = (frequencies.omega, frequencies.big_omegas);
    let [free, forced] = parts;
    let [r1, r2] = parts.map(|[value, quadrature]| value.hypot(quadrature));
    Frame {
        f0: mean + (free[0] + forced[0]),
        g0: w * free[1] + big_w * forced[1],
        alpha: free[0],
        forced: [forced],
        bound: w.powi(4) * r1 + big_w.powi(4) * r2,
        size: mean.abs() + r1 + frequencies.weights[0] * r2,
    }
}

/// Returns a derivative of the function of a frame at s; of order 0, its value.
pub fn derivative(frame: &Frame<1>, frequencies: &Frequencies<1>, order: u32, s: f64) -> f64 {
    let dd = DoubleDouble::from;
    let (w, big_w, [[gamma, delta]]) = (
        dd(frequencies.omega),
        dd(frequencies.big_omegas[0]),
        frame.forced.map(|part| part.map(dd)),
    );
    let (alpha, sine) = (dd(frame.alpha), (dd(frame.g0) - big_w * delta) / w);
    let mut sum = if order == 0 { dd(frame.f0) - alpha - gamma } else { DoubleDouble::ZERO };
    for (nu, along_cos, along_sin) in [(w, alpha, sine), (big_w, gamma, delta)] {
        let [sin, cos] = sin_cos(nu * s);
        let mut part = [along_cos * cos + along_sin * sin, along_sin * cos - along_cos * sin];
        for _ in 0..order {
            part = [nu * part[1], -(nu * part[0])];
        }
        sum = sum + part[0];
    }
    sum.to_f64()
}
