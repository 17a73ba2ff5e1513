//! Positive and negative numbers of any magnitude: 106 bits and a separate binary exponent, so
//! that products of a million factors neither overflow nor lose digits.

use super::double_double::DoubleDouble;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Binary digits by which mantissas are rescaled at once.
const STEP: i64 = 128;
/// 2^STEP.
const UP: f64 = f64::from_bits(((1023 + STEP) as u64) << 52);
/// 2^−STEP.
const DOWN: f64 = f64::from_bits(((1023 - STEP) as u64) << 52);

/// The value mantissa · 2^exponent; the mantissa stays within 2^−128 and 2^128.
#[derive(Clone, Copy, Debug)]
pub struct Scaled {
    mantissa: DoubleDouble,
    exponent: i64,
}

impl Scaled {
    /// Zero.
    pub const ZERO: Self = Scaled { mantissa: DoubleDouble::ZERO, exponent: 0 };
    /// One.
    pub const ONE: Self = Scaled { mantissa: DoubleDouble::ONE, exponent: 0 };

    fn normalised(mut mantissa: DoubleDouble, mut exponent: i64) -> Self {
        if mantissa.hi == 0.0 {
            return Scaled::ZERO;
        }
        while mantissa.hi.abs() >= UP {
            mantissa = mantissa.times_power_of_two(DOWN);
            exponent += STEP;
        }
        while mantissa.hi.abs() < DOWN {
            mantissa = mantissa.times_power_of_two(UP);
            exponent -= STEP;
        }
        Scaled { mantissa, exponent }
    }

    /// Whether the value is zero.
    pub fn is_zero(self) -> bool {
        self.mantissa.hi == 0.0
    }

    /// −1, 0 or 1.
    pub fn sign(self) -> i32 {
        match self.mantissa.hi.partial_cmp(&0.0) {
            Some(Ordering::Greater) => 1,
            Some(Ordering::Less) => -1,
            _ => 0,
        }
    }

    /// The value as two doubles: 0 below and ±∞ above the range of a double.
    pub fn to_double_double(self) -> DoubleDouble {
        let (mut value, mut exponent) = (self.mantissa, self.exponent.clamp(-4096, 4096));
        while exponent != 0 {
            let step = exponent.clamp(-STEP, STEP);
            value = value.times_power_of_two(power_of_two(step));
            exponent -= step;
        }
        if value.hi.is_finite() { value } else { DoubleDouble::from(value.hi) }
    }

    /// The nearest double: 0 below and ±∞ above the range of a double.
    pub fn to_f64(self) -> f64 {
        self.to_double_double().to_f64()
    }

    /// The natural logarithm of a positive value; −∞ for zero, NaN for a negative value.
    pub fn ln(self) -> f64 {
        if self.mantissa.hi <= 0.0 {
            return if self.is_zero() { f64::NEG_INFINITY } else { f64::NAN };
        }
        // The mantissa between 3/4 and 3/2, so that nothing cancels when the value is near 1.
        let bits = self.mantissa.hi.to_bits();
        let mut shift = (bits >> 52) as i64 - 1023;
        if self.mantissa.hi * power_of_two(-shift) >= 1.5 {
            shift += 1;
        }
        let m = self.mantissa.times_power_of_two(power_of_two(-shift));
        let small = pxfm::f_log(m.hi) + m.lo / m.hi;
        let large = DoubleDouble::LN_2 * (self.exponent + shift) as f64;
        (large + DoubleDouble::from(small)).to_f64()
    }

    /// The square.
    pub fn square(self) -> Self {
        self * self
    }
}

/// 2^e for |e| ≤ 1022.
fn power_of_two(e: i64) -> f64 {
    f64::from_bits(((1023 + e) as u64) << 52)
}

impl<T: Into<DoubleDouble>> From<T> for Scaled {
    fn from(x: T) -> Self {
        Scaled::normalised(x.into(), 0)
    }
}

impl Neg for Scaled {
    type Output = Self;
    fn neg(self) -> Self {
        Scaled { mantissa: -self.mantissa, exponent: self.exponent }
    }
}

impl Add for Scaled {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        let (large, small) =
            if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let shift = large.exponent - small.exponent;
        // Beyond 512 binary digits the smaller one cannot change the larger.
        if shift > 4 * STEP {
            return large;
        }
        let moved = small.mantissa.times_power_of_two(power_of_two(-shift));
        Scaled::normalised(large.mantissa + moved, large.exponent)
    }
}

impl Sub for Scaled {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Into<Scaled>> Mul<T> for Scaled {
    type Output = Self;
    fn mul(self, other: T) -> Self {
        let other = other.into();
        Scaled::normalised(self.mantissa * other.mantissa, self.exponent + other.exponent)
    }
}

impl Div for Scaled {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Scaled::normalised(self.mantissa / other.mantissa, self.exponent - other.exponent)
    }
}

impl PartialEq for Scaled {
    fn eq(&self, other: &Self) -> bool {
        (*self - *other).is_zero()
    }
}

impl PartialOrd for Scaled {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some((*self - *other).sign().cmp(&0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 170!, the last factorial within a double.
    fn factorial(n: usize) -> Scaled {
        (1..=n).fold(Scaled::ONE, |f, k| f * Scaled::from(k))
    }

    #[test]
    fn factorials_beyond_the_range_of_doubles() {
        // 171!/170! and 3000!/2999! by definition.
        assert_eq!((factorial(171) / factorial(170)).to_f64(), 171.0);
        assert_eq!((factorial(3000) / factorial(2999)).to_f64(), 3000.0);
        assert_eq!(factorial(171).to_f64(), f64::INFINITY);
        assert_eq!((Scaled::ONE / factorial(400)).to_f64(), 0.0);
    }

    #[test]
    fn logarithm_agrees_with_log_gamma_and_vanishes_at_one() {
        for n in [2, 10, 170, 1000, 100_000] {
            let ours = factorial(n).ln();
            let other = pxfm::f_lgamma(n as f64 + 1.0);
            assert!((ours / other - 1.0).abs() < 1e-15, "{n}: {ours} {other}");
        }
        assert_eq!(Scaled::ONE.ln(), 0.0);
        let near = Scaled::from(DoubleDouble { hi: 1.0, lo: 1e-20 });
        assert!((near.ln() / 1e-20 - 1.0).abs() < 1e-15);
        let below = Scaled::from(DoubleDouble { hi: 1.0, lo: -1e-20 });
        assert!((below.ln() / -1e-20 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn sums_keep_small_terms_across_scales() {
        let big = Scaled::from(UP) * UP * UP * UP * UP * UP;
        // Next to 2^768 a 1 is lost; next to 2^60 it is kept.
        assert!(((big + Scaled::ONE) - big).is_zero());
        let mid = Scaled::from(power_of_two(60));
        assert_eq!(((mid + Scaled::ONE) - mid).to_f64(), 1.0);
        assert!(mid + Scaled::ONE > mid && -mid < mid);
    }

    #[test]
    fn subnormal_doubles_enter_and_leave_exactly() {
        for x in [5e-324, 1.5e-310, f64::MAX, f64::MIN_POSITIVE, 1.0] {
            assert_eq!(Scaled::from(x).to_f64(), x);
        }
        assert_eq!((Scaled::from(5e-324) * Scaled::from(f64::MAX)).to_f64(), 5e-324 * f64::MAX);
    }
}
