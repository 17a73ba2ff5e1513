//! Computes bootstrap intervals, with a separate random stream and in a fixed order.

use super::random::generator;
use super::statistics::{Estimate, quantile, standard_deviation};
use rand::Rng;

/// Draws how often each of `size` members is drawn, with replacement, in resample `index`. Equal
/// (seed, index, size) give equal weights: one index resamples several quantities jointly.
pub fn weights(seed: u64, index: u64, size: usize) -> Vec<u32> {
    let mut random = generator("bootstrap", seed, index);
    let mut weights = vec![0; size];
    for _ in 0..size {
        // Multiply and shift: unbiased to 2^−64 · size, and the same on every machine.
        let drawn = (u128::from(random.next_u64()) * size as u128) >> 64;
        weights[drawn as usize] += 1;
    }
    weights
}

/// Counts each count in a resample, by weights; `histogram` is longer than the largest count.
pub fn histogram(counts: &[Option<u32>], weights: &[u32], histogram: &mut [u32]) {
    histogram.fill(0);
    for (&count, &weight) in counts.iter().zip(weights) {
        if let Some(k) = count {
            histogram[k as usize] += weight;
        }
    }
}

/// Returns the number of members of a histogram, and the sum of their counts.
pub fn total(histogram: &[u32]) -> [u64; 2] {
    let (mut members, mut sum) = (0, 0);
    for (k, &occurs) in (0_u64..).zip(histogram) {
        members += u64::from(occurs);
        sum += k * u64::from(occurs);
    }
    [members, sum]
}

/// Share of resamples without a value above which there is no interval.
const MISSING: f64 = 0.01;

/// Returns the percentile interval around an estimate; none without it or if over 1 % fail.
pub fn estimate(value: Option<f64>, resampled: &[Option<f64>], level: f64) -> Option<Estimate> {
    let value = value?;
    let mut present: Vec<f64> = resampled.iter().copied().flatten().collect();
    if (resampled.len() - present.len()) as f64 > MISSING * resampled.len() as f64 {
        return None;
    }
    let error = standard_deviation(&present)?;
    present.sort_by(f64::total_cmp);
    let tail = 0.5 * (1.0 - level);
    let interval = [quantile(&present, tail)?, quantile(&present, 1.0 - tail)?];
    Some(Estimate { value, error, interval })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::NormalPairs;

    #[test]
    fn the_error_of_a_mean_is_the_known_one() {
        // 400 standard normals: the standard error of the mean is s/√400 by theory, and the
        // bootstrap with 2000 resamples gives a standard deviation to 1.6 %: allow five times that.
        let mut normals = NormalPairs::new("test", 1, 0);
        let sample: Vec<f64> = (0..200).flat_map(|_| normals.pair()).collect();
        let resample = |index| {
            let weights = weights(5, index, 400);
            let sum: f64 = weights.iter().zip(&sample).map(|(&w, x)| f64::from(w) * x).sum();
            Some(sum / 400.0)
        };
        let resampled: Vec<Option<f64>> = (0..2000).map(resample).collect();
        let value = crate::statistics::mean(&sample);
        let found = estimate(value, &resampled, 0.95).unwrap();
        let theory = crate::statistics::standard_error(&sample).unwrap();
        assert!((found.error / theory - 1.0).abs() < 0.08, "{} {theory}", found.error);
        let width = found.interval[1] - found.interval[0];
        assert!((width / (2.0 * 1.96 * theory) - 1.0).abs() < 0.1, "{width}");
    }

    #[test]
    fn no_interval_where_resamples_fail() {
        let mut resampled = vec![Some(1.0); 98];
        resampled.extend([None, None]);
        assert_eq!(estimate(Some(1.0), &resampled, 0.95), None);
        assert_eq!(estimate(None, &[Some(1.0); 9], 0.95), None);
        assert!(estimate(Some(1.0), &[Some(1.0); 9], 0.95).is_some());
    }
}
