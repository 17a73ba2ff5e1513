//! Computes bootstrap intervals, with a separate random stream and in a fixed order.

use super::random::{Seed, generator};
use super::statistics::{Estimate, quantile, standard_deviation};
use rand::Rng;

/// Draws how often each of `size` members is drawn, with replacement, in resample `index`. Equal
/// (seed, index, size) give equal weights: one index resamples several quantities jointly.
pub fn weights(seed: u64, index: u64, size: usize) -> Vec<u32> {
    let mut random = generator("bootstrap", Seed(seed), index);
    let mut weights = vec![0; size];
    for _ in 0..size {
        // Multiply and shift: unbiased to 2^−64 · size, and the same on every machine.
        let drawn = (u128::from(random.next_u64()) * size as u128) >> 64;
        weights[drawn as usize] += 1;
    }
    weights
}

/// Counts how often each count occurs in a resample, in which each member has the given weight;
/// `histogram` is longer than the largest count.
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

/// Returns an estimate with the percentile interval of its resamples, or `None` if it has no value
/// or more than 1 % of the resamples have none.
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
    use crate::random::{NormalPairs, Seed};

    #[test]
    fn an_interval_has_its_tails_outside() {
        // 0 to 1000 have the variance n (n + 1)/12, n = 1001.
        let resampled: Vec<Option<f64>> = (0..=1000).rev().map(|i| Some(f64::from(i))).collect();
        let mean = estimate(Some(7.0), &resampled, 0.95).unwrap();
        assert_eq!(mean.value, 7.0);
        assert!((mean.error - (1001.0 * 1002.0 / 12.0_f64).sqrt()).abs() < 1e-9);
        assert!((mean.interval[0] - 25.0).abs() < 1e-9, "{mean:?}");
        assert!((mean.interval[1] - 975.0).abs() < 1e-9, "{mean:?}");
    }

    /// The mean of 40 normals lies beyond either end in 2.5 % of samples, a little more as the
    /// percentile interval is narrower by √(1 − 1/40): 29 of 1000, with a deviation of five.
    #[test]
    fn intervals_cover_as_promised() {
        let [mut below, mut above] = [0; 2];
        for index in 0..1000 {
            let mut normals = NormalPairs::new("coverage", Seed(1), index);
            let sample: Vec<f64> = (0..20).flat_map(|_| normals.pair()).collect();
            let resample = |number| {
                let weights = weights(index, number, 40);
                Some(weights.iter().zip(&sample).map(|(&w, x)| f64::from(w) * x).sum())
            };
            let resampled: Vec<Option<f64>> = (0..400).map(resample).collect();
            let [low, high] = estimate(Some(0.0), &resampled, 0.95).unwrap().interval;
            below += usize::from(high < 0.0);
            above += usize::from(low > 0.0);
        }
        assert!((15..44).contains(&below) && (15..44).contains(&above), "{below} {above}");
    }

    #[test]
    fn members_and_counts_by_hand() {
        let mut counts = [9; 4];
        histogram(&[Some(3), None, Some(1), Some(3)], &[2, 5, 1, 4], &mut counts);
        assert_eq!((counts, total(&counts)), ([0, 1, 0, 6], [7, 19]));
        let resamples: Vec<Vec<u32>> = (0..1000).map(|index| weights(1, index, 8)).collect();
        assert!(resamples.iter().all(|weights| weights.iter().sum::<u32>() == 8));
        // Each member is drawn once on average: a deviation of 30 in 1000.
        for member in 0..8 {
            let drawn: u32 = resamples.iter().map(|weights| weights[member]).sum();
            assert!(drawn.abs_diff(1000) < 120, "{member}: {drawn}");
        }
        assert!(resamples[0] != resamples[1] && resamples[0] != weights(2, 0, 8));
    }

    #[test]
    fn no_interval_where_resamples_fail() {
        let mut resampled = vec![Some(1.0); 99];
        resampled.push(None);
        assert!(estimate(Some(1.0), &resampled, 0.95).is_some());
        resampled[0] = None;
        assert_eq!(estimate(Some(1.0), &resampled, 0.95), None);
        assert_eq!(estimate(None, &[Some(1.0); 9], 0.95), None);
        assert!(estimate(Some(1.0), &[Some(1.0); 9], 0.95).is_some());
    }
}
