//! Computes with fractions in lowest terms.

/// A non-negative fraction in lowest terms: the printed formulas do not always give integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fraction {
    pub numerator: u128,
    /// Greater than 0.
    pub denominator: u128,
}

impl Fraction {
    /// Reduces `numerator`/`denominator` to lowest terms; the denominator must not be zero.
    pub fn new(numerator: u128, denominator: u128) -> Self {
        let divisor = gcd(numerator, denominator).max(1);
        Fraction { numerator: numerator / divisor, denominator: denominator / divisor }
    }

    /// Returns the integer that it equals, or none.
    pub fn integer(self) -> Option<u128> {
        (self.denominator == 1).then_some(self.numerator)
    }

    /// Returns the nearest double, up to a rounding of both parts.
    pub fn to_f64(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

/// Returns the greatest common divisor, with gcd(0, b) = b.
fn gcd(a: u128, b: u128) -> u128 {
    if a == 0 { b } else { gcd(b % a, a) }
}
