//! Evaluates a sum of sinusoids and a constant in the local frame of one instant.
//!
//! In the *local frame* of an instant, with s the time since then, the function is
//!
//! f(s) = f₀ + (g₀/ω) sin ωs − α (1 − cos ωs) + Σ_m [δ (sin Ωs − (Ω/ω) sin ωs) − γ (1 − cos Ωs)],
//!
//! where f₀ and g₀ are its value and slope at s = 0, α the amplitude of cos ωs, and γ and δ
//! those of cos Ωs and sin Ωs for each of the `M` frequencies Ω (M₂, M₄, … are bounds of
//! derivatives). So nothing cancels at small s: right after an impact f₀ = 0 exactly, and the
//! waiting time keeps its relative accuracy however short it is.

use super::clock::Rate;
use super::trig::{RANGE, small_sin_cos};

/// The natural frequency ω, the `M` frequencies Ω of the forcing, and what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequencies<const M: usize> {
    pub omega: f64,
    pub big_omegas: [f64; M],
    pub fastest: f64,
    /// The longest stretch of time that one frame covers, [`RANGE`] / fastest.
    pub reach: f64,
    /// 1 + 2 Ω/ω: the largest part of a forced amplitude of 1 in the size of a frame.
    pub weights: [f64; M],
    /// ω and each Ω in turns.
    pub rate: Rate,
    pub rates: [Rate; M],
    inverse_omega: f64,
    /// (sin ωs, cos ωs) at the end of the reach, and (sin Ωs, cos Ωs).
    turn: [f64; 2],
    forced_turns: [[f64; 2]; M],
}

impl<const M: usize> Frequencies<M> {
    pub fn new(omega: f64, big_omegas: [f64; M]) -> Self {
        let fastest = big_omegas.iter().fold(omega, |a, &b| a.max(b));
        let reach = RANGE / fastest;
        let turn = |frequency: f64| {
            let [rest, versine] = small_sin_cos(frequency * reach);
            [frequency * reach + rest, 1.0 - versine]
        };
        Frequencies {
            omega,
            big_omegas,
            fastest,
            reach,
            weights: big_omegas.map(|big_omega| 1.0 + 2.0 * big_omega / omega),
            rate: Rate::new(omega),
            rates: big_omegas.map(Rate::new),
            inverse_omega: 1.0 / omega,
            turn: turn(omega),
            forced_turns: big_omegas.map(turn),
        }
    }
}

/// A function in the local frame of an instant (see the module).
#[derive(Clone, Copy, Debug)]
pub struct Frame<const M: usize> {
    pub f0: f64,
    pub g0: f64,
    /// α, amplitude of cos ωs.
    pub alpha: f64,
    /// (γ, δ), amplitudes of cos Ωs and sin Ωs, for each component of the forcing.
    pub forced: [[f64; 2]; M],
    /// M₄ ≥ |f''''(s)| for every s: Σ ω⁴ R over the parts, R ≥ the amplitude of the part.
    pub bound: f64,
    /// Bound of f's absolute terms, the scale of its rounding: |mean| + R₁ + Σ (1 + 2 Ω/ω) R₂.
    pub size: f64,
}

/// Value and derivatives at one s, and the rounding margin of the value.
#[derive(Clone, Copy, Debug)]
pub struct Point<const M: usize> {
    pub f: f64,
    pub d1: f64,
    pub d2: f64,
    pub d3: f64,
    /// The computed f(s) is within this of the exact one.
    pub margin: f64,
    /// Free part at s and its quadrature: value u and u̇/ω.
    free: [f64; 2],
    forced: [[f64; 2]; M],
}

/// Rounding of one evaluation over the sum of its absolute terms: each carries at most five
/// roundings of 2^-53 and the sum four, 9 · 2^-53 < 5e-16 times 2; doubled, for both sides.
pub const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Below this fraction of d a gap keeps its width and rate from its last frame when a neighbour is
/// hit: as a difference of two positions it would have lost its digits.
pub const NEARLY_SHUT: f64 = 1e-9;

impl<const M: usize> Frame<M> {
    pub const ZERO: Frame<M> =
        Frame { f0: 0.0, g0: 0.0, alpha: 0.0, forced: [[0.0; 2]; M], bound: 0.0, size: 0.0 };

    /// Returns the amplitude of sin ωs, from the slope at s = 0 less the forced parts.
    #[inline(always)]
    fn sine(&self, frequencies: &Frequencies<M>) -> f64 {
        let mut slope = self.g0;
        for m in 0..M {
            slope -= frequencies.big_omegas[m] * self.forced[m][1];
        }
        slope * frequencies.inverse_omega
    }

    /// Keeps a function at rest at zero from falling by a curvature that is negative by rounding.
    pub fn prevent_fall(&mut self, frequencies: &Frequencies<M>) {
        let w2 = frequencies.omega * frequencies.omega;
        let (mut forced, mut size) = (0.0, w2 * self.alpha.abs());
        for (big_w, [gamma, _]) in frequencies.big_omegas.iter().zip(self.forced) {
            forced += big_w * big_w * gamma;
            size += (big_w * big_w * gamma).abs();
        }
        if w2 * self.alpha + forced > 0.0 {
            self.alpha = -(forced + ROUNDING * size) / w2;
        }
    }

    /// Returns the same function in the frame of the end of the reach.
    #[inline(always)]
    pub fn advanced(&self, frequencies: &Frequencies<M>) -> Frame<M> {
        let rotated = |[value, quadrature]: [f64; 2], [sin, cos]: [f64; 2]| {
            [value * cos + quadrature * sin, quadrature * cos - value * sin]
        };
        let mut mean = self.f0 - self.alpha;
        let [alpha, sine] = rotated([self.alpha, self.sine(frequencies)], frequencies.turn);
        let (mut f0, mut g0) = (alpha, frequencies.omega * sine);
        let mut forced = [[0.0; 2]; M];
        for (m, part) in forced.iter_mut().enumerate() {
            mean -= self.forced[m][0];
            *part = rotated(self.forced[m], frequencies.forced_turns[m]);
            f0 += part[0];
            g0 += frequencies.big_omegas[m] * part[1];
        }
        Frame { f0: mean + f0, g0, alpha, forced, bound: self.bound, size: self.size }
    }

    /// Computes value, derivatives and margin at `s`, 0 ≤ s ≤ reach.
    #[inline(always)]
    pub fn at(&self, s: f64, frequencies: &Frequencies<M>) -> Point<M> {
        let w = frequencies.omega;
        let x = w * s;
        let [sin_rest, versine] = small_sin_cos(x);
        let (sin, cos) = (x + sin_rest, 1.0 - versine);
        let linear = self.g0 * frequencies.inverse_omega * sin;
        let along = self.alpha * versine;
        let mut f = self.f0 + linear - along;
        let mut size = self.f0.abs() + linear.abs() + along.abs();
        let aw = self.alpha * w;
        let mut d1 = self.g0 * cos - aw * sin;
        let sine = self.sine(frequencies);
        let free = [self.alpha * cos + sine * sin, sine * cos - self.alpha * sin];
        let mut d2 = -(w * w * free[0]);
        let mut d3 = -(w * w * w * free[1]);
        let mut forced = [[0.0; 2]; M];
        for (m, forced) in forced.iter_mut().enumerate() {
            let (big_w, [gamma, delta]) = (frequencies.big_omegas[m], self.forced[m]);
            let ratio = big_w * frequencies.inverse_omega;
            let y = big_w * s;
            let [big_sin_rest, big_versine] = small_sin_cos(y);
            let (big_sin, big_cos) = (y + big_sin_rest, 1.0 - big_versine);
            let along = gamma * big_versine;
            f = f - along + delta * (big_sin_rest - ratio * sin_rest);
            size += along.abs() + delta.abs() * (big_sin_rest.abs() + ratio * sin_rest.abs());
            d1 = d1 - gamma * big_w * big_sin + delta * big_w * (versine - big_versine);
            let part = [gamma * big_cos + delta * big_sin, delta * big_cos - gamma * big_sin];
            d2 -= big_w * big_w * part[0];
            d3 -= big_w * big_w * big_w * part[1];
            *forced = part;
        }
        Point { f, d1, d2, d3, margin: ROUNDING * size, free, forced }
    }

    /// Returns value and derivatives at s = 0, where no sine is needed and the value is exact.
    #[inline(always)]
    pub fn start(&self, frequencies: &Frequencies<M>) -> Point<M> {
        let w = frequencies.omega;
        let sine = self.sine(frequencies);
        let mut d2 = -(self.alpha * w * w);
        let mut d3 = -(sine * w * w * w);
        for m in 0..M {
            let (big_w, [gamma, delta]) = (frequencies.big_omegas[m], self.forced[m]);
            d2 -= gamma * big_w * big_w;
            d3 -= delta * big_w * big_w * big_w;
        }
        let (free, forced) = ([self.alpha, sine], self.forced);
        Point { f: self.f0, d1: self.g0, d2, d3, margin: 0.0, free, forced }
    }
}

impl<const M: usize> Point<M> {
    /// Returns the derivatives of fourth and fifth order.
    pub fn higher(&self, frequencies: &Frequencies<M>) -> [f64; 2] {
        let mut sum = [0.0; 2];
        let parts = frequencies.big_omegas.into_iter().zip(self.forced);
        for (w, [value, quadrature]) in parts.chain([(frequencies.omega, self.free)]) {
            let fourth = (w * w) * (w * w);
            sum = [sum[0] + fourth * value, sum[1] + fourth * w * quadrature];
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::truth::{derivative, frame};
    use impact_numerics::random::{NormalPairs, Seed};

    /// Values are exact to half the margin, which counts the rounding of two of them.
    #[test]
    fn values_are_within_their_margin() {
        let frequencies = Frequencies::new(1.0, [1.5]);
        for i in 0..3000 {
            let mut normals = NormalPairs::new("margin", Seed(1), i);
            let frame = frame(1.0, [normals.pair(), normals.pair()], &frequencies);
            let s = frequencies.reach * (i as f64 / 3000.0).powi(1 + i as i32 % 9);
            let p = frame.at(s, &frequencies);
            let exact = |order: u32| derivative(&frame, &frequencies, order, s);
            assert!(2.0 * (p.f - exact(0)).abs() <= p.margin, "{i}: {p:?}");
            for (order, value) in (1..).zip([p.d1, p.d2, p.d3]) {
                assert!((value - exact(order)).abs() < 1e-14 * frame.size, "{i}: {order}, {p:?}");
            }
        }
    }

    /// With ω = 2, Ω = 3 and γ = −0.4 the second derivative at rest is 3.6 − 4 α.
    #[test]
    fn a_curvature_below_zero_becomes_one_of_rounding() {
        let frequencies = Frequencies::new(2.0, [3.0]);
        for (alpha, expected) in [(1.0, 0.9 - 1.9 * ROUNDING), (0.8, 0.8)] {
            let mut frame = Frame { alpha, forced: [[-0.4, 0.0]], ..Frame::ZERO };
            frame.prevent_fall(&frequencies);
            assert!((frame.alpha - expected).abs() < 2e-16, "{} {expected}", frame.alpha);
            assert!(frame.start(&frequencies).d2 > 0.0);
        }
    }
}
