//! Numbers carried as an unevaluated sum of two doubles: about 106 bits, for products of many
//! factors and for exponents whose error the exponential would enlarge.
//!
//! The error-free sum is Knuth's, the error-free product Dekker's; neither needs a fused
//! multiply-add, so the bits are the same on every machine. Magnitudes must stay between about
//! 2^−450 and 2^450 for products to be exact; [`super::scaled::Scaled`] has an exponent for that.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The value hi + lo, with |lo| at most half a unit in the last place of hi.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    pub hi: f64,
    pub lo: f64,
}

/// Returns a + b exactly, as rounded sum and error.
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    let b_part = hi - a;
    let lo = (a - (hi - b_part)) + (b - b_part);
    DoubleDouble { hi, lo }
}

/// Returns a + b exactly, when |a| ≥ |b| or a = 0.
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble { hi, lo: b - (hi - a) }
}

/// Splits a double into two halves of at most 26 bits each.
fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a; // 2^27 + 1
    let high = c - (c - a);
    (high, a - high)
}

/// Returns a · b exactly, as rounded product and error.
pub fn two_product(a: f64, b: f64) -> DoubleDouble {
    let hi = a * b;
    let (a1, a2) = split(a);
    let (b1, b2) = split(b);
    let lo = ((a1 * b1 - hi) + a1 * b2 + a2 * b1) + a2 * b2;
    DoubleDouble { hi, lo }
}

impl DoubleDouble {
    pub const ZERO: Self = DoubleDouble { hi: 0.0, lo: 0.0 };
    pub const ONE: Self = DoubleDouble { hi: 1.0, lo: 0.0 };
    pub const LN_2: Self =
        DoubleDouble { hi: std::f64::consts::LN_2, lo: 2.319_046_813_846_299_6e-17 };

    /// Returns the product with `factor`, which must be a power of two, exactly.
    pub fn times_power_of_two(self, factor: f64) -> Self {
        DoubleDouble { hi: self.hi * factor, lo: self.lo * factor }
    }

    pub fn to_f64(self) -> f64 {
        self.hi + self.lo
    }

    /// Returns e^self as a double, with the relative error of the exponential of a double.
    pub fn exp(self) -> f64 {
        let e = pxfm::f_exp(self.hi);
        // At 0 and ∞ nothing is left to correct, and lo may be anything.
        if e == 0.0 || e.is_infinite() { e } else { e + e * pxfm::f_expm1(self.lo) }
    }

    /// Returns the square root, and 0 below zero.
    pub fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return DoubleDouble::ZERO;
        }
        let root = self.hi.sqrt();
        let residue = self - two_product(root, root);
        quick_two_sum(root, residue.to_f64() / (2.0 * root))
    }
}

impl From<f64> for DoubleDouble {
    fn from(x: f64) -> Self {
        DoubleDouble { hi: x, lo: 0.0 }
    }
}

impl From<usize> for DoubleDouble {
    fn from(x: usize) -> Self {
        if (x as u64) < 1 << 53 { Self::from(x as f64) } else { Self::from(x as u128) }
    }
}

impl From<u128> for DoubleDouble {
    /// Exact below 2^106, wrong from 2^117 on.
    fn from(x: u128) -> Self {
        let upper = (x >> 53) as u64 as f64 * 9_007_199_254_740_992.0;
        two_sum(upper, (x & ((1 << 53) - 1)) as u64 as f64)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        DoubleDouble { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let s = two_sum(self.hi, other.hi);
        let t = two_sum(self.lo, other.lo);
        let s = quick_two_sum(s.hi, s.lo + t.hi);
        quick_two_sum(s.hi, s.lo + t.lo)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let p = two_product(self.hi, other.hi);
        quick_two_sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        let p = two_product(self.hi, other);
        quick_two_sum(p.hi, p.lo + self.lo * other)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let q1 = self.hi / other.hi;
        let r = self - other * q1;
        let q2 = r.hi / other.hi;
        let r = r - other * q2;
        let q3 = r.hi / other.hi;
        let q = quick_two_sum(q1, q2);
        q + DoubleDouble::from(q3)
    }
}

const HALF_PI: DoubleDouble =
    DoubleDouble { hi: std::f64::consts::FRAC_PI_2, lo: 6.123_233_995_736_766e-17 };

/// Terms below this part of the sum change no bit of 106.
const NEGLIGIBLE: f64 = 1e-33;

/// Computes sin x and cos x by their Taylor series; the absolute error grows as 1e−32 |x|.
pub fn sin_cos(x: DoubleDouble) -> [DoubleDouble; 2] {
    let quarter_turns = (x / HALF_PI).hi.round();
    let r = x - HALF_PI * quarter_turns;
    let minus_square = -(r * r);
    // Σ term_i with term_{i+1} = term_i · (−r²)/((k + 1)(k + 2)), k growing by two.
    let series = |first: DoubleDouble, mut k: f64| {
        let (mut term, mut sum) = (first, first);
        while term.hi.abs() > NEGLIGIBLE * sum.hi.abs() {
            term = term * (minus_square / DoubleDouble::from((k + 1.0) * (k + 2.0)));
            sum = sum + term;
            k += 2.0;
        }
        sum
    };
    let sin = if r.hi == 0.0 { r } else { series(r, 1.0) };
    let cos = series(DoubleDouble::ONE, 0.0);
    match quarter_turns.rem_euclid(4.0) as u8 {
        0 => [sin, cos],
        1 => [cos, -sin],
        2 => [-sin, -cos],
        _ => [-cos, sin],
    }
}
