//! A sum of two sinusoids and a constant, seen from one instant.
//!
//! In the *local frame* of an instant, with s the time since then, the function is
//!
//! f(s) = f₀ + (g₀/ω) sin ωs − α (1 − cos ωs) − γ (1 − cos Ωs) + δ (sin Ωs − (Ω/ω) sin ωs),
//!
//! where f₀ and g₀ are its value and slope at s = 0, and α, γ, δ the amplitudes of cos ωs, cos Ωs
//! and sin Ωs. In this form nothing cancels at small s: right after an impact f₀ = 0 exactly, and
//! the waiting time keeps its relative accuracy however short it is.

use super::lane::Lane;
use super::trig::{RANGE, small_sin_cos};

/// The two frequencies ω and Ω and what follows from them.
#[derive(Clone, Copy, Debug)]
pub struct Frequencies {
    /// ω.
    pub omega: f64,
    /// Ω.
    pub big_omega: f64,
    /// The longest stretch of time that one frame covers, [`RANGE`] / max(ω, Ω).
    pub reach: f64,
    inverse_omega: f64,
    ratio: f64,
}

impl Frequencies {
    /// From ω > 0 and Ω > 0.
    pub fn new(omega: f64, big_omega: f64) -> Self {
        Frequencies {
            omega,
            big_omega,
            reach: RANGE / omega.max(big_omega),
            inverse_omega: 1.0 / omega,
            ratio: big_omega / omega,
        }
    }
}

/// A function in the local frame of an instant (see the module), one per lane.
#[derive(Clone, Copy, Debug)]
pub struct Frame<L> {
    /// f₀, value at s = 0.
    pub f0: L,
    /// g₀, slope at s = 0.
    pub g0: L,
    /// α, amplitude of cos ωs.
    pub alpha: L,
    /// γ, amplitude of cos Ωs.
    pub gamma: L,
    /// δ, amplitude of sin Ωs.
    pub delta: L,
    /// M₄ ≥ |f''''(s)| for every s: ω⁴ R₁ + Ω⁴ R₂ with R₁, R₂ the amplitudes of the two parts.
    pub bound: L,
}

/// Value and derivatives at one s, and the rounding margin of the value.
#[derive(Clone, Copy, Debug)]
pub struct Point<L> {
    /// f(s).
    pub f: L,
    /// f'(s).
    pub g: L,
    /// f''(s).
    pub h: L,
    /// f'''(s).
    pub j: L,
    /// The computed f(s) is within this of the exact one.
    pub margin: L,
}

/// Rounding of one evaluation, in units of the sum of the absolute values of its terms: each of
/// the five terms carries at most five roundings of 2^-53 and the sum four more, 9 · 2^-53 < 5e-16
/// times 2; doubled, so that the margin may be used at both sides.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

impl<L: Lane> Frame<L> {
    /// Value, derivatives and margin at `s`, 0 ≤ s ≤ reach.
    #[inline(always)]
    pub fn at(&self, s: L, frequencies: &Frequencies) -> Point<L> {
        let w = L::splat(frequencies.omega);
        let big_w = L::splat(frequencies.big_omega);
        let ratio = L::splat(frequencies.ratio);
        let one = L::splat(1.0);
        let (x, y) = (w * s, big_w * s);
        let [sx, sy, cx, cy] = small_sin_cos(x, y);
        let (sin_x, sin_y) = (x + sx, y + sy);
        let linear = self.g0 * L::splat(frequencies.inverse_omega) * sin_x;
        let (free, forced) = (self.alpha * cx, self.gamma * cy);
        let difference = self.delta * (sy - ratio * sx);
        let (aw, cw) = (self.alpha * w, self.gamma * big_w);
        let dw = self.delta * big_w;
        let size = self.f0.abs()
            + linear.abs()
            + free.abs()
            + forced.abs()
            + self.delta.abs() * (sy.abs() + ratio * sx.abs());
        Point {
            f: self.f0 + linear - free - forced + difference,
            g: self.g0 * (one - cx) - aw * sin_x - cw * sin_y + dw * (cx - cy),
            h: -(self.g0 * w * sin_x) - aw * w * (one - cx) - cw * big_w * (one - cy)
                + dw * (w * sin_x - big_w * sin_y),
            j: -(self.g0 * w * w * (one - cx))
                + aw * w * w * sin_x
                + cw * big_w * big_w * sin_y
                + dw * (w * w * (one - cx) - big_w * big_w * (one - cy)),
            margin: L::splat(ROUNDING) * size,
        }
    }

    /// Value and derivatives at s = 0, where no sine is needed and the value is exact.
    #[inline(always)]
    pub fn start(&self, frequencies: &Frequencies) -> Point<L> {
        let w = L::splat(frequencies.omega);
        let big_w = L::splat(frequencies.big_omega);
        Point {
            f: self.f0,
            g: self.g0,
            h: -(self.alpha * w * w) - self.gamma * big_w * big_w,
            j: -(self.g0 * w * w) + self.delta * big_w * (w * w - big_w * big_w),
            margin: L::splat(0.0),
        }
    }
}
