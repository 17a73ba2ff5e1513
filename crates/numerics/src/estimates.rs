//! Estimates numbers with errors and intervals, from samples and by the jackknife.

use super::statistics::{Estimate, mean, normal_quantile, standard_error};

pub const LEVEL: f64 = 0.95;

/// Joins a number, its standard error, and the normal interval that follows from it.
pub fn with_error(value: f64, error: f64) -> Estimate {
    let half = normal_quantile(LEVEL) * error;
    Estimate { value, error, interval: [value - half, value + half] }
}

/// Returns the mean of a sample with its error, or `None` below two values.
pub fn average(sample: &[f64]) -> Option<Estimate> {
    Some(with_error(mean(sample)?, standard_error(sample)?))
}

/// Returns the share `part`/`whole` with its binomial error, or `None` if `whole` is 0.
pub fn share(part: u64, whole: u64) -> Option<Estimate> {
    let (p, n) = (part as f64 / whole as f64, whole as f64);
    (whole > 0).then(|| with_error(p, (p * (1.0 - p) / n).sqrt()))
}

/// Returns the difference a − b of estimates from independent samples.
pub fn difference(a: Estimate, b: Estimate) -> Estimate {
    with_error(a.value - b.value, (a.error * a.error + b.error * b.error).sqrt())
}

/// Returns `statistic` of all realisations, with the jackknife error from its values without each
/// realisation in turn (its argument), or `None` if one of these values does not exist or there are
/// fewer than two realisations.
pub fn jackknife(
    realisations: usize,
    statistic: impl Fn(Option<usize>) -> Option<f64>,
) -> Option<Estimate> {
    let without: Option<Vec<f64>> = (0..realisations).map(|i| statistic(Some(i))).collect();
    let error = standard_error(&without?)? * (realisations as f64 - 1.0);
    Some(with_error(statistic(None)?, error))
}

/// Returns the ratio of two sums over realisations with its jackknife error, or `None` if the
/// second sum is not positive without each of them.
pub fn ratio(pairs: &[[f64; 2]]) -> Option<Estimate> {
    let sum = |place: usize| pairs.iter().map(|pair| pair[place]).sum::<f64>();
    let [above, below] = [sum(0), sum(1)];
    jackknife(pairs.len(), |left_out| {
        let [a, b] = left_out.map_or([0.0; 2], |i| pairs[i]);
        (below - b > 0.0).then(|| (above - a) / (below - b))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{NormalPairs, Seed};

    /// Returns whether an estimate has this value and error, and their normal interval, to nine
    /// digits.
    fn near(estimate: Estimate, [value, error]: [f64; 2]) -> bool {
        let half = 1.959_963_985 * error;
        let [low, high] = estimate.interval;
        [estimate.value - value, estimate.error - error, low - value + half, high - value - half]
            .iter()
            .all(|off| off.abs() < 1e-9)
    }

    #[test]
    fn errors_by_hand() {
        assert!(near(with_error(10.0, 2.0), [10.0, 2.0]));
        // The sum of the squares of the deviations is 32.
        let sample = [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0];
        assert!(near(average(&sample).unwrap(), [5.0, (32.0_f64 / 56.0).sqrt()]));
        assert!(near(share(3, 12).unwrap(), [0.25, 0.125]));
        assert_eq!(share(0, 0), None);
        assert!(near(difference(with_error(9.0, 3.0), with_error(2.0, 4.0)), [7.0, 5.0]));
        // Without each: 5/3, 1 and 2, whose deviations from 14/9 are 1, −5 and 4 ninths.
        let quotient = ratio(&[[1.0, 1.0], [3.0, 1.0], [2.0, 2.0]]).unwrap();
        assert!(near(quotient, [1.5, 28.0_f64.sqrt() / 9.0]), "{quotient:?}");
    }

    /// Student's t with 49 degrees of freedom is within 1.96 with a probability of 0.944: 944 of
    /// 1000 expected, seven at one deviation.
    #[test]
    fn intervals_of_means_cover_as_promised() {
        let covers = |index: &u64| {
            let mut normals = NormalPairs::new("coverage", Seed(2), *index);
            let sample: Vec<f64> = (0..25).flat_map(|_| normals.pair()).collect();
            let [low, high] = average(&sample).unwrap().interval;
            low < 0.0 && high > 0.0
        };
        let covered = (0..1000).filter(covers).count();
        assert!((920..968).contains(&covered), "{covered}");
    }

    #[test]
    fn jackknife_of_means_and_what_has_no_estimate() {
        assert_eq!((ratio(&[[1.0, 2.0]]), average(&[1.0])), (None, None));
        assert_eq!(ratio(&[[1.0, 0.0], [2.0, 0.0]]), None);
        assert_eq!(ratio(&[[0.0, 0.0], [1.0, 2.0]]), None);
        let same = ratio(&[[1.0, 2.0], [2.0, 4.0], [3.0, 6.0]]).unwrap();
        assert_eq!((same.value, same.error), (0.5, 0.0));
        // Means of two of {1, 2, 3}.
        let means = [2.5, 2.0, 1.5];
        let mean = jackknife(3, |left_out| Some(left_out.map_or(2.0, |i| means[i]))).unwrap();
        assert!((mean.error - (1.0_f64 / 3.0).sqrt()).abs() < 1e-15);
    }
}
