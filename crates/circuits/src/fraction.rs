//! Exact non-negative fractions: printed formulas need not give integers.

use std::fmt;

/// A non-negative fraction in lowest terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fraction {
    /// Above the line.
    pub numerator: u128,
    /// Below the line, > 0.
    pub denominator: u128,
}

impl Fraction {
    /// `numerator`/`denominator` in lowest terms; the denominator must not be zero.
    pub fn new(numerator: u128, denominator: u128) -> Self {
        let divisor = gcd(numerator, denominator).max(1);
        Fraction { numerator: numerator / divisor, denominator: denominator / divisor }
    }

    /// The integer it equals, if it does.
    pub fn integer(self) -> Option<u128> {
        (self.denominator == 1).then_some(self.numerator)
    }

    /// The nearest double, up to a rounding of both parts.
    pub fn to_f64(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

impl fmt::Display for Fraction {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.integer() {
            Some(n) => write!(out, "{n}"),
            None => write!(out, "{}/{}", self.numerator, self.denominator),
        }
    }
}

/// Greatest common divisor, gcd(0, b) = b.
pub(crate) fn gcd(a: u128, b: u128) -> u128 {
    if a == 0 { b } else { gcd(b % a, a) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lowest_terms() {
        let half = Fraction::new(21, 42);
        assert_eq!((half.numerator, half.denominator), (1, 2));
        assert_eq!((half.to_string(), half.integer(), half.to_f64()), ("1/2".into(), None, 0.5));
        assert_eq!(Fraction::new(12, 4).integer(), Some(3));
        assert_eq!(Fraction::new(0, 7), Fraction::new(0, 1));
    }
}
