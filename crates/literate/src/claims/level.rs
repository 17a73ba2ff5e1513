//! The level of the statistical claims, corrected for their number.

use statrs::distribution::{ContinuousCDF, Normal};

/// Probability with which at least one statistical claim fails although all of them hold (ours).
pub const FAMILY_LEVEL: f64 = 0.01;

/// The level of each of `claims` statistical claims, by Šidák's correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// How many statistical claims there are.
    pub claims: usize,
    /// The level of each one, 1 − (1 − [`FAMILY_LEVEL`])^(1/claims).
    pub each: f64,
    /// Two-sided normal quantile of that level, in standard errors.
    ///
    /// Rounded up to a hundredth: statrs computes it with the platform's logarithm, and a
    /// tolerance must not differ between machines.
    pub quantile: f64,
}

impl Level {
    /// The level for so many claims (at least one).
    pub fn of(claims: usize) -> Level {
        let claims = claims.max(1);
        let each = share(FAMILY_LEVEL, claims);
        Level { claims, each, quantile: quantile(each) }
    }

    /// The quantile when one claim compares `rows` numbers, which then share its level.
    pub fn among(self, rows: usize) -> f64 {
        quantile(share(self.each, rows.max(1)))
    }
}

/// Šidák's level of each of `parts` independent tests that together have `level`.
fn share(level: f64, parts: usize) -> f64 {
    -pxfm::f_expm1(pxfm::f_log1p(-level) / parts as f64)
}

fn quantile(level: f64) -> f64 {
    (100.0 * Normal::standard().inverse_cdf(1.0 - level / 2.0)).ceil() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Printed tables of the normal distribution have z(0.995) = 2.5758 and z(0.99975) = 3.4808;
    /// Šidák's level for 20 claims is 5.024e-4, a little above 5e-4, and z a little below.
    #[test]
    fn the_quantile_is_that_of_the_table() {
        assert_eq!(Level::of(1).quantile, 2.58);
        let twenty = Level::of(20);
        assert!((twenty.each - 5.024e-4).abs() < 1e-7, "{}", twenty.each);
        assert_eq!(twenty.quantile, 3.48);
    }

    #[test]
    fn more_claims_make_each_one_wider() {
        assert!(Level::of(10).quantile < Level::of(40).quantile);
        // Ten tests in ten rows each are a hundred tests.
        assert_eq!(Level::of(10).among(10), Level::of(100).quantile);
        let whole = 1.0 - (1.0 - Level::of(7).each).powi(7);
        assert!((whole - FAMILY_LEVEL).abs() < 1e-14);
    }
}
