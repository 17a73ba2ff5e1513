//! Locates the first roots of many gaps together.

use super::plan::{Phases, Plan};
use super::proof::{Part, SLOW};
use super::slot::{Root, Slot};
use fearless_simd::{f64x8, mask64x8, prelude::*};

/// Gaps with a sign change, of which the first roots are located together.
#[derive(Default)]
pub struct Candidates {
    /// Amplitudes of eight candidates each, or of none: f = 1 has no root.
    eights: Vec<[[f64; 8]; 4]>,
    /// Slots and gaps, with the parts of the step where their roots are.
    members: Vec<(usize, usize, Part)>,
}

impl Candidates {
    #[inline(always)]
    pub fn push(&mut self, amplitudes: [f64; 4], slot: usize, gap: usize, part: Part) {
        let (eight, lane) = (self.members.len() / 8, self.members.len() % 8);
        if lane == 0 {
            self.eights.push([[0.0; 8]; 4]);
        }
        for (row, amplitude) in self.eights[eight].iter_mut().zip(amplitudes) {
            row[lane] = amplitude;
        }
        self.members.push((slot, gap, part));
    }

    /// Locates the first roots of all candidates, eight at a time.
    ///
    /// f(start) > 0 > f(end). One root lies between if the gap is tame, if f'' has one sign, or if
    /// f' has.
    #[inline(always)]
    pub fn locate<S: Simd>(&mut self, simd: S, plan: &Plan, middle: Phases, slots: &mut [Slot]) {
        let Plan { ratio, restitution, half, .. } = *plan;
        let [cos, sin, forced_cos, forced_sin] = middle;
        let (zero, last) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, half));
        for (rows, members) in self.eights.iter().zip(self.members.chunks(8)) {
            let [a, b, c, d] = rows.each_ref().map(|row| f64x8::from_slice(simd, row));
            let start = |lane: usize| members.get(lane).map_or(-half, |(.., part)| part.start);
            let start = f64x8::from_fn(simd, start);
            let (u, q) = (a * cos + b * sin, b * cos - a * sin);
            let (v, z) =
                (c * forced_cos + d * forced_sin, (d * forced_cos - c * forced_sin) * ratio);
            let p = polynomial([u, q, v, z], ratio);
            // The root of the parabola about the middle, then two corrections of third order.
            let inside = p[1] * p[1] - p[0] * p[2] * 4.0;
            let within = |s: f64x8<S>| s.min(last).max(start);
            let mut s = within((p[0] * -2.0) / (p[1] - inside.max(zero).sqrt()));
            let [f, f1, f2] = rough(&p, s);
            s = within(s + correction(f, f1, f2));
            let [f, f1, f2] = full(&p, s);
            let mut step = correction(f, f1, f2);
            s = within(s + step);
            let mut fall = f1 + f2 * step;
            // Rarely more. A lane that has converged stays as it is, whatever its neighbours do.
            let mut turns = 0;
            let mut open = is_open(step, fall, f2);
            while turns < 5 && open.any_true() {
                let [f, f1, f2] = full(&p, s);
                let next = correction(f, f1, f2);
                s = open.select(within(s + next), s);
                fall = open.select(f1 + f2 * next, fall);
                step = open.select(next, step);
                open &= is_open(step, fall, f2);
                turns += 1;
            }
            let sure = fall.simd_lt(-SLOW) & step.abs().simd_le(CONVERGED) & !open;
            let definite = is_definite([u, q, v, z], &p, ratio, half);
            let (sure, definite) = (sure.to_bitmask() as u8, definite.to_bitmask() as u8);
            let square = s * s;
            let co = series(square, COSINE) * square + 1.0;
            let si = series(square, SINE) * square * s + s;
            let jump = fall * -(1.0 + restitution);
            let (s, speed) = (s.as_slice(), (fall * -1.0).to_array());
            let by_sine = (jump * (co * sin + si * cos)).to_array();
            let by_cosine = (jump * (co * cos - si * sin)).to_array();
            for (lane, &(slot, gap, part)) in members.iter().enumerate() {
                let chain = &mut slots[slot];
                if (part.tame || definite >> lane & 1 == 1) && sure >> lane & 1 == 1 {
                    let jump = [by_sine[lane], by_cosine[lane]];
                    let root = Root { s: s[lane], gap, speed: speed[lane], jump };
                    chain.add(root, part.after, half, restitution);
                } else {
                    chain.decide(plan, middle, gap, rows.map(|row| row[lane]), part);
                }
            }
        }
        self.eights.clear();
        self.members.clear();
    }
}

/// Terms of the Taylor polynomial about the middle of a step; the next is below 2e-16 of the
/// amplitudes at the ends.
const TERMS: usize = 12;

/// A correction of third order below this leaves less than rounding, if it is also so short that f'
/// hardly changes on it: it is small near a maximum of f too, which is no root.
const CONVERGED: f64 = 1e-6;
const STRAIGHT: f64 = 1e-4;

/// Coefficients of (cos x − 1)/x² and of (sin x − x)/x³ in x².
const COSINE: [f64; 6] =
    [-1.0 / 2.0, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0, -1.0 / 3_628_800.0, 1.0 / 479_001_600.0];
const SINE: [f64; 6] = [
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
];

#[inline(always)]
fn series<S: Simd>(x: f64x8<S>, k: [f64; 6]) -> f64x8<S> {
    let square = x * x;
    ((x * k[1] + k[0]) + (x * k[3] + k[2]) * square) + (x * k[5] + k[4]) * (square * square)
}

/// Returns the Taylor coefficients of 1 + u cos s + q sin s + v cos ρs + z/ρ sin ρs.
#[inline(always)]
fn polynomial<S: Simd>([u, q, v, z]: [f64x8<S>; 4], ratio: f64) -> [f64x8<S>; TERMS] {
    let mut p = [u; TERMS];
    let (mut factor, mut power) = (1.0, 1.0);
    for (i, p) in p.iter_mut().enumerate() {
        let signed = if i & 2 != 0 { -factor } else { factor };
        *p = if i & 1 != 0 { q + z * power } else { u + v * power } * signed;
        factor /= (i + 1) as f64;
        power *= if i & 1 != 0 { ratio * ratio } else { 1.0 };
    }
    p[0] += 1.0;
    p
}

/// Returns where f'' or f' has one sign within `half` of the middle: it is larger there than its
/// derivative, at most |u| + |q| + ρ² (ρ |v| + |z|) and |u| + |q| + ρ (ρ |v| + |z|), can change it.
#[inline(always)]
fn is_definite<S: Simd>(
    [u, q, v, z]: [f64x8<S>; 4],
    p: &[f64x8<S>; TERMS],
    ratio: f64,
    half: f64,
) -> mask64x8<S> {
    let (free, forced) = (u.abs() + q.abs(), v.abs() * ratio + z.abs());
    let third = (free + forced * (ratio * ratio)) * half;
    let second = (free + forced * ratio) * half;
    (p[2] * 2.0).abs().simd_gt(third) | p[1].abs().simd_gt(second)
}

/// Evaluates f and f' by the first eight terms, and f'' by the first seven.
#[inline(always)]
fn rough<S: Simd>(p: &[f64x8<S>; TERMS], s: f64x8<S>) -> [f64x8<S>; 3] {
    let s2 = s * s;
    let s4 = s2 * s2;
    let f = ((p[0] + p[1] * s) + (p[2] + p[3] * s) * s2)
        + ((p[4] + p[5] * s) + (p[6] + p[7] * s) * s2) * s4;
    let f1 = ((p[1] + p[2] * 2.0 * s) + (p[3] * 3.0 + p[4] * 4.0 * s) * s2)
        + ((p[5] * 5.0 + p[6] * 6.0 * s) + p[7] * 7.0 * s2) * s4;
    let f2 =
        ((p[2] * 2.0 + p[3] * 6.0 * s) + (p[4] * 12.0 + p[5] * 20.0 * s) * s2) + p[6] * 30.0 * s4;
    [f, f1, f2]
}

/// Evaluates f and f' by all terms, the lowest last for the least rounding, and f'' by the first
/// eight.
#[inline(always)]
fn full<S: Simd>(p: &[f64x8<S>; TERMS], s: f64x8<S>) -> [f64x8<S>; 3] {
    let s2 = s * s;
    let s4 = s2 * s2;
    let high = (p[8] + p[9] * s) + (p[10] + p[11] * s) * s2;
    let middle = ((p[4] + p[5] * s) + (p[6] + p[7] * s) * s2) + high * s4;
    let f = p[0] + (p[1] * s + ((p[2] + p[3] * s) * s2 + middle * s4));
    let high = (p[9] * 9.0 + p[10] * 10.0 * s) + p[11] * 11.0 * s2;
    let middle = ((p[5] * 5.0 + p[6] * 6.0 * s) + (p[7] * 7.0 + p[8] * 8.0 * s) * s2) + high * s4;
    let f1 = p[1] + (p[2] * 2.0 * s + ((p[3] * 3.0 + p[4] * 4.0 * s) * s2 + middle * s4));
    let f2 = ((p[2] * 2.0 + p[3] * 6.0 * s) + (p[4] * 12.0 + p[5] * 20.0 * s) * s2)
        + (p[6] * 30.0 + p[7] * 42.0 * s) * s4;
    [f, f1, f2]
}

/// Halley's correction of a root.
#[inline(always)]
fn correction<S: Simd>(f: f64x8<S>, f1: f64x8<S>, f2: f64x8<S>) -> f64x8<S> {
    (f * f1) / (f * f2 * 0.5 - f1 * f1)
}

/// Returns which roots have not converged by a step to them, where f' is `fall` and f'' is `f2`.
#[inline(always)]
fn is_open<S: Simd>(step: f64x8<S>, fall: f64x8<S>, f2: f64x8<S>) -> mask64x8<S> {
    let step = step.abs();
    step.simd_gt(CONVERGED) | (step * f2.abs()).simd_gt(fall.abs() * STRAIGHT)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};

    /// 1 + s + s² + … and its derivatives at 1/2.
    #[test]
    fn polynomials_have_known_values() {
        dispatch!(Level::new(), simd => {
            let (p, s) = ([f64x8::splat(simd, 1.0); TERMS], f64x8::splat(simd, 0.5));
            let sum = |terms: u32, of: fn(f64) -> f64| -> f64 {
                (0..terms).map(|n| of(f64::from(n)) * 0.5_f64.powi(n as i32)).sum()
            };
            for (values, last) in [(rough(&p, s), [8, 7]), (full(&p, s), [12, 8])] {
                let rates = [sum(last[0], |n| 2.0 * n), sum(last[1], |n| 4.0 * n * (n - 1.0))];
                assert_eq!(values.map(|x| x[0]), [sum(last[0], |_| 1.0), rates[0], rates[1]]);
            }
        });
    }

    #[test]
    fn coefficients_and_signs_in_closed_form() {
        dispatch!(Level::new(), simd => {
            let of = |parts: [f64; 4]| parts.map(|x| f64x8::splat(simd, x));
            // 1 + 5 cos s + 7 sin s + 2 cos 3s + sin 3s.
            let p = polynomial(of([5.0, 7.0, 2.0, 3.0]), 3.0).map(|x| x[0]);
            let exact = [8.0, 10.0, -23.0 / 2.0, -34.0 / 6.0, 167.0 / 24.0, 250.0 / 120.0];
            for (i, (coefficient, exact)) in p.into_iter().zip(exact).enumerate() {
                assert!((coefficient - exact).abs() < 1e-14, "{i}: {coefficient} {exact}");
            }
            let last = -(7.0 + 3.0_f64.powi(11)) / 39_916_800.0;
            assert!((p[11] / last - 1.0).abs() < 1e-14, "{p:?}");
            // First and second derivative at the middle against half the bounds of the next: of
            // the parts 1, 2, 0, 0 these are 3 and 3, and of 0, 0, 1, 2 with ρ = 3, 15 and 45.
            for (parts, f1, f2, expected) in [
                ([1.0, 2.0, 0.0, 0.0], 0.0, 1.499, false),
                ([1.0, 2.0, 0.0, 0.0], 0.0, -1.501, true),
                ([1.0, -2.0, 0.0, 0.0], 1.499, 0.0, false),
                ([-1.0, 2.0, 0.0, 0.0], -1.501, 0.0, true),
                ([0.0, 0.0, 1.0, 2.0], 0.0, -22.499, false),
                ([0.0, 0.0, -1.0, 2.0], 0.0, 22.501, true),
                ([0.0, 0.0, 1.0, -2.0], -7.499, 0.0, false),
                ([0.0, 0.0, 1.0, 2.0], 7.501, 0.0, true),
            ] {
                let mut p = [f64x8::splat(simd, 0.0); TERMS];
                (p[1], p[2]) = (f64x8::splat(simd, f1), f64x8::splat(simd, 0.5 * f2));
                let is_definite = is_definite(of(parts), &p, 3.0, 0.5).to_bitmask();
                assert_eq!(is_definite, if expected { 255 } else { 0 }, "{parts:?}, {f1}, {f2}");
            }
        });
    }
}
