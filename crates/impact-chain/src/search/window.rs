//! Skips long waits: finds the next time at which all parts of a sum can be low together.

use super::local_frame::Frequencies;
use super::pair::Pair;
use super::trig::rough_angles;

/// One sinusoid R cos(νs + θ), as value u and quadrature u̇/ν at s = 0.
struct Part {
    frequency: f64,
    /// θ − π.
    angle: f64,
    /// The sum can reach zero only while νs + θ is within this of π, modulo 2π.
    half_width: f64,
}

/// Windows are widened by this much, far more than [`rough_angles`] and rounding are off.
const WIDENED: f64 = 1e-7;

const HOPS: u32 = 64;

/// Returns a time s ≥ 0 before which `mean` + Σ R cos(νs + θ) > 0 is certain, or `None` if it is
/// certain at all times.
///
/// The part with amplitude R is low enough only while R cos(νs + θ) ≤ −(mean − Σ of the
/// other amplitudes): in one window a period. Before s no instant lies in the windows of all parts.
/// The cost is one comparison a window, however long the wait.
pub fn next_window<const M: usize>(
    mean: f64,
    free: [f64; 2],
    forced: &[[f64; 2]; M],
    frequencies: &Frequencies<M>,
) -> Option<f64> {
    let amplitude = |[u, quadrature]: [f64; 2]| (u * u + quadrature * quadrature).sqrt();
    let amplitudes: [f64; M] = std::array::from_fn(|m| amplitude(forced[m]));
    let amplitude_of_free = amplitude(free);
    let total = amplitudes.iter().fold(amplitude_of_free, |sum, r| sum + r) * (1.0 + 1e-12);
    if total < mean {
        return None;
    }
    let part = |frequency: f64, [u, quadrature]: [f64; 2], r: f64| {
        let cosine = (mean - (total - r)) / r - 1e-12;
        // Always low enough if there is no angle at which it is too high.
        let narrow = cosine > -1.0 && cosine < 1.0;
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let angles = rough_angles(Pair::from([sine, quadrature]), Pair::from([cosine, -u]));
        let [half_width, angle] = angles.to_array();
        let half_width = if narrow { half_width + WIDENED } else { 4.0 };
        Part { frequency, angle, half_width }
    };
    let free = part(frequencies.omega, free, amplitude_of_free);
    let forced: [Part; M] =
        std::array::from_fn(|m| part(frequencies.big_omegas[m], forced[m], amplitudes[m]));
    let mut s = 0.0;
    for _ in 0..HOPS {
        let before = s;
        for part in std::iter::once(&free).chain(&forced) {
            s += part.wait(s);
        }
        if s == before {
            break;
        }
    }
    Some(s)
}

impl Part {
    /// Returns the time from `s` to the beginning of the next window; 0 in a window.
    #[inline]
    fn wait(&self, s: f64) -> f64 {
        const TURN: f64 = std::f64::consts::TAU;
        if self.half_width >= 3.5 {
            return 0.0;
        }
        let angle = self.angle + self.frequency * s;
        // Behind the middle of the nearest window; adding WHOLE rounds to a whole number.
        const WHOLE: f64 = 1.5 * (1u64 << 52) as f64;
        let behind = angle - TURN * ((angle * (1.0 / TURN) + WHOLE) - WHOLE);
        if behind.abs() <= self.half_width + 1e-3 * WIDENED {
            return 0.0;
        }
        let middle = if behind > 0.0 { TURN } else { 0.0 };
        (middle - self.half_width - behind) / self.frequency
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::random::{NormalPairs, Seed};
    use std::f64::consts::{PI, SQRT_2};

    /// At s one part is lowest and the other enters its window, so the sum is zero at last.
    #[test]
    fn a_window_opens_just_before_the_sum_can_be_zero() {
        let frequencies = Frequencies::new(1.0, [SQRT_2]);
        for i in 0..4000 {
            let [x, y] = NormalPairs::new("window", Seed(1), i).pair();
            let (s, cosine) = ([0.1, 300.0][i as usize / 2 % 2] * y.abs(), x / (1.0 + x.abs()));
            let (edge, lowest, entry) = (1.0 + x * x, 1.0 + y * y, PI - cosine.acos());
            let [angles, amplitudes] = match i % 2 {
                0 => [[entry, PI], [edge, lowest]],
                _ => [[PI, entry], [lowest, edge]],
            };
            let part = |k: usize| {
                let (sin, cos) = (angles[k] - [1.0, SQRT_2][k] * s).sin_cos();
                [amplitudes[k] * cos, -amplitudes[k] * sin]
            };
            let next = |mean: f64| next_window(mean, part(0), &[part(1)], &frequencies);
            let opens = next(lowest + cosine * edge).unwrap();
            assert!(opens <= s, "{i}: {opens} > {s}");
            let alone = s < 0.3 && cosine.abs() < 0.8;
            assert!(!alone || s - opens < 1e-6, "{i}: {opens} long before {s}");
            let total = edge + lowest;
            assert!(next(total * (1.0 + 1e-11)).is_none() && next(total).is_some());
        }
    }
}
