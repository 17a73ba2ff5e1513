//! Skips long waits: finds the next time at which all parts of a sum can be low together.

use super::local_frame::Frequencies;
use super::pair::Pair;
use super::trig::rough_angles;

/// One sinusoid R cos(νs + θ), as value u and quadrature u̇/ν at s = 0.
#[derive(Clone, Copy, Debug)]
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

/// Returns a time s ≥ 0 before which `mean` + Σ R cos(νs + θ) > 0 is certain; none if it is at
/// all times.
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
