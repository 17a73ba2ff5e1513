//! Certifies quickly that a function is positive over a piece of its frame, or has one root.
//!
//! On a piece [a, a + w] the function f is compared with the polynomial p of degree seven that
//! shares its value and first three derivatives at both ends (Hermite). The difference is at most
//! M₈ (s − a)⁴ (a + w − s)⁴ / 8!, a polynomial of degree eight with one Bernstein
//! coefficient, so q, p minus the difference, is below f and its nine Bernstein coefficients bound
//! it from below. They are linear in f₀, g₀, α, γ and δ, with factors by frequencies and
//! piece alone, which are tabulated once.

use super::linear::{Linear, Taylor};
use super::local_frame::{Frame, Frequencies};
use super::pair::{self, Pair, less, min, select, splat};

/// Degree of the Bernstein form.
const N: usize = 8;

/// One number for each of the coefficients b₁ … b₈.
type CoefficientPairs = [Pair; N / 2];

/// The values of a function at the ends of the eighths of the reach.
#[derive(Clone, Copy, Debug)]
pub struct Eighths<const M: usize> {
    values: Linear<M, { N / 2 }>,
    width: f64,
}

impl<const M: usize> Eighths<M> {
    pub fn new(frequencies: &Frequencies<M>) -> Self {
        let width = 0.125 * frequencies.reach;
        let values = Linear::new(frequencies, |f| {
            row(std::array::from_fn(|i| f((i + 1) as f64 * width)[0]))
        });
        Eighths { values, width }
    }

    /// Guesses the root of a function that falls below zero once, by the secant over the eighth in
    /// which it changes sign.
    #[inline(always)]
    pub fn guess(&self, frame: &Frame<M>) -> f64 {
        let row = self.values.evaluate(frame).map(|x| x + splat(frame.f0));
        let below = sign_bits(row.map(|x| less(x, splat(0.0))));
        let [[a, b], [c, d], [e, f], [g, h]] = row.map(Pair::to_array);
        let values = [frame.f0, a, b, c, d, e, f, g, h];
        // Bit i is set if values[i + 1] is below zero, so at the lowest set bit values[i] is the
        // last positive one; bit 7 is always set, so that there is one.
        let last_positive = (below | 1 << (N - 1)).trailing_zeros() as usize % N;
        let (high, low) = (values[last_positive], values[last_positive + 1]);
        self.width * (last_positive as f64 + high / (high - low))
    }
}

/// Packs the results of eight comparisons into one bit each.
#[inline(always)]
fn sign_bits(masks: CoefficientPairs) -> u32 {
    let [a, b, c, d] = masks.map(|mask| pair::signs(mask) as u32);
    (a | b << 2) | (c << 4 | d << 6)
}

/// A part of the reach on which functions are bounded from below, with the factors of its
/// coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Piece<const M: usize> {
    /// a, where the piece begins.
    pub start: f64,
    /// w, its width.
    pub width: f64,
    factors: Linear<M, { N / 2 }>,
    /// (0, most that b₄ falls by, over M₄): what the difference of f and p takes from b₃ and b₄.
    difference_over_bound: Pair,
    /// The largest effect of the same difference on b_{i+1} − b_i, over M₄.
    difference_of_neighbours: f64,
}

/// The Bernstein coefficients b₁ … b₈ of q over a piece.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients {
    row: CoefficientPairs,
    /// Twice a bound of the rounding of each.
    slack: f64,
}

/// Returns C(i, k) k! (8 − k)!/8! wᵏ: the factor of the k-th Taylor coefficient in the i-th
/// Bernstein coefficient.
fn weight(i: usize, k: usize, w: f64) -> f64 {
    (0..k).fold(1.0, |product, m| product * ((i - m) as f64 * w / (N - m) as f64))
}

/// Returns b₁ … b₈ of the Hermite polynomial to value and three derivatives at both ends.
fn hermite(left: Taylor, right: Taylor, w: f64) -> CoefficientPairs {
    let mut b = [0.0; N + 1];
    for i in 0..4 {
        for k in 0..=i {
            b[i] += weight(i, k, w) * left[k];
            b[N - i] += weight(i, k, -w) * right[k];
        }
    }
    // Degree seven: the eighth difference vanishes.
    b[4] =
        (56.0 * (b[3] + b[5]) - 28.0 * (b[2] + b[6]) + 8.0 * (b[1] + b[7]) - (b[0] + b[8])) / 70.0;
    row(b[1..].try_into().expect("eight of nine"))
}

fn row(b: [f64; N]) -> CoefficientPairs {
    std::array::from_fn(|i| Pair::from([b[2 * i], b[2 * i + 1]]))
}

impl<const M: usize> Piece<M> {
    /// Tabulates the piece that begins at `start` and is `width` wide, within the reach.
    pub fn new(start: f64, width: f64, frequencies: &Frequencies<M>) -> Self {
        let end = start + width;
        let fast2 = frequencies.fastest * frequencies.fastest;
        let width2 = width * width;
        let remainder = fast2 * fast2 * (width2 * width2) * (width2 * width2) / 40_320.0;
        Piece {
            start,
            width,
            factors: Linear::new(frequencies, |f| hermite(f(start), f(end), width)),
            difference_over_bound: Pair::from([0.0, remainder / 70.0]),
            // |f' − p'| ≤ M₈ max |t³ (w − t)³ (t − ξ)|/7! ≤ M₈ w⁷/(64 · 7!), times w/8.
            difference_of_neighbours: remainder / 64.0,
        }
    }

    /// Bounds f − q, rounding included.
    #[inline(always)]
    pub fn largest_difference(&self, frame: &Frame<M>) -> f64 {
        // f − q ≤ 2 M₈ (w/2)⁸/8!, which is 140/256 of b₄'s part, so b₄'s part is enough.
        let [_, difference] = self.difference_over_bound.to_array();
        frame.bound * difference + SLACK * frame.size
    }

    /// Computes the coefficients b₁ … b₈ of q over this piece; b₀ is f(a).
    #[inline(always)]
    pub fn coefficients(&self, frame: &Frame<M>) -> Coefficients {
        let mut row = self.factors.evaluate(frame).map(|x| x + splat(frame.f0));
        row[1] += splat(-frame.bound) * self.difference_over_bound;
        Coefficients { row, slack: SLACK * frame.size }
    }

    /// Guesses the root, from the frame's instant, or returns `None` if the coefficients do not
    /// show that f falls throughout, from `first` to below zero.
    #[inline(always)]
    pub fn only_root(&self, frame: &Frame<M>, first: f64, c: &Coefficients) -> Option<f64> {
        let [b1, b2, b3, b4, b5, b6, b7, b8] = c.to_array();
        let before = [[first, b1], [b2, b3], [b4, b5], [b6, b7]].map(Pair::from);
        let slack = splat(c.slack + self.difference_of_neighbours * frame.bound);
        let falls: [Pair; N / 2] = std::array::from_fn(|i| less(c.row[i], before[i] - slack));
        let all_fall = pair::signs((falls[0] & falls[1]) & (falls[2] & falls[3])) == 0b11;
        if !all_fall || b8 >= -c.slack {
            return None;
        }
        // The parabola of p at the end nearer to zero, by a mask: no processor can predict which.
        let at_left = less(splat(first), splat(-b8));
        let nearer = |left: [f64; 2], right: [f64; 2]| {
            select(at_left, Pair::from(left), Pair::from(right)).to_array()
        };
        let [near, next] = nearer([first, b1], [b8, b7]);
        let [third, _] = nearer([b2; 2], [b6; 2]);
        let slope = 8.0 * (near - next);
        let curvature = 56.0 * (near - 2.0 * next + third);
        let root = (slope * slope - 2.0 * near * curvature).max(0.0).sqrt();
        // Inwards, f falls from the left end and rises from the right one.
        let inwards = 2.0 * near.abs() / (slope.abs() + root);
        let inwards = inwards.min(1.0);
        let [inside, _] = nearer([inwards; 2], [1.0 - inwards; 2]);
        Some(self.start + self.width * inside)
    }
}

/// Rounding of a coefficient, in units of the frame's size: at most a dozen roundings of terms that
/// are each below a few sizes. Few of them add up: in tests b₁ and b₈ are off by less than half.
const SLACK: f64 = 64.0 * f64::EPSILON;

impl Coefficients {
    /// Returns whether b₁ … b₈ are positive beyond rounding, so f > 0 on (a, a + w] if f(a) ≥ 0.
    #[inline(always)]
    pub fn are_positive(&self) -> bool {
        let [a, b, c, d] = self.row;
        let least = min(min(a, b), min(c, d));
        pair::signs(less(splat(self.slack), least)) == 0b11
    }

    /// Returns whether the signs of b₁ … b₈, not all plus, change at most once, from plus to minus.
    #[inline(always)]
    pub fn change_sign_once(&self) -> bool {
        let plus = sign_bits(self.row.map(|b| less(splat(self.slack), b)));
        let minus = sign_bits(self.row.map(|b| less(b, splat(-self.slack))));
        // Plus from the lowest bit on, and minus all others.
        (plus & (plus + 1) == 0) & (plus + minus == (1 << N) - 1)
    }

    /// Returns b₈, the value at the end of the piece.
    #[inline(always)]
    pub fn last(&self) -> f64 {
        self.row[N / 2 - 1].to_array()[1]
    }

    #[inline(always)]
    fn to_array(self) -> [f64; N] {
        let [[a, b], [c, d], [e, f], [g, h]] = self.row.map(Pair::to_array);
        [a, b, c, d, e, f, g, h]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::truth::{derivative, frame};
    use impact_numerics::random::{NormalPairs, Seed};

    /// Where |f⁽⁸⁾| = M₈, q is not above f, and touches it within a tenth of the remainder.
    #[test]
    fn the_polynomial_below_a_function_touches_it() {
        let frequencies = Frequencies::new(1.0, [1.5]);
        for (k, sign) in (0..7).flat_map(|k| [(k, -1.0), (k, 1.0)]) {
            let parts = 1u32 << (k + 1u32).ilog2();
            let width = frequencies.reach / f64::from(parts);
            let piece = Piece::new(f64::from(k + 1 - parts) * width, width, &frequencies);
            let (sin, cos) = (1.5 * (piece.start + 0.5 * width)).sin_cos();
            let frame = frame(0.0, [[0.0; 2], [sign * cos, sign * sin]], &frequencies);
            let at = |u: f64| derivative(&frame, &frequencies, 0, piece.start + u * width);
            let above = |u: f64| {
                let mut b = [&[at(0.0)], &piece.coefficients(&frame).to_array()[..]].concat();
                while b.len() > 1 {
                    b = b.windows(2).map(|two| two[0] + u * (two[1] - two[0])).collect();
                }
                at(u) - b[0]
            };
            for u in (0..=32).map(|i| f64::from(i) / 32.0) {
                let within = -2e-15..piece.largest_difference(&frame);
                assert!(within.contains(&above(u)), "{k}, {sign}, {u}: {:e}", above(u));
            }
            let remainder = (0.75 * width).powi(8) / 40_320.0;
            assert!(parts < 4 || above(0.5) < (1.1 + sign) * remainder, "{k}: {}", above(0.5));
        }
    }

    #[test]
    fn roundings_are_below_half_the_slack() {
        let frequencies = Frequencies::new(1.0, [1.5]);
        let mut normals = NormalPairs::new("slack", Seed(1), 0);
        for _ in 0..300 {
            let frame = frame(1.0, [normals.pair(), normals.pair()], &frequencies);
            let c = Piece::new(0.5, 0.7, &frequencies).coefficients(&frame);
            let exact = |order, s| derivative(&frame, &frequencies, order, s);
            let off = c.to_array()[0] - (exact(0, 0.5) + 0.7 * exact(1, 0.5) / 8.0);
            for off in [off, c.last() - exact(0, 0.5 + 0.7)] {
                assert!(2.0 * off.abs() <= c.slack, "{off:e}, {:e}", c.slack);
            }
        }
    }

    /// All patterns of coefficients below, within and above the slack.
    #[test]
    fn signs_are_read_beyond_the_slack() {
        for pattern in 0..3usize.pow(8) {
            let signs: [usize; 8] = std::array::from_fn(|i| pattern / 3usize.pow(i as u32) % 3);
            let c = Coefficients { row: row(signs.map(|sign| [-0.6, 0.5, 0.6][sign])), slack: 0.5 };
            let plus = signs.iter().take_while(|sign| **sign == 2).count();
            assert_eq!(c.are_positive(), plus == 8, "{signs:?}");
            let once = signs[plus..].iter().all(|sign| *sign == 0);
            assert_eq!(c.change_sign_once(), once, "{signs:?}");
        }
    }

    /// f falls where each coefficient is below the one before by M₈ w⁸/(64 · 8!).
    #[test]
    fn a_function_that_may_rise_has_no_only_root() {
        let piece = Piece::new(0.0, 0.7, &Frequencies::new(1.0, [1.5]));
        let least = 1.5_f64.powi(4) * 0.7_f64.powi(8) / 40_320.0 / 64.0;
        for (i, fall, expected) in (0..8).flat_map(|i| [(i, 0.499, true), (i, 0.501, false)]) {
            let mut b: [f64; 8] = std::array::from_fn(|i| 3.5 - i as f64);
            b[i] += 0.5;
            let c = Coefficients { row: row(b), slack: 0.0 };
            let frame = Frame { bound: fall / least, ..Frame::ZERO };
            assert_eq!(piece.only_root(&frame, 4.5, &c).is_some(), expected, "{i}, {fall}");
        }
    }
}
