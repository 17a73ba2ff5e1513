//! Computes sine and cosine by plain + − × only, so with the same bits on every machine.

use super::pair::{Pair, abs, less, max, min, select, splat};

/// Largest |x| for which [`small_sin_cos`] is meant.
pub const RANGE: f64 = 2.83;

const TERMS: usize = 14;

/// What is added to the first Taylor coefficients of (x − sin x)/x³ and (1 − cos x)/x².
///
/// 1/3!, 1/5! and 1/4! are not doubles. Their rounding errors alone would make the sine too large
/// and the cosine by 2e-16 at [`RANGE`], always to the same side, and a chain without forcing would
/// lose 1e-17 of its energy an impact. The coefficients after them take these errors up: least
/// squares over 0 ≤ x ≤ [`RANGE`], one coefficient after the other rounded. What is left of the
/// polynomial's error is below 3e-18.
const ADDED: [[f64; 2]; 6] = [
    [0.0, 0.0],
    [1.214306433183765e-17, 0.0],
    [-5.854691731421724e-18, -1.951563910473908e-18],
    [1.2938428269309438e-18, 5.522654816098038e-19],
    [-1.3453265482562442e-19, -6.829203137237796e-20],
    [5.330843005780414e-21, 3.0580867246085433e-21],
];

/// Coefficients of (sin x − x)/x³ and (1 − cos x)/x² in x²: −1/3!, 1/5!, … up to x^29 of the sine,
/// and 1/2!, −1/4!, … up to x^28 of the cosine. Factorials beyond 18! are rounded in a double,
/// which changes the sums by less than 1e-24.
const TABLE: [[f64; 2]; TERMS] = {
    let mut table = [[0.0; 2]; TERMS];
    let (mut odd, mut even) = (6.0, 2.0);
    let mut k = 0;
    while k < TERMS {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let [sine, cosine] = if k < ADDED.len() { ADDED[k] } else { [0.0; 2] };
        table[k] = [-(sign / odd + sine), sign / even + cosine];
        let n = (2 * k + 2) as f64;
        odd *= (n + 2.0) * (n + 3.0);
        even *= (n + 1.0) * (n + 2.0);
        k += 1;
    }
    table
};

/// Evaluates both polynomials of [`TABLE`] at z, in one register of two.
#[inline(always)]
fn polynomials(z: Pair) -> Pair {
    let square = z * z;
    // Even and odd powers apart: half the length of each chain of dependent operations.
    let mut even = Pair::from(TABLE[TERMS - 2]);
    let mut odd = Pair::from(TABLE[TERMS - 1]);
    for k in (0..TERMS / 2 - 1).rev() {
        even = even * square + Pair::from(TABLE[2 * k]);
        odd = odd * square + Pair::from(TABLE[2 * k + 1]);
    }
    even + z * odd
}

/// Evaluates the first eight rows, enough for a quarter turn: the first omitted ones are below
/// 1e-19 and 3e-18. The order has the least latency, since all work at an event waits for phases.
#[inline(always)]
fn quarter_polynomials(z: Pair) -> Pair {
    let square = z * z;
    let pair = |k: usize| Pair::from(TABLE[k]) + z * Pair::from(TABLE[k + 1]);
    (pair(0) + square * pair(2)) + (square * square) * (pair(4) + square * pair(6))
}

/// Returns sin x − x and 1 − cos x, given one of the two functions above.
#[inline(always)]
fn remainders(x: f64, polynomials: impl Fn(Pair) -> Pair) -> [f64; 2] {
    let z = x * x;
    (polynomials(splat(z)) * Pair::from([z * x, z])).to_array()
}

/// Returns sin x − x and 1 − cos x for |x| ≤ [`RANGE`], each to a few units in its last place.
/// The omitted terms are below 2.83^31/31! < 2e-20 and 2.83^30/30! < 2e-19.
#[inline(always)]
pub fn small_sin_cos(x: f64) -> [f64; 2] {
    remainders(x, polynomials)
}

/// Returns (sin, cos) of a phase in units of 2^-64 turns, to 1.2 units of 2^-53. The reduction to
/// the nearest quarter turn is exact integer arithmetic.
#[inline(always)]
pub fn sin_cos_turn(turn: u64) -> (f64, f64) {
    const QUARTER: u64 = 1 << 62;
    const RADIANS: f64 = std::f64::consts::TAU / (1u128 << 64) as f64;
    let shifted = turn.wrapping_add(QUARTER / 2);
    let remainder = (shifted % QUARTER) as i64 - (QUARTER / 2) as i64;
    let x = remainder as f64 * RADIANS;
    let [s, c] = remainders(x, quarter_polynomials);
    let (sin, cos) = (x + s, 1.0 - c);
    // The quarter swaps the two and sets their signs; a branch here could not be predicted.
    let quarter = shifted >> 62;
    let swap = 0u64.wrapping_sub(quarter & 1);
    let (a, b) = (sin.to_bits(), cos.to_bits());
    let change = (a ^ b) & swap;
    let sin = a ^ change ^ (quarter >> 1) << 63;
    let cos = b ^ change ^ ((quarter ^ quarter >> 1) & 1) << 63;
    (f64::from_bits(sin), f64::from_bits(cos))
}

/// Coefficients of arctan x over x in x², 0 ≤ x ≤ 1, at Chebyshev's points: off by 1.6e-9.
const ARCTAN: [f64; 10] = [
    0.9999999972,
    -0.3333327629,
    0.1999807528,
    -0.1426001608,
    0.1093234149,
    -0.08349724925,
    0.05708955519,
    -0.03035186404,
    0.01048764885,
    -0.001701169973,
];

/// Returns the angles of two vectors, in [−π, π] and to 2e-9, for windows widened by more.
#[inline(always)]
pub fn rough_angles(y: Pair, x: Pair) -> Pair {
    use std::f64::consts::{FRAC_PI_2, PI};
    let (across, along) = (abs(y), abs(x));
    let slope = min(across, along) / max(across, along);
    let square = slope * slope;
    let fourth = square * square;
    let pair = |k: usize| splat(ARCTAN[k]) + square * splat(ARCTAN[k + 1]);
    let sum =
        pair(0) + fourth * (pair(2) + fourth * (pair(4) + fourth * (pair(6) + fourth * pair(8))));
    let angle = slope * sum;
    let zero = splat(0.0);
    let angle = select(less(along, across), splat(FRAC_PI_2) - angle, angle);
    let angle = select(less(x, zero), splat(PI) - angle, angle);
    select(less(y, zero), zero - angle, angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rough_angles_are_within_their_bound() {
        for i in -9999..=9999 {
            let x = f64::from(i) * std::f64::consts::PI / 1e4;
            let [angle, _] = rough_angles(splat(3.0 * x.sin()), splat(3.0 * x.cos())).to_array();
            assert!((angle - x).abs() < 2e-9, "{x}: {angle}");
        }
    }

    #[test]
    fn a_turn_is_reduced_exactly() {
        for i in 0..100_000u64 {
            let turn = i.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let (s, c) = sin_cos_turn(turn);
            let x = turn as i64 as f64 / (1u128 << 64) as f64 * std::f64::consts::TAU;
            assert!((s - pxfm::f_sin(x)).abs() < 7e-16);
            assert!((c - pxfm::f_cos(x)).abs() < 7e-16);
            assert!((s * s + c * c - 1.0).abs() < 5e-16);
        }
        assert_eq!(sin_cos_turn(0), (0.0, 1.0));
        assert_eq!(sin_cos_turn(1 << 62), (1.0, 0.0));
        assert_eq!(sin_cos_turn(1 << 63), (0.0, -1.0));
        assert_eq!(sin_cos_turn(3 << 62), (-1.0, 0.0));
    }
}
