//! Finds means, modes and places of the rise in a sample of counts, with bootstrap errors.
//! The realisations are resampled, not the rows: realisation i has the same standard normals at
//! every σ, so a resample takes its counts at all σ together.

use impact_numerics::bootstrap;
use impact_numerics::estimates::LEVEL;
use impact_numerics::statistics::{Estimate, count_quantile, last_rise, mode};
#[cfg(feature = "serde")]
use serde::{Deserialize, Serialize};

/// Share of N at which the rise has its onset.
pub const ONSET: f64 = 0.05;

/// Places of the rise on the σ axis: each is the last rise of a curve through a level, or `None` if
/// the curve does not rise through it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct Rise<T = Estimate> {
    /// Half height: the mean over realisations with an impact reaches N/2.
    pub half_height: Option<T>,
    /// The mean over all (those without impact included) reaches N/2.
    pub half_height_all: Option<T>,
    /// Onset: the mean over all reaches N/20.
    pub onset: Option<T>,
    /// Half of the realisations have an impact in the window.
    pub kept_half: Option<T>,
    /// Width of the rise: the mean over all from a tenth to nine tenths of N.
    pub width: Option<T>,
    /// Width of the mean over realisations with an impact, from N/4 to 3N/4.
    pub kept_width: Option<T>,
    /// Width of the mean over all, from N/4 to 3N/4.
    pub quarters: Option<T>,
}

const RESAMPLES: u64 = 1000;

/// Means and modes at each σ, and places of the rise, of a sample or of a resample.
#[derive(Default)]
pub struct Places {
    /// Mean over those with at least one impact.
    pub mean: Vec<Option<f64>>,
    pub mean_all: Vec<Option<f64>>,
    pub mode: Vec<Option<usize>>,
    rise: Rise<f64>,
}

/// Counts of one window: `counts[σ][realisation]`. A row may have only the first realisations.
pub struct Sample<'a> {
    pub sigmas: &'a [f64],
    pub counts: Vec<&'a [Option<u32>]>,
    /// Number of gaps N behind each count, on average where long chains are cut into pieces.
    pub gaps: f64,
}

impl Sample<'_> {
    fn largest(&self) -> usize {
        self.gaps.ceil() as usize
    }

    /// Computes means, modes and places when realisation i counts `weights[i]` times.
    fn places(&self, weights: &[u32]) -> Places {
        let sigmas = self.sigmas;
        let (mut places, mut share) = (Places::default(), Vec::new());
        let mut histogram = vec![0; self.largest() + 1];
        for row in &self.counts {
            bootstrap::histogram(row, weights, &mut histogram);
            let [ran, sum] = bootstrap::total(&histogram);
            let above_zero = ran - u64::from(histogram[0]);
            histogram[0] = 0;
            places.mean.push(ratio(sum, above_zero));
            places.mean_all.push(ratio(sum, ran));
            places.mode.push(mode(&histogram));
            share.push(ratio(above_zero, ran));
        }
        let rise = |share: f64| last_rise(sigmas, &places.mean, share * self.gaps);
        let rise_of_all = |share: f64| last_rise(sigmas, &places.mean_all, share * self.gaps);
        let width = |low: Option<f64>, high: Option<f64>| Some(high? - low?);
        places.rise = Rise {
            half_height: rise(0.5),
            half_height_all: rise_of_all(0.5),
            onset: rise_of_all(ONSET),
            kept_half: last_rise(sigmas, &share, 0.5),
            width: width(rise_of_all(0.1), rise_of_all(0.9)),
            kept_width: width(rise(0.25), rise(0.75)),
            quarters: width(rise_of_all(0.25), rise_of_all(0.75)),
        };
        places
    }
}

fn ratio(numerator: u64, denominator: u64) -> Option<f64> {
    (denominator > 0).then(|| numerator as f64 / denominator as f64)
}

pub struct Resampled {
    whole: Places,
    resamples: Vec<Places>,
    pub largest: usize,
}

impl Resampled {
    pub fn new(sample: &Sample<'_>, seed: u64) -> Self {
        let size = sample.counts.iter().map(|counts| counts.len()).max().unwrap_or(0);
        let resample = |index| sample.places(&bootstrap::weights(seed, index, size));
        let resamples = (0..RESAMPLES).map(resample).collect();
        let whole = sample.places(&vec![1; size]);
        Resampled { whole, resamples, largest: sample.largest() }
    }

    /// Estimates a quantity with its bootstrap error, or returns `None` if too many resamples have
    /// no value.
    pub fn estimate(&self, pick: impl Fn(&Places) -> Option<f64>) -> Option<Estimate> {
        let resamples: Vec<_> = self.resamples.iter().map(&pick).collect();
        bootstrap::estimate(pick(&self.whole), &resamples, LEVEL)
    }

    /// Estimates the places of the rise.
    pub fn rise(&self) -> Rise {
        let estimate =
            |pick: fn(&Rise<f64>) -> Option<f64>| self.estimate(|places| pick(&places.rise));
        Rise {
            half_height: estimate(|rise| rise.half_height),
            half_height_all: estimate(|rise| rise.half_height_all),
            onset: estimate(|rise| rise.onset),
            kept_half: estimate(|rise| rise.kept_half),
            width: estimate(|rise| rise.width),
            kept_width: estimate(|rise| rise.kept_width),
            quarters: estimate(|rise| rise.quarters),
        }
    }

    /// Returns the interval of the mode at a σ, from order statistics, or `None` if there is no
    /// mode.
    pub fn mode_interval(&self, row: usize) -> Option<[usize; 2]> {
        self.whole.mode[row]?;
        let mut histogram = vec![0; self.largest + 1];
        for k in self.resamples.iter().filter_map(|places| places.mode[row]) {
            histogram[k] += 1;
        }
        let tail = 0.5 * (1.0 - LEVEL);
        Some([count_quantile(&histogram, tail)?, count_quantile(&histogram, 1.0 - tail)?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 1000 resamples at most 2.5 % are cut off at either end.
    #[test]
    fn the_interval_of_the_mode_by_hand() {
        let modes = [(1, 30), (3, 25), (5, 900), (7, 30), (9, 15)];
        let place = |mode| Places { mode: vec![Some(mode), None], ..Places::default() };
        let resamples =
            modes.iter().flat_map(|&(mode, times)| (0..times).map(move |_| place(mode)));
        let resampled = Resampled { whole: place(5), resamples: resamples.collect(), largest: 9 };
        assert_eq!([0, 1].map(|row| resampled.mode_interval(row)), [Some([1, 7]), None]);
    }

    /// The bootstrap error of a mean is s √((n − 1)/n)/√n, here √(8.25/10) for 1 to 10.
    #[test]
    fn errors_of_means_are_the_known_ones() {
        let counts: Vec<Option<u32>> = (1..=10).map(Some).collect();
        let sample = Sample { sigmas: &[0.1], counts: vec![&counts], gaps: 9.5 };
        let resampled = Resampled::new(&sample, 1);
        let mean = resampled.estimate(|places| places.mean_all[0]).unwrap();
        assert_eq!((mean.value, resampled.largest, resampled.resamples.len()), (5.5, 10, 1000));
        assert!((mean.error / 0.825_f64.sqrt() - 1.0).abs() < 0.08, "{mean:?}");
    }

    /// Four realisations on five σ, N = 10.
    #[test]
    fn places_by_hand() {
        let counts = [[0, 0, 0, 0], [0, 0, 0, 2], [0, 4, 4, 6], [8, 8, 8, 6], [10, 10, 10, 10]]
            .map(|row| row.map(Some));
        let counts = counts.iter().map(|row| row.as_slice()).collect();
        let sample = Sample { sigmas: &[0.1, 0.2, 0.3, 0.4, 0.5], counts, gaps: 10.0 };
        let places = sample.places(&[1; 4]);
        assert_eq!(places.mean_all, [0.0, 0.5, 3.5, 7.5, 10.0].map(Some));
        let mean = [None, Some(2.0), Some(14.0 / 3.0), Some(7.5), Some(10.0)];
        assert_eq!(places.mean, mean);
        assert_eq!(places.mode, [None, Some(2), Some(4), Some(8), Some(10)]);
        let rise = places.rise;
        for (place, expected) in [
            (rise.half_height, 0.3 + 0.1 * (5.0 - 14.0 / 3.0) / (7.5 - 14.0 / 3.0)),
            (rise.half_height_all, 0.3 + 0.1 * 1.5 / 4.0),
            // N/20 is met exactly at the second row.
            (rise.onset, 0.2),
            // From 1/4 with an impact to 3/4.
            (rise.kept_half, 0.25),
            // From 1, between 0.5 and 3.5, to 9, between 7.5 and 10.
            (rise.width, (0.4 + 0.1 * 0.6) - (0.2 + 0.1 / 6.0)),
            (rise.kept_width, 0.3 + 0.1 - 0.2 - 0.1 * 0.5 / (14.0 / 3.0 - 2.0)),
            // From 2.5, between 0.5 and 3.5, to 7.5.
            (rise.quarters, 0.4 - (0.2 + 0.1 * 2.0 / 3.0)),
        ] {
            assert!((place.unwrap() - expected).abs() < 1e-15, "{place:?} {expected}");
        }
    }
}
