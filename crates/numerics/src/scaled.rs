//! Numbers ≥ 0 of any magnitude, for products of a million factors: 106 bits and an exponent.

use super::double_double::DoubleDouble;
use std::ops::{Add, Div, Mul};

/// Binary digits by which mantissas are rescaled at once.
const STEP: i64 = 128;

/// The value mantissa · 2^exponent, 1 ≤ mantissa < 2^128; the exponent is a multiple of 128.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Scaled {
    exponent: i64,
    mantissa: DoubleDouble,
}

/// 2^e for |e| ≤ 1022.
fn power_of_two(e: i64) -> f64 {
    f64::from_bits(((1023 + e) as u64) << 52)
}

impl Scaled {
    pub const ZERO: Self = Scaled { mantissa: DoubleDouble::ZERO, exponent: i64::MIN / 2 };
    pub const ONE: Self = Scaled { mantissa: DoubleDouble::ONE, exponent: 0 };

    fn normalised(mut mantissa: DoubleDouble, mut exponent: i64) -> Self {
        if mantissa.hi == 0.0 {
            return Scaled::ZERO;
        }
        while mantissa.hi >= power_of_two(STEP) {
            mantissa = mantissa.times_power_of_two(power_of_two(-STEP));
            exponent += STEP;
        }
        while mantissa.hi < 1.0 {
            mantissa = mantissa.times_power_of_two(power_of_two(STEP));
            exponent -= STEP;
        }
        Scaled { mantissa, exponent }
    }

    /// Returns the nearest double: 0 below and ∞ above the range of a double.
    pub fn to_f64(self) -> f64 {
        match self.exponent {
            // Twice, since 2^-1152 is no double.
            -1152..=1024 => {
                let half = power_of_two(self.exponent / 2);
                let value = self.mantissa.times_power_of_two(half).times_power_of_two(half);
                if value.hi.is_finite() { value.to_f64() } else { value.hi }
            }
            exponent if exponent < 0 => 0.0,
            _ => f64::INFINITY,
        }
    }

    /// Returns the natural logarithm of a positive value.
    pub fn ln(self) -> f64 {
        // The mantissa between 3/4 and 3/2, so that nothing cancels when the value is near 1.
        let mut shift = (self.mantissa.hi.to_bits() >> 52) as i64 - 1023;
        if self.mantissa.hi * power_of_two(-shift) >= 1.5 {
            shift += 1;
        }
        let m = self.mantissa.times_power_of_two(power_of_two(-shift));
        let small = pxfm::f_log(m.hi) + m.lo / m.hi;
        let large = DoubleDouble::LN_2 * (self.exponent + shift) as f64;
        (large + DoubleDouble::from(small)).to_f64()
    }
}

impl<T: Into<DoubleDouble>> From<T> for Scaled {
    fn from(x: T) -> Self {
        Scaled::normalised(x.into(), 0)
    }
}

impl Add for Scaled {
    type Output = Self;
    fn add(self, other: Self) -> Self {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn factorial(n: usize) -> Scaled {
        (1..=n).fold(Scaled::ONE, |f, k| f * Scaled::from(k))
    }

    #[test]
    fn exponents_and_logarithms_of_any_size() {
        let power = |e| Scaled::from(power_of_two(e));
        for [large, small] in [[200, 100], [100, 10], [-900, -1000], [130, 126]] {
            let parts = DoubleDouble { hi: power_of_two(large), lo: power_of_two(small) };
            let sum = if large - small < 53 { parts.to_f64().into() } else { parts };
            assert_eq!(power(large) + power(small), Scaled::from(sum));
            assert_eq!(power(small) + power(large), Scaled::from(sum));
            assert_eq!((power(large) / power(small)).to_f64(), power_of_two(large - small));
        }
        for x in [1.0, 0.74, 0.75, 0.76, 1.4, 1.5, 1.6, 2.0, 3.1, 1e-300, 5e-324, 1e300] {
            let (ours, exact) = (Scaled::from(x).ln(), pxfm::f_log(x));
            assert!((ours - exact).abs() <= 4e-16 * exact.abs(), "{x}: {ours} {exact}");
        }
        let barely = DoubleDouble { hi: 1.0, lo: power_of_two(-60) };
        assert!((Scaled::from(barely).ln() / power_of_two(-60) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn factorials_beyond_the_range_of_doubles() {
        // 171!/170! and 3000!/2999! by definition.
        assert_eq!((factorial(171) / factorial(170)).to_f64(), 171.0);
        assert_eq!((factorial(3000) / factorial(2999)).to_f64(), 3000.0);
        assert_eq!(factorial(171).to_f64(), f64::INFINITY);
        assert_eq!((Scaled::ONE / factorial(400)).to_f64(), 0.0);
        for n in [2, 170, 1000, 100_000] {
            let (ours, other) = (factorial(n).ln(), pxfm::f_lgamma(n as f64 + 1.0));
            assert!((ours / other - 1.0).abs() < 1e-15, "{n}: {ours} {other}");
        }
        assert!(factorial(200) > factorial(199) && Scaled::ZERO < Scaled::ONE / factorial(400));
        assert_eq!(factorial(200) + Scaled::ONE + Scaled::ZERO, factorial(200));
        assert_eq!((Scaled::from(5e-324) * Scaled::from(f64::MAX)).to_f64(), 5e-324 * f64::MAX);
        assert_eq!(Scaled::from(5e-324).to_f64(), 5e-324);
    }
}
