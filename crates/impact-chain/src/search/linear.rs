//! Evaluates numbers that are linear in a frame (coefficients of polynomials, values). Their
//! factors depend on the frequencies alone: a table, made once, replaces every sine.

use super::local_frame::{Frame, Frequencies};
use super::pair::{Pair, splat};
use super::trig::small_sin_cos;

/// Taylor coefficients of a function about one instant, from its value to the ninth order.
pub type Taylor = [f64; 10];

/// The factors of 2 `N` numbers. Each also contains f₀, which callers add.
#[derive(Clone, Copy, Debug)]
pub struct Linear<const M: usize, const N: usize> {
    slope: [Pair; N],
    alpha: [Pair; N],
    forced: [[[Pair; N]; 2]; M],
}

/// Computes the Taylor coefficients about s of 1 − cos νs and sin νs (its value as sin νs − νs).
fn waves(nu: f64, s: f64) -> [Taylor; 2] {
    let [sine_less_angle, versine] = small_sin_cos(nu * s);
    let (sin, cos) = (nu * s + sine_less_angle, 1.0 - versine);
    let mut factor = 1.0;
    let (mut even, mut odd) = ([versine; 10], [sine_less_angle; 10]);
    for k in 1..10 {
        factor *= nu / k as f64;
        let [even_derivative, odd_derivative] = match k % 4 {
            0 => [-cos, sin],
            1 => [sin, cos],
            2 => [cos, -sin],
            _ => [-sin, -cos],
        };
        (even[k], odd[k]) = (factor * even_derivative, factor * odd_derivative);
    }
    [even, odd]
}

impl<const M: usize, const N: usize> Linear<M, N> {
    /// Tabulates the numbers that `extract` computes from the Taylor coefficients of a function.
    pub fn new(
        frequencies: &Frequencies<M>,
        extract: impl Fn(&dyn Fn(f64) -> Taylor) -> [Pair; N],
    ) -> Self {
        let w = frequencies.omega;
        Linear {
            slope: extract(&|s| {
                let [_, mut sine] = waves(w, s);
                sine[0] += w * s;
                sine.map(|x| x / w)
            }),
            alpha: extract(&|s| waves(w, s)[0].map(|x| -x)),
            forced: std::array::from_fn(|m| {
                let nu = frequencies.big_omegas[m];
                let difference = |s: f64| {
                    let ([versine, sine], [big_versine, big_sine]) = (waves(w, s), waves(nu, s));
                    let mut c: Taylor = std::array::from_fn(|k| big_sine[k] - nu / w * sine[k]);
                    c[1] = nu * (versine[0] - big_versine[0]);
                    c
                };
                [extract(&|s| waves(nu, s)[0].map(|x| -x)), extract(&difference)]
            }),
        }
    }

    /// Evaluates the numbers of a frame, without f₀.
    #[inline(always)]
    pub fn evaluate(&self, frame: &Frame<M>) -> [Pair; N] {
        std::array::from_fn(|i| {
            let mut sum = splat(frame.g0) * self.slope[i] + splat(frame.alpha) * self.alpha[i];
            for m in 0..M {
                sum += splat(frame.forced[m][0]) * self.forced[m][0][i]
                    + splat(frame.forced[m][1]) * self.forced[m][1][i];
            }
            sum
        })
    }
}
