//! Finds a root to full accuracy from a guess by the Taylor polynomial about the nearest node.
//!
//! The Taylor coefficients of f about a node are linear in the frame of f ([`Linear`]). At the
//! first node, s = 0, they are exact, so a short wait keeps its relative accuracy.

use super::linear::Linear;
use super::local_frame::{Frame, Frequencies};
use super::outcome::Counters;
use super::pair::{Pair, splat};

/// Nodes over the reach, both ends included; a power of two.
const NODES: usize = 32;

/// The largest distance from a node of use, over the fastest frequency: the remainder is
/// 0.06¹⁰/10! < 2e-19 of f's size and 0.06⁹/9! < 3e-17 of its slope's. Nodes are 0.092 apart.
/// Up to some 0.15 the remainder is below rounding, and no test can tell.
const RADIUS: f64 = 0.06;

#[derive(Clone, Debug)]
pub struct Nodes<const M: usize> {
    nodes: [Linear<M, 5>; NODES],
    reach: f64,
    spacing: f64,
    per_time: f64,
    radius: f64,
}

/// The largest number of steps; they converge with order four.
const STEPS: u32 = 4;

impl<const M: usize> Nodes<M> {
    pub fn new(frequencies: &Frequencies<M>) -> Self {
        let spacing = frequencies.reach / (NODES - 1) as f64;
        Nodes {
            nodes: std::array::from_fn(|i| {
                Linear::new(frequencies, |f| {
                    let c = f(i as f64 * spacing);
                    std::array::from_fn(|k| Pair::from([c[2 * k], c[2 * k + 1]]))
                })
            }),
            reach: frequencies.reach,
            spacing,
            per_time: 1.0 / spacing,
            radius: RADIUS / frequencies.fastest,
        }
    }

    /// Returns the root near `guess`, 0 ≤ `guess` ≤ reach, and −f' there, or `None` if no root is
    /// near.
    #[inline(always)]
    pub fn root(&self, frame: &Frame<M>, guess: f64, work: &mut Counters) -> Option<(f64, f64)> {
        let mut s = guess;
        for _ in 0..STEPS {
            work.evaluations += 1;
            // The nearest whole number stands in the last bits of the sum.
            let number = s * self.per_time + (1u64 << 52) as f64;
            let index = number.to_bits() as usize % NODES;
            let node = index as f64 * self.spacing;
            let mut taylor = Taylor(self.nodes[index].evaluate(frame));
            taylor.0[0] += Pair::from([frame.f0, 0.0]);
            let mut h = s - node;
            for _ in 0..STEPS {
                if h.abs() > self.radius {
                    break;
                }
                let [value, slope, bend, twist] = taylor.about(h);
                // The inverse of the polynomial to fourth order.
                let inverse = 1.0 / slope;
                let newton = -value * inverse;
                let (second, third) =
                    (newton * (bend * inverse), newton * newton * (twist * inverse));
                let step = newton * (1.0 - second + (2.0 * second * second - third));
                h += step;
                if step.abs() <= 6e-5 * self.radius && second.abs() <= 1e-4 {
                    let speed = -(slope + step * (2.0 * bend + step * (3.0 * twist)));
                    return Some((node + h, speed));
                }
            }
            s = node + h;
            if !(s > 0.0 && s < self.reach) {
                break;
            }
        }
        None
    }
}

/// A Taylor polynomial of degree nine, with its coefficients of even and odd order in pairs.
struct Taylor([Pair; 5]);

impl Taylor {
    /// Returns the Taylor coefficients about h, up to the third.
    #[inline(always)]
    fn about(&self, h: f64) -> [f64; 4] {
        let c = &self.0;
        let square = splat(h * h);
        let fourth = square * square;
        let sum = |x: Pair| {
            let [even, odd] = x.to_array();
            even + h * odd
        };
        // (c₁, c₂), (c₃, c₄), …
        let next: [Pair; 4] =
            std::array::from_fn(|i| Pair::from([c[i].to_array()[1], c[i + 1].to_array()[0]]));
        let times = |x: Pair, a: f64, b: f64| x * Pair::from([a, b]);
        let value = (c[0] + square * c[1]) + fourth * ((c[2] + square * c[3]) + fourth * c[4]);
        let slope = (times(next[0], 1.0, 2.0) + square * times(next[1], 3.0, 4.0))
            + fourth
                * ((times(next[2], 5.0, 6.0) + square * times(next[3], 7.0, 8.0))
                    + fourth * Pair::from([9.0 * c[4].to_array()[1], 0.0]));
        let bend = (times(c[1], 1.0, 3.0) + square * times(c[2], 6.0, 10.0))
            + fourth * (times(c[3], 15.0, 21.0) + square * times(c[4], 28.0, 36.0));
        let twist = (times(next[1], 1.0, 4.0) + square * times(next[2], 10.0, 20.0))
            + fourth * times(next[3], 35.0, 56.0);
        [sum(value), sum(slope), sum(bend), sum(twist)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::truth::{derivative, frame};
    use impact_numerics::random::{NormalPairs, Seed};

    #[test]
    fn roots_are_right_to_rounding_from_far_guesses() {
        let frequencies = Frequencies::new(1.0, [1.5]);
        let (nodes, mut roots) = (Nodes::new(&frequencies), 0);
        for i in 0..3000 {
            let mut normals = NormalPairs::new("nodes", Seed(1), i);
            let frame = frame(0.5, [normals.pair(), normals.pair()], &frequencies);
            let guess = frequencies.reach * (i as f64 / 3000.0);
            if let Some((s, speed)) = nodes.root(&frame, guess, &mut Counters::default()) {
                let [f, slope] = [0, 1].map(|order| derivative(&frame, &frequencies, order, s));
                let off = [f, slope + speed].map(|off| off.abs() / (f64::EPSILON * frame.size));
                assert!(off[0] < 3.0 && off[1] < 30.0, "{i}: {off:?} units at {s}");
                roots += 1;
            }
        }
        assert!(roots > 1000, "{roots}");
    }
}
