//! Computes estimates from samples: means, modes, quantiles, proportions and their errors.

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};
use statrs::function::beta::inv_beta_reg;

/// A number with its error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
    /// Where it lies with a confidence of 95 %.
    pub interval: [f64; 2],
}

/// Returns the mean, or `None` if the sample is empty.
pub fn mean(sample: &[f64]) -> Option<f64> {
    (!sample.is_empty()).then(|| sample.iter().sum::<f64>() / sample.len() as f64)
}

/// Returns the standard deviation with n − 1 degrees of freedom, or `None` below two values.
pub fn standard_deviation(sample: &[f64]) -> Option<f64> {
    let centre = mean(sample)?;
    let squares: f64 = sample.iter().map(|x| (x - centre) * (x - centre)).sum();
    (sample.len() > 1).then(|| (squares / (sample.len() - 1) as f64).sqrt())
}

/// Returns the standard error of the mean, or `None` below two values.
pub fn standard_error(sample: &[f64]) -> Option<f64> {
    Some(standard_deviation(sample)? / (sample.len() as f64).sqrt())
}

/// Returns the quantile of a sorted sample, linear between its numbers (Hyndman and Fan's type 7),
/// or `None` if the sample is empty.
pub fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let below = (place as usize).min(last);
    let above = (below + 1).min(last);
    let rest = place - below as f64;
    Some(sorted[below] + rest * (sorted[above] - sorted[below]))
}

/// Returns the smallest k with at least `share` of a histogram at or below it, or `None` if the
/// histogram is empty.
pub fn count_quantile(histogram: &[u32], share: f64) -> Option<usize> {
    let total: u64 = histogram.iter().copied().map(u64::from).sum();
    let mut below = 0;
    histogram.iter().position(|&count| {
        below += u64::from(count);
        total > 0 && below > 0 && below as f64 >= share * total as f64
    })
}

/// Returns the most frequent number of a histogram, the lowest of several, or `None` if it is
/// empty.
pub fn mode(histogram: &[u32]) -> Option<usize> {
    let most = *histogram.iter().max()?;
    (most > 0).then(|| histogram.iter().position(|&count| count == most))?
}

/// Returns the two-sided standard normal quantile, the z with P(|Z| < z) = `level`. Rounded, for
/// statrs computes logarithms by the platform, whose last bits must not reach a file.
pub fn normal_quantile(level: f64) -> f64 {
    let z = Normal::standard().inverse_cdf(0.5 + 0.5 * level);
    (z * 1e9).round() / 1e9
}

/// Returns the two-sided quantile of Student's t with `freedom` degrees of freedom, rounded like
/// the normal one, or `None` below one degree.
pub fn student_quantile(level: f64, freedom: usize) -> Option<f64> {
    let t = StudentsT::new(0.0, 1.0, freedom as f64).ok()?.inverse_cdf(0.5 + 0.5 * level);
    Some((t * 1e9).round() / 1e9)
}

/// Returns Wilson's interval of a proportion, or `None` without trials.
pub fn wilson(successes: u64, trials: u64, level: f64) -> Option<[f64; 2]> {
    let (z, n) = (normal_quantile(level), trials as f64);
    let share = successes as f64 / n;
    let scale = 1.0 + z * z / n;
    let centre = share + z * z / (2.0 * n);
    let half = z * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    let low = if successes == 0 { 0.0 } else { (centre - half) / scale };
    let high = if successes == trials { 1.0 } else { (centre + half) / scale };
    (trials > 0).then_some([low, high])
}

/// Returns the exact interval of a proportion by Clopper and Pearson, or `None` without trials.
pub fn clopper_pearson(successes: u64, trials: u64, level: f64) -> Option<[f64; 2]> {
    let (s, n, tail) = (successes as f64, trials as f64, 0.5 - 0.5 * level);
    let end = |p: f64| (p * 1e9).round() / 1e9;
    let low = || end(inv_beta_reg(s, n - s + 1.0, tail));
    let high = || end(inv_beta_reg(s + 1.0, n - s, 1.0 - tail));
    let low = if successes == 0 { 0.0 } else { low() };
    let high = if successes >= trials { 1.0 } else { high() };
    (trials > 0).then_some([low, high])
}

/// Returns the x at which y(x) passes `level` for the last time, linear between the points that
/// have a value: no later point is below it. `None` if y ends below the level or never lies below
/// it.
pub fn last_rise(x: &[f64], y: &[Option<f64>], level: f64) -> Option<f64> {
    let points: Vec<(f64, f64)> = x.iter().zip(y).filter_map(|(&x, &y)| Some((x, y?))).collect();
    let below = points.iter().rposition(|&(_, y)| y < level)?;
    let ((x0, y0), &(x1, y1)) = (points[below], points.get(below + 1)?);
    Some(x0 + (x1 - x0) * (level - y0) / (y1 - y0))
}

/// Returns the slope of the least-squares line through (x, y), or `None` below two different x.
pub fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let total = points.len() as f64;
    let centre = points.iter().map(|&(x, _)| x).sum::<f64>() / total;
    let level = points.iter().map(|&(_, y)| y).sum::<f64>() / total;
    let spread: f64 = points.iter().map(|&(x, _)| (x - centre) * (x - centre)).sum();
    let rise = || points.iter().map(|&(x, y)| (x - centre) * (y - level)).sum::<f64>();
    (points.len() >= 2 && spread > 0.0).then(|| rise() / spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_by_hand() {
        let sorted = [0.0, 10.0, 20.0, 30.0, 40.0];
        assert_eq!(quantile(&sorted, 0.5), Some(20.0));
        assert_eq!([0.1, 0.4].map(|share| quantile(&sorted, share)), [4.0, 16.0].map(Some));
        assert_eq!(quantile(&sorted, 1.0), Some(40.0));
        assert_eq!(quantile(&[], 0.5), None);
        // Two 0, one 1, one 3: sorted 0 0 1 3.
        let histogram = [2, 1, 0, 1];
        assert_eq!(count_quantile(&histogram, 0.5), Some(0));
        assert_eq!(count_quantile(&histogram, 0.51), Some(1));
        assert_eq!(count_quantile(&histogram, 1.0), Some(3));
        assert_eq!(count_quantile(&[0, 3], 0.0), Some(1));
        assert_eq!(count_quantile(&[0, 0], 0.5), None);
    }

    #[test]
    fn spread_mode_and_slope_by_hand() {
        let sample = [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0];
        assert!((standard_deviation(&sample).unwrap() - (32.0_f64 / 7.0).sqrt()).abs() < 1e-15);
        assert!((standard_error(&sample).unwrap() - (4.0_f64 / 7.0).sqrt()).abs() < 1e-15);
        assert_eq!((mean(&sample), mean(&[]), standard_deviation(&[1.0])), (Some(5.0), None, None));
        assert_eq!([mode(&[1, 3, 0, 3]), mode(&[0, 0]), mode(&[])], [Some(1), None, None]);
        // 39/9 over 42/9.
        let fitted = slope(&[(1.0, 2.0), (2.0, 4.0), (4.0, 5.0)]).unwrap();
        assert!((fitted - 13.0 / 14.0).abs() < 1e-15, "{fitted}");
        assert_eq!([slope(&[(1.0, 2.0)]), slope(&[(1.0, 2.0), (1.0, 3.0)])], [None; 2]);
    }

    #[test]
    fn wilson_against_printed_values() {
        // Both ends of Wilson's interval must solve |s − n p| = z √(n p (1 − p)), the second route.
        let z = normal_quantile(0.95);
        // Tables give 1.959964.
        assert!((z - 1.959_964).abs() < 5e-7);
        for (s, n) in [(3, 10), (45, 100), (999, 1000)] {
            for p in wilson(s, n, 0.95).unwrap() {
                let (s, n) = (s as f64, n as f64);
                assert!(((s - n * p).abs() - z * (n * p * (1.0 - p)).sqrt()).abs() < 1e-9);
            }
        }
        assert_eq!(wilson(0, 10, 0.95).unwrap()[0], 0.0);
        assert_eq!(wilson(10, 10, 0.95).unwrap()[1], 1.0);
        assert_eq!(wilson(0, 0, 0.95), None);
    }

    /// As printed tables have it, and, without successes, as 1 − (α/2)^(1/n).
    #[test]
    fn exact_intervals_of_tables() {
        for (s, n, level, printed) in [
            (3, 10, 0.95, [0.0667, 0.6525]),
            (0, 10, 0.95, [0.0, 0.3085]),
            (10, 10, 0.95, [0.6915, 1.0]),
            (0, 100, 0.99, [0.0, 1.0 - 0.005_f64.powf(0.01)]),
        ] {
            let ends = clopper_pearson(s, n, level).unwrap();
            assert!((0..2).all(|i| (ends[i] - printed[i]).abs() < 5.1e-5), "{ends:?}");
        }
        assert_eq!(clopper_pearson(0, 0, 0.95), None);
    }

    /// As tables print it; with one degree of freedom, tan(π · level/2).
    #[test]
    fn student_quantiles_of_tables() {
        for (freedom, printed) in [(1, 12.706), (11, 2.201), (15, 2.131)] {
            assert!((student_quantile(0.95, freedom).unwrap() - printed).abs() < 5e-4);
        }
        assert_eq!(student_quantile(0.95, 0), None);
    }

    #[test]
    fn the_last_rise_counts() {
        let x = [1.0, 2.0, 3.0, 4.0, 5.0];
        // Up, down again, and up for good between 3 and 4, at a quarter of the way.
        let y = [Some(0.0), Some(9.0), Some(4.0), Some(8.0), Some(9.0)];
        assert_eq!(last_rise(&x, &y, 5.0), Some(3.25));
        assert_eq!(last_rise(&x, &y, 4.0), Some(1.0 + 4.0 / 9.0));
        // A missing point is passed over: the line goes from (2, 0) to (4, 8).
        let y = [None, Some(0.0), None, Some(8.0), Some(9.0)];
        assert_eq!(last_rise(&x, &y, 4.0), Some(3.0));
        assert_eq!(last_rise(&x, &[Some(9.0); 5], 4.0), None);
        assert_eq!(last_rise(&x, &[Some(1.0); 5], 4.0), None);
        assert_eq!(last_rise(&[], &[], 4.0), None);
    }
}
