//! Computes the level of each statistical check, so that all together rarely fail by chance.

use crate::sample::{Sample, Sampled};
use impact_numerics::statistics::{Estimate, clopper_pearson, normal_quantile, student_quantile};

/// The probability that at least one statistical check fails although all hold (ours).
pub const FAMILY_LEVEL: f64 = 0.01;

/// The level of each of several statistical checks, by Šidák's correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckLevel {
    /// How many statistical checks there are.
    pub claims: usize,
    /// The level of each one, 1 − (1 − [`FAMILY_LEVEL`])^(1/claims).
    pub each: f64,
    /// The two-sided normal quantile of that level, in standard errors, rounded up to a hundredth.
    pub quantile: f64,
}

impl CheckLevel {
    pub(crate) fn for_checks(claims: usize) -> CheckLevel {
        let each = -pxfm::f_expm1(pxfm::f_log1p(-FAMILY_LEVEL) / claims.max(1) as f64);
        let quantile = (100.0 * normal_quantile(1.0 - each)).ceil() / 100.0;
        CheckLevel { claims, each, quantile }
    }

    /// Returns the quantile for a check that compares `rows` numbers, which share its level.
    pub fn quantile_among(self, rows: usize) -> f64 {
        CheckLevel::for_checks(self.claims.max(1) * rows.max(1)).quantile
    }

    /// Returns how far below and above an estimate the true number may lie by chance, or `None` for
    /// an error of zero, as equal values have, or a sample of fewer than two.
    pub(crate) fn room(&self, sampled: Sampled) -> Option<[f64; 2]> {
        let (Estimate { value, error, .. }, level) = (sampled.estimate, 1.0 - self.each);
        match sampled.sample {
            Sample::Trials(_) if !(0.0..=1.0).contains(&value) => Some([0.0; 2]),
            Sample::Trials(trials) => {
                let part = (value * trials as f64).round() as u64;
                let [low, high] = clopper_pearson(part, trials, level)?;
                Some([value - low, high - value])
            }
            _ if error <= 0.0 => None,
            Sample::Values(values) => {
                let quantile = student_quantile(level, values.checked_sub(1)? as usize)?;
                Some([(100.0 * quantile).ceil() / 100.0 * error; 2])
            }
            Sample::Unknown => Some([self.quantile * error; 2]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{average, share};
    use impact_numerics::random::{NormalPairs, Seed};

    /// Of 4000 papers with four right numbers, means of few values, 40 have a check that fails,
    /// with a deviation of six.
    #[test]
    fn one_in_a_hundred_papers_fails_however_few_the_values() {
        for (values, stream) in [(3, 0), (5, 4000), (20, 8000)] {
            let level = CheckLevel::for_checks(4);
            let fails = |paper: &u64| {
                let mut normals = NormalPairs::new("papers", Seed(1), stream + paper);
                (0..4).any(|_| {
                    let sample: Vec<f64> = (0..values).map(|_| normals.pair()[0]).collect();
                    let mean = average(&sample).unwrap();
                    mean.estimate.value.abs() > level.room(mean).unwrap()[0]
                })
            };
            let failed = (0..4000).filter(fails).count();
            assert!((15..65).contains(&failed), "{values}: {failed}");
        }
    }

    /// The probability that a share is too far from the right one, summed over all samples.
    #[test]
    fn shares_near_nothing_and_all_fail_no_more_often() {
        let rights = [1e-4_f64, 0.003, 0.02, 0.1, 0.5, 0.98, 0.9999];
        for (trials, right) in [3, 20, 100].iter().flat_map(|n| rights.map(|right| (*n, right))) {
            let (mut failed, mut chance) = (0.0, (1.0 - right).powi(trials));
            for part in 0..=trials as u64 {
                let share = share(part, trials as u64).unwrap();
                let [below, above] = CheckLevel::for_checks(1).room(share).unwrap();
                let estimate = share.estimate;
                assert!(below + above > 0.0 && estimate.error > 0.0);
                if !(-below..=above).contains(&(right - estimate.value)) {
                    failed += chance;
                }
                let left = (trials as u64 - part) as f64;
                chance *= left / (part as f64 + 1.0) * right / (1.0 - right);
            }
            assert!(failed <= FAMILY_LEVEL, "{failed} of {trials} at {right}");
        }
    }

    /// Printed tables of the normal distribution have z(0.995) = 2.5758 and z(0.99975) = 3.4808;
    /// Šidák's level for 20 checks is 5.024e-4, a little above 5e-4, and z a little below.
    #[test]
    fn the_quantile_is_that_of_the_table() {
        assert_eq!(CheckLevel::for_checks(1).quantile, 2.58);
        let twenty = CheckLevel::for_checks(20);
        assert!((twenty.each - 5.024e-4).abs() < 1e-7, "{}", twenty.each);
        assert_eq!((twenty.quantile, CheckLevel::for_checks(4).quantile_among(5)), (3.48, 3.48));
    }
}
