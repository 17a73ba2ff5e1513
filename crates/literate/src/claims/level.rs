//! Computes the level of each statistical check, so that all together rarely fail by chance.

use impact_numerics::statistics::normal_quantile;

/// The probability that at least one statistical check fails although all hold (ours).
pub const FAMILY_LEVEL: f64 = 0.01;

/// The level of each of several statistical checks, by Šidák's correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckLevel {
    pub claims: usize,
    /// The level of each one, 1 − (1 − [`FAMILY_LEVEL`])^(1/claims).
    pub each: f64,
    /// The two-sided normal quantile of that level, in standard errors, rounded up to a hundredth.
    pub quantile: f64,
}

impl CheckLevel {
    /// Returns the level for this number of checks (at least one).
    pub fn of(claims: usize) -> CheckLevel {
        let each = -pxfm::f_expm1(pxfm::f_log1p(-FAMILY_LEVEL) / claims.max(1) as f64);
        let quantile = (100.0 * normal_quantile(1.0 - each)).ceil() / 100.0;
        CheckLevel { claims, each, quantile }
    }

    /// Returns the quantile for a check that compares `rows` numbers, which share its level.
    pub fn among(self, rows: usize) -> f64 {
        CheckLevel::of(self.claims.max(1) * rows.max(1)).quantile
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Printed tables of the normal distribution have z(0.995) = 2.5758 and z(0.99975) = 3.4808;
    /// Šidák's level for 20 checks is 5.024e-4, a little above 5e-4, and z a little below.
    #[test]
    fn the_quantile_is_that_of_the_table() {
        assert_eq!(CheckLevel::of(1).quantile, 2.58);
        let twenty = CheckLevel::of(20);
        assert!((twenty.each - 5.024e-4).abs() < 1e-7, "{}", twenty.each);
        assert_eq!((twenty.quantile, CheckLevel::of(4).among(5)), (3.48, 3.48));
    }
}
