//! Decides by itself about a gap of which the tests side by side do not tell.
//!
//! Lengths are in units of d and times in units of 1/ω, so that a gap is
//! f = 1 + u + v with u'' = −u and v'' = −ρ² v, ρ = Ω/ω. M₂ and M₃ are bounds of |f''| and |f'''|.

use super::plan::Phases;
use fearless_simd::{f64x4, mask64x4, prelude::*};

/// A width, in units of d, by which f > 0 has to be proven: more than ten times what rounding can
/// move it, see [`LARGEST`].
pub const MARGIN: f64 = 1e-12;

/// Closing and opening speeds below this, in units of d ω, are left to the engine.
pub const SLOW: f64 = 1e-5;

/// Returns more than the time, in units of 1/ω, by which a width that is off by [`MARGIN`] moves an
/// impact at this speed. Adjacent impacts that are further apart than the sum of theirs are in
/// certain order.
#[inline(always)]
pub fn blur(speed: f64) -> f64 {
    1.25 * MARGIN / speed
}

/// Returns a width above which a gap stays from an impact to the end of the step, `left` later:
/// given f and f' at the end, M₂, whether it is tame, whether it was hit, and the rate at which it
/// opens then.
///
/// It is above the line from zero at that rate, or of a neighbour the tangent at the end, less M₂
/// s²/2 if it is not tame.
#[inline(always)]
pub fn least_width<S: Simd>(
    simd: S,
    [f, rate, bend]: [f64x4<S>; 3],
    [is_tame, is_hit]: [mask64x4<S>; 2],
    opening: f64,
    left: f64,
) -> f64x4<S> {
    let zero = f64x4::splat(simd, 0.0);
    let line = is_hit.select(f64x4::splat(simd, opening * left), f - rate.max(zero) * left);
    line - is_tame.select(zero, bend * (0.5 * left * left))
}

/// The largest amplitudes, in units of d. Each of five terms and the sines in it are rounded by
/// 2⁻⁵³ of an amplitude two or three times: by less than 1e-13 in all.
pub const LARGEST: f64 = 64.0;

/// Steps after which the search of a root gives up.
const TURNS: usize = 200;

/// A gap about the middle of a step: f = 1 + u cos s + q sin s + v cos ρs + z/ρ sin ρs.
pub struct Local {
    u: f64,
    q: f64,
    v: f64,
    z: f64,
    ratio: f64,
}

/// A part of a step: from `start` to `end` after its middle, where `end` is the end of the step.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    pub start: f64,
    pub end: f64,
    /// The time up to which an adjacent gap may have been hit: `start`, or later by rounding.
    pub after: f64,
    /// Whether the gap has just been hit: f(start) = 0 by definition, and f'(start) ≥ [`SLOW`].
    pub just_hit: bool,
    /// Whether 1 − |ρ² − 1| R₂ > M₂ h²/2, for a step of length h.
    ///
    /// Then f has at most one minimum ≤ 0 within a step, and is convex if it has one: from
    /// f(m) ≤ 0 and f'(m) = 0 it rises to M₂ h²/2 at most, and f'' = 1 − f − (ρ² − 1) v is
    /// positive below 1 − |ρ² − 1| R₂.
    pub tame: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    Open,
    /// The first root, and the speed −f' there.
    Root {
        s: f64,
        speed: f64,
    },
    /// Rounding does not tell, or the speed is below [`SLOW`].
    Unsure,
}

impl Local {
    pub fn new(amplitudes: [f64; 4], middle: Phases, ratio: f64) -> Local {
        let ([a, b, c, d], [cos, sin, forced_cos, forced_sin]) = (amplitudes, middle);
        Local {
            u: a * cos + b * sin,
            q: b * cos - a * sin,
            v: c * forced_cos + d * forced_sin,
            z: (d * forced_cos - c * forced_sin) * ratio,
            ratio,
        }
    }

    /// Returns f and f' at s, to rounding for |s| and ρ|s| up to 1/4.
    fn width_and_rate(&self, s: f64) -> [f64; 2] {
        let (cos, sin) = cos_sin(s);
        let (forced_cos, forced_sin) = cos_sin(self.ratio * s);
        let f = 1.0
            + (self.u * cos + self.q * sin)
            + (self.v * forced_cos + self.z / self.ratio * forced_sin);
        let rate = (self.q * cos - self.u * sin)
            + (self.z * forced_cos - self.ratio * self.v * forced_sin);
        [f, rate]
    }

    /// Returns M₂ = R₁ + ρ² R₂.
    fn bend(&self) -> f64 {
        let free = (self.u * self.u + self.q * self.q).sqrt();
        let forced = (self.ratio * self.ratio * self.v * self.v + self.z * self.z).sqrt();
        (free + self.ratio * forced) * (1.0 + 1e-12)
    }

    /// Returns f'' at the middle, and how far it is from that within `half`: M₃ = R₁ + ρ³ R₂, or
    /// more.
    fn curvature(&self, half: f64) -> [f64; 2] {
        let square = self.ratio * self.ratio;
        let third =
            self.u.abs() + self.q.abs() + square * (self.ratio * self.v.abs() + self.z.abs());
        [-(self.u + square * self.v), third * half * (1.0 + 1e-12)]
    }

    /// Finds the first root within a part, or proves that there is none.
    pub fn first_root(&self, part: Part) -> Outcome {
        if self.is_open(part) { Outcome::Open } else { self.step_to_root(part) }
    }

    /// Returns whether a test of both ends proves that there is no root.
    fn is_open(&self, Part { start, end, just_hit, tame, .. }: Part) -> bool {
        let ([f0, rate0], [f1, rate1]) = (self.width_and_rate(start), self.width_and_rate(end));
        if f1 <= MARGIN || !just_hit && f0 <= MARGIN {
            return false;
        }
        let [curvature, change] = self.curvature(end);
        if tame || curvature > change {
            // Convex where it counts: above both tangents. A root after an opening would need a
            // maximum below 1 − |ρ² − 1| R₂ between the two.
            let meet =
                (f1 - MARGIN) * rate0 - (f0 - MARGIN) * rate1 - rate1 * rate0 * (end - start);
            return rate0 >= 0.0 || rate1 <= 0.0 || meet < 0.0;
        }
        if curvature < -change {
            // Concave: not below the chord.
            return true;
        }
        // Above the parabolas with curvature −M₂ from both ends to the middle.
        let half = 0.5 * (end - start);
        let sunk = 0.5 * self.bend() * half * half + MARGIN;
        f0 + rate0 * half > sunk && f1 - rate1 * half > sunk
    }

    /// Goes by steps without a root to the first root or the end, as f(t + s) ≥ f + f' s − M₂ s²/2.
    fn step_to_root(&self, Part { start, end, just_hit, .. }: Part) -> Outcome {
        let bend = self.bend();
        let mut s = start;
        for turn in 0..TURNS {
            let [f, rate] = self.width_and_rate(s);
            let opens = just_hit && turn == 0;
            let width = f - MARGIN;
            if opens {
                // Up to the greatest width of the parabola from zero, more than 1e-10.
                if rate < 0.5 * SLOW {
                    return Outcome::Unsure;
                }
                s += rate / bend;
            } else if width <= MARGIN {
                // f is too small to go on: it crosses zero here, as f + f' s + M₂ s²/2 does, or
                // rounding does not tell.
                if rate > -SLOW || rate * rate < 4.0 * bend * MARGIN {
                    return Outcome::Unsure;
                }
                let polished = |s: f64| {
                    let [f, rate] = self.width_and_rate(s);
                    (s - f / rate, rate)
                };
                let (s, rate) = polished(polished(polished(s).0).0);
                return Outcome::Root { s, speed: -rate };
            } else {
                let root = (rate * rate + 2.0 * bend * width).sqrt();
                s += if rate < 0.0 { 2.0 * width / (root - rate) } else { (rate + root) / bend };
            }
            if s >= end {
                return Outcome::Open;
            }
        }
        Outcome::Unsure
    }
}

/// Returns cos x and sin x by their Taylor polynomials, whose next terms are below 2e-16 for
/// |x| ≤ 1/4.
pub fn cos_sin(x: f64) -> (f64, f64) {
    let y = x * x;
    let cos = 1.0
        - y * (1.0 / 2.0
            - y * (1.0 / 24.0
                - y * (1.0 / 720.0 - y * (1.0 / 40_320.0 - y * (1.0 / 3_628_800.0)))));
    let sin = x
        * (1.0
            - y * (1.0 / 6.0
                - y * (1.0 / 120.0
                    - y * (1.0 / 5040.0 - y * (1.0 / 362_880.0 - y * (1.0 / 39_916_800.0))))));
    (cos, sin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};
    use impact_numerics::random::{NormalPairs, Seed};
    use impact_numerics::roots::bracket;

    /// Returns the gap with a forced part, and with this width and rate at s.
    fn gap_with(width: f64, rate: f64, s: f64, [v, z]: [f64; 2], ratio: f64) -> Local {
        let forced = Local { u: 0.0, q: 0.0, v, z, ratio }.width_and_rate(s);
        let (free, free_rate) = (width - forced[0], rate - forced[1]);
        let (cos, sin) = cos_sin(s);
        let (u, q) = (free * cos - free_rate * sin, free * sin + free_rate * cos);
        Local { u, q, v, z, ratio }
    }

    /// No dip below zero is called open, a root is the first, and few are left undecided.
    #[test]
    fn dips_of_known_depth() {
        let (half, mut seen) = (0.125, [0; 4]);
        for i in 0..60_000u64 {
            let mut normals = NormalPairs::new("dips", Seed(1), i);
            let ([size, place], [v, z]) = (normals.pair(), normals.pair());
            let ratio = [0.6, 1.4, 1.9][i as usize % 3];
            let depth = 10.0_f64.powi(-1 - (i / 3 % 11) as i32) * [1.0, -1.0][i as usize / 33 % 2];
            let just_hit = i % 5 == 0;
            let start = if i % 2 == 0 { -half } else { (0.05 * place).clamp(-half, 0.1) };
            let forced = [v, z].map(|x| x * (0.4 * size).abs());
            let gap = if just_hit {
                gap_with(0.0, depth.abs().max(2.0 * SLOW), start, forced, ratio)
            } else {
                gap_with(depth, 0.0, start + (half - start) * (0.5 + 0.3 * place), forced, ratio)
            };
            let reach = ratio * ratio * forced[0].hypot(forced[1] / ratio);
            let tame = (ratio * ratio - 1.0).abs() / (ratio * ratio) * reach
                + 0.5 * gap.bend() * (2.0 * half) * (2.0 * half)
                < 1.0;
            if !just_hit && gap.width_and_rate(start)[0] <= 0.0 {
                continue;
            }
            let outcome = gap.first_root(Part { start, end: half, after: start, just_hit, tame });
            let until = if let Outcome::Root { s, .. } = outcome { s } else { half };
            let sample = |k: u32| start + (until - start) * f64::from(k) / 1000.0;
            let least =
                (1..1000).map(|k| gap.width_and_rate(sample(k))[0]).fold(f64::INFINITY, f64::min);
            match outcome {
                Outcome::Open => assert!(least > 0.0, "{i} {depth:e} {least:e}"),
                Outcome::Root { s, speed } => {
                    let [width, rate] = gap.width_and_rate(s);
                    assert!(least > -1e-12 && width.abs() < 1e-14, "{i} {depth:e} {least:e}");
                    assert!((speed + rate).abs() < 1e-9 && speed > 0.9 * SLOW, "{i} {speed}");
                }
                Outcome::Unsure => assert!(depth.abs() < 1e-5, "{i} {depth:e} {just_hit}"),
            }
            let kind = if matches!(outcome, Outcome::Open) { usize::from(tame) } else { 2 };
            seen[if matches!(outcome, Outcome::Unsure) { 3 } else { kind }] += 1;
        }
        assert!(seen.iter().all(|&number| number > 1000), "{seen:?}");
    }

    #[test]
    fn bounds_of_all_parts() {
        let gap = Local { u: 3.0, q: -4.0, v: -2.0, z: 8.0, ratio: 3.0 };
        let [second, change] = gap.curvature(0.125);
        for (bound, exact) in [(second, 15.0), (8.0 * change, 133.0), (gap.bend(), 35.0)] {
            assert!((0.0..2e-12).contains(&(bound / exact - 1.0)), "{bound} {exact}");
        }
    }

    /// Tangents of a convex gap, or parabolas of curvature −M₂, have to meet above the margin.
    #[test]
    fn gaps_that_are_open_by_their_ends() {
        let (start, end) = (-0.125, 0.125);
        let part = Part { start, end, after: start, just_hit: false, tame: false };
        for (rate, place, v) in [(0.0, 0.03, 0.0), (-0.1, 0.0, 0.34), (0.1, 0.0, 0.34)] {
            let gap = |width: f64| gap_with(width, rate, place, [v, 0.0], 2.0);
            let height = |width: f64| {
                let gap = gap(width);
                let ([f0, rate0], [f1, rate1]) =
                    (gap.width_and_rate(start), gap.width_and_rate(end));
                let bend = gap.u.hypot(gap.q) + 4.0 * gap.v.hypot(gap.z / 2.0);
                match v {
                    0.0 => f0 + rate0 * (f1 - f0 - 0.25 * rate1) / (rate0 - rate1),
                    _ => (f0 + rate0 / 8.0).min(f1 - rate1 / 8.0) - bend / 128.0,
                }
            };
            let [_, width] = bracket(0.0, 1.0, |width| height(width) > MARGIN);
            assert!(gap(width + 1e-13).is_open(part), "{rate} {v}: {width}");
            assert!(!gap(width - 1e-13).is_open(part), "{rate} {v}: {width}");
        }
        let (hit, tame) = (Part { just_hit: true, ..part }, Part { tame: true, ..part });
        for (width, rate, place, v, part) in [
            (0.05, 0.0, 0.0, 2.0, part),
            (0.0, 0.1, start, 0.0, hit),
            (0.5, 2.0, start, 2.0, tame),
            (0.5, -2.0, end, 2.0, tame),
        ] {
            assert!(gap_with(width, rate, place, [v, 0.0], 2.0).is_open(part), "{width} {rate}");
        }
        assert!(!gap_with(0.9 * MARGIN, 0.1, start, [0.0; 2], 2.0).is_open(part));
    }

    /// A dip that turns 1.05e-12 above zero, steeply on both sides, is no root.
    #[test]
    fn a_sharp_dip_is_no_root() {
        let (u, q) = (5.475_725_649_221_678, 0.066_909_719_374_661_39);
        let (v, z) = (-6.471_784_006_246_018, -0.712_011_512_733_158_9);
        let gap = Local { u, q, v, z, ratio: 3.0 };
        let (start, end) = (-0.0625, 0.0625);
        let part = Part { start, end, after: start, just_hit: false, tame: false };
        assert!(!matches!(gap.first_root(part), Outcome::Root { .. }));
    }

    /// A tame neighbour, the gap that was hit, and two not tame: one is narrowest at the end.
    #[test]
    fn least_widths_after_an_impact() {
        dispatch!(Level::new(), simd => {
            let four = |row: [f64; 4]| f64x4::from_slice(simd, &row);
            let ends = [[5.0; 4], [2.0, 2.0, 2.0, -2.0], [3.0; 4]].map(four);
            let masks = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]].map(|row| four(row).simd_gt(0.0));
            let widths = least_width(simd, ends, masks, 7.0, 0.5).to_array();
            assert_eq!(widths, [4.0, 3.125, 3.625, 4.625]);
        });
    }
}
