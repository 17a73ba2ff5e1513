//! Portable sine and cosine: plain + − × only, so the same bits on every machine.

use super::lane::Lane;

/// Largest |x| for which [`small_sin_cos`] is meant.
pub const RANGE: f64 = 2.0;

/// Terms of each Taylor polynomial.
const TERMS: usize = 12;

/// 1/3!, −1/5!, …: Taylor coefficients of (x − sin x)/x³ in x², up to x^25 of the sine.
const SIN: [f64; TERMS] = adjusted(
    3,
    [
        0.0,
        2.42861286636753e-17,
        -2.3283241654126208e-17,
        1.0295261957402393e-17,
        -2.1442076576926077e-18,
        1.7023335647310682e-19,
    ],
);

/// 1/2!, −1/4!, …: Taylor coefficients of (1 − cos x)/x² in x², up to x^24 of the cosine.
const COS: [f64; TERMS] = adjusted(
    2,
    [
        0.0,
        0.0,
        -4.119968255444917e-18,
        2.4970531285056774e-18,
        -6.449097102157429e-19,
        5.978613313349518e-20,
    ],
);

/// Taylor coefficients with the first few moved by some units in their last places.
///
/// 1/3!, 1/5! and 1/4! are not doubles. Their rounding errors alone would make the sine too large
/// by 7e-17 and the cosine by 4e-17 at 2, always to the same side, and a chain without forcing would
/// lose 1e-17 of its energy an impact. The coefficients after them take these errors up: least
/// squares over 0 ≤ x ≤ [`RANGE`], one coefficient after the other rounded. What is left of the
/// polynomial's own error is below 1e-18.
const fn adjusted(m: usize, by: [f64; 6]) -> [f64; TERMS] {
    let mut out = inverse_factorials(m);
    let mut k = 0;
    while k < 6 {
        out[k] += by[k];
        k += 1;
    }
    out
}

/// 1/m!, −1/(m+2)!, 1/(m+4)!, …
///
/// Every factorial up to 18! is exact in a double; the later ones are rounded, which changes the
/// sums by less than 1e-24.
const fn inverse_factorials(m: usize) -> [f64; TERMS] {
    let mut out = [0.0; TERMS];
    let mut factorial = 1.0;
    let mut i = 2;
    while i <= m {
        factorial *= i as f64;
        i += 1;
    }
    let mut k = 0;
    while k < TERMS {
        out[k] = if k % 2 == 0 { 1.0 / factorial } else { -1.0 / factorial };
        let next = (m + 2 * k) as f64;
        factorial *= (next + 1.0) * (next + 2.0);
        k += 1;
    }
    out
}

/// [`SIN`] twice and [`COS`] twice, for [`polynomials`] in one register of four.
const TABLE: [[f64; 4]; TERMS] = {
    let mut table = [[0.0; 4]; TERMS];
    let mut k = 0;
    while k < TERMS {
        table[k] = [SIN[k], SIN[k], COS[k], COS[k]];
        k += 1;
    }
    table
};

/// The polynomials [`SIN`] and [`COS`] at x² and y² side by side: (sin − x)/x³ of both, up to the
/// sign, and (1 − cos)/x² of both. Four chains that a processor runs at once, in vector registers
/// where it has them.
#[inline(always)]
fn polynomials<L: Lane>(x2: L, y2: L) -> [L; 4] {
    let z = [x2, y2, x2, y2];
    // Even and odd powers apart: half the length of each chain of dependent operations.
    let mut even = TABLE[TERMS - 2].map(L::splat);
    let mut odd = TABLE[TERMS - 1].map(L::splat);
    for k in (0..TERMS / 2 - 1).rev() {
        for i in 0..4 {
            let square = z[i] * z[i];
            even[i] = even[i] * square + L::splat(TABLE[2 * k][i]);
            odd[i] = odd[i] * square + L::splat(TABLE[2 * k + 1][i]);
        }
    }
    std::array::from_fn(|i| even[i] + z[i] * odd[i])
}

/// sin x − x, sin y − y, 1 − cos x and 1 − cos y for |x|, |y| ≤ [`RANGE`], each to a few units in
/// its own last place.
///
/// The omitted terms are below 2^27/27! < 2e-20 and 2^26/26! < 2e-19.
#[inline(always)]
pub fn small_sin_cos<L: Lane>(x: L, y: L) -> [L; 4] {
    let (x2, y2) = (x * x, y * y);
    let [sx, sy, cx, cy] = polynomials(x2, y2);
    [-(x2 * x * sx), -(y2 * y * sy), x2 * cx, y2 * cy]
}

/// (sin, cos) of a phase given as a fraction of a turn in units of 2^-64, to 1.2 units of 2^-53.
///
/// The reduction to the nearest quarter turn is exact integer arithmetic.
#[inline]
pub fn sin_cos_turn(turn: u64) -> (f64, f64) {
    const QUARTER: u64 = 1 << 62;
    const RADIANS: f64 = std::f64::consts::TAU / (1u128 << 64) as f64;
    let shifted = turn.wrapping_add(QUARTER / 2);
    let remainder = (shifted % QUARTER) as i64 - (QUARTER / 2) as i64;
    let x = remainder as f64 * RADIANS;
    let [s, _, c, _] = small_sin_cos(x, x);
    let (sin, cos) = (x + s, 1.0 - c);
    match shifted / QUARTER {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

#[cfg(test)]
mod tests {
    use super::super::lane::Lanes;
    use super::*;

    /// The correctly rounded functions of `pxfm` are the second route.
    #[test]
    fn small_arguments_keep_relative_accuracy() {
        for i in 1..=4000 {
            let x = f64::from(i) * (RANGE / 4000.0);
            let half = pxfm::f_sin(x / 2.0);
            let c = 2.0 * half * half;
            let [_, sin, _, cos] = small_sin_cos(0.5 * x, x);
            assert!((cos - c).abs() <= 1e-15 * c, "x = {x}");
            let s = pxfm::f_sin(x) - x;
            assert!((sin - s).abs() <= 3e-16 * x, "x = {x}");
        }
        let x = 1e-5;
        let [sin, ..] = small_sin_cos(x, 0.0);
        assert!((sin / (-x * x * x / 6.0) - 1.0).abs() < 1e-10);
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
    }

    #[test]
    fn lanes_give_the_bits_of_one() {
        let x = [0.1, -1.4, 1e-9, 1.5];
        let y = x.map(|x| 0.3 - x);
        let side = small_sin_cos(Lanes(x), Lanes(y));
        for i in 0..4 {
            assert_eq!(side.map(|lanes| lanes.0[i]), small_sin_cos(x[i], y[i]));
        }
    }
}
