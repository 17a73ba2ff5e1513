//! Summarises counts of random chains at each σ and where they rise, with bootstrap errors.
//! The realisations are resampled, not the rows: realisation i has the same standard normals at
//! every σ, so a resample takes its counts at all σ together.

use crate::counts::{Counts, Protocol};
use impact_numerics::bootstrap;
use impact_numerics::estimates::{LEVEL, with_error};
use impact_numerics::statistics::{
    Estimate, count_quantile, last_rise, mean, mode, standard_error,
};
#[cfg(feature = "serde")]
use serde::{Deserialize, Serialize};

/// Counts in one window, against σ.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct Curve {
    /// The window.
    pub protocol: Protocol,
    /// One row for each σ, rising.
    pub rows: Vec<RisePoint>,
    /// Where the curve rises.
    pub rise: Rise,
}

/// The mean of a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct Mean {
    /// The mean.
    pub value: f64,
    /// The standard error, or `None` if the sample is a single number.
    pub error: Option<f64>,
    /// The interval of 95 % by the bootstrap, if there is one.
    pub interval: Option<[f64; 2]>,
}

impl Mean {
    fn from_sample(sample: &[f64]) -> Option<Mean> {
        Some(Mean { value: mean(sample)?, error: standard_error(sample), interval: None })
    }

    /// Returns the mean with its standard error and the normal interval, or `None` if it has no
    /// error.
    #[must_use]
    pub fn estimate(&self) -> Option<Estimate> {
        Some(with_error(self.value, self.error?))
    }
}

/// Counts at one σ, of chains or their pieces. The paper discards those without an impact.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct RisePoint {
    /// Standard deviation σ of the amplitudes.
    pub sigma: f64,
    /// Realisations that ran to the end of the window.
    pub ran: usize,
    /// The active ones of them, with at least one impact in the window.
    #[cfg_attr(feature = "serde", serde(rename = "kept"))]
    pub active: usize,
    /// Different gaps with an impact: mean over the active ones.
    pub mean: Option<Mean>,
    /// Mean over all that ran.
    pub mean_all: Option<Mean>,
    /// Mode over the active ones; the lowest of several.
    pub mode: Option<usize>,
    /// The interval of the mode of 95 %.
    pub mode_interval: Option<[usize; 2]>,
    /// Impacts of a whole chain in the window: mean over the active ones.
    pub impacts: Option<Mean>,
    /// Masses of a whole chain that are hit in the window: mean over the active ones.
    pub masses: Option<Mean>,
    /// Numbers of realisations by their count k = 0..=N.
    pub counts: Vec<u32>,
}

/// What a [`Curve`] is computed from.
#[derive(Clone, Copy, Debug)]
pub struct CurveData<'a> {
    /// The window.
    pub protocol: Protocol,
    /// Its number among those of the counts, from 0 on.
    pub window_index: usize,
    /// The standard deviations σ, rising.
    pub sigmas: &'a [f64],
    /// The counts at each σ.
    pub counts: &'a [Counts],
    /// Whether each σ has a part in the places of the rise.
    pub compared: &'a [bool],
    /// The number N of gaps behind each count, on average.
    pub gaps: f64,
    /// Seed of the resamples.
    pub seed: u64,
}

impl Curve {
    /// Computes the curve of a window from the counts at each σ.
    ///
    /// # Panics
    /// Panics if the counts have no window of this number, or a count is above `gaps`.
    #[must_use]
    pub fn new(data: &CurveData) -> Curve {
        let &CurveData { window_index, protocol, sigmas, counts, compared, gaps, seed } = data;
        let mut distinct: Vec<&[Option<u32>]> = Vec::with_capacity(counts.len());
        for (counts, &compared) in counts.iter().zip(compared) {
            distinct.push(if compared { &counts.distinct[window_index] } else { &[] });
        }
        let sample = Sample { sigmas, counts: distinct, gaps };
        let resampled = Resampled::new(&sample, seed);
        let largest = resampled.largest;
        let interval =
            |pick: &dyn Fn(&Places) -> Option<f64>| Some(resampled.estimate(pick)?.interval);
        let mut rows = Vec::with_capacity(counts.len());
        for (row, (&sigma, counts)) in sigmas.iter().zip(counts).enumerate() {
            let mut point = RisePoint::new(sigma, counts, Column { window_index, largest });
            point.mode_interval = resampled.mode_interval(row);
            if let Some(mean) = &mut point.mean {
                mean.interval = interval(&|places| places.mean[row]);
            }
            if let Some(mean) = &mut point.mean_all {
                mean.interval = interval(&|places| places.mean_all[row]);
            }
            rows.push(point);
        }
        Curve { protocol, rows, rise: resampled.rise() }
    }
}

/// Which of the counts a [`RisePoint`] shows.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// The number of the window, from 0 on.
    pub window_index: usize,
    /// The largest count that is possible.
    pub largest: usize,
}

impl RisePoint {
    /// Computes the row of a σ, without intervals.
    ///
    /// # Panics
    /// Panics if the counts have no such window, or one is above the largest.
    #[must_use]
    pub fn new(sigma: f64, counts: &Counts, column: Column) -> RisePoint {
        let Column { window_index, largest } = column;
        let mut histogram = vec![0; largest + 1];
        let mut distinct = Vec::new();
        for &k in counts.distinct[window_index].iter().flatten() {
            histogram[k as usize] += 1;
            distinct.push(f64::from(k));
        }
        let active: Vec<f64> = distinct.iter().copied().filter(|&k| k > 0.0).collect();
        let mut active_histogram = histogram.clone();
        active_histogram[0] = 0;
        let runs = counts.impacts[window_index].iter().zip(&counts.masses[window_index]);
        let active_runs = runs.filter(|(impacts, _)| **impacts > 0);
        let (impacts, masses): (Vec<_>, Vec<_>) =
            active_runs.map(|(&impacts, &masses)| (impacts as f64, f64::from(masses))).unzip();
        RisePoint {
            sigma,
            ran: distinct.len(),
            active: active.len(),
            mean: Mean::from_sample(&active),
            mean_all: Mean::from_sample(&distinct),
            mode: mode(&active_histogram),
            mode_interval: None,
            impacts: Mean::from_sample(&impacts),
            masses: Mean::from_sample(&masses),
            counts: histogram,
        }
    }
}

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
struct Places {
    /// Mean over those with at least one impact.
    mean: Vec<Option<f64>>,
    mean_all: Vec<Option<f64>>,
    mode: Vec<Option<usize>>,
    rise: Rise<f64>,
}

/// Counts of one window: `counts[σ][realisation]`. A row may have only the first realisations.
struct Sample<'a> {
    sigmas: &'a [f64],
    counts: Vec<&'a [Option<u32>]>,
    /// Number of gaps N behind each count, on average where long chains are cut into pieces.
    gaps: f64,
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

struct Resampled {
    whole: Places,
    resamples: Vec<Places>,
    largest: usize,
}

impl Resampled {
    fn new(sample: &Sample<'_>, seed: u64) -> Self {
        let size = sample.counts.iter().map(|counts| counts.len()).max().unwrap_or(0);
        let resample = |index| sample.places(&bootstrap::weights(seed, index, size));
        let resamples = (0..RESAMPLES).map(resample).collect();
        let whole = sample.places(&vec![1; size]);
        Resampled { whole, resamples, largest: sample.largest() }
    }

    /// Estimates a quantity with its bootstrap error, or returns `None` if too many resamples have
    /// no value.
    fn estimate(&self, pick: impl Fn(&Places) -> Option<f64>) -> Option<Estimate> {
        let resamples: Vec<_> = self.resamples.iter().map(&pick).collect();
        bootstrap::estimate(pick(&self.whole), &resamples, LEVEL)
    }

    /// Estimates the places of the rise.
    fn rise(&self) -> Rise {
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
    fn mode_interval(&self, row: usize) -> Option<[usize; 2]> {
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

    fn one(distinct: Option<u32>, impacts: u64, masses: u32) -> Counts {
        Counts {
            distinct: vec![vec![distinct]],
            impacts: vec![vec![impacts]],
            masses: vec![vec![masses]],
            ..Counts::default()
        }
    }

    /// Ten chains at each of five σ, of which the fourth is not compared.
    #[test]
    fn a_curve_by_hand() {
        let ten = |counts: [u32; 2]| (0..10).map(|i| one(Some(counts[i % 2]), 1, 1)).collect();
        let counts: [Counts; 5] = [[0, 0], [1, 2], [0, 4], [0, 0], [10, 10]].map(ten);
        let sigmas = [0.1, 0.2, 0.3, 0.4, 0.5];
        let protocol = Protocol { transient: 0.0, window: 1.0 };
        let compared = [true, true, true, false, true];
        let (sigmas, counts, compared) = (&sigmas[..], &counts[..], &compared[..]);
        let data =
            CurveData { window_index: 0, protocol, sigmas, counts, compared, gaps: 10.0, seed: 1 };
        let curve = Curve::new(&data);
        let near =
            |place: Option<Estimate>, value: f64| (place.unwrap().value - value).abs() < 1e-14;
        assert!(near(curve.rise.half_height, 0.3 + 0.2 / 6.0));
        assert!(near(curve.rise.half_height_all, 0.3 + 0.2 * 3.0 / 8.0));
        assert!(near(curve.rise.onset, 0.1 + 0.1 / 3.0) && near(curve.rise.kept_half, 0.15));
        assert!(near(curve.rise.width, 0.3 + 0.2 * 7.0 / 8.0 - 0.1 - 0.1 / 1.5));
        assert!(near(curve.rise.kept_width, 0.3 + 0.2 * 3.5 / 6.0 - 0.24));
        assert!(near(curve.rise.quarters, 0.2 * 5.0 / 8.0));
        assert_eq!((curve.rows[1].mode, curve.rows[1].mode_interval), (Some(1), Some([1, 2])));
        assert_eq!((curve.rows[3].ran, curve.rows[3].mode_interval), (10, None));
        // s = √(2.5/9), over √10.
        let mean = curve.rows[1].mean.unwrap();
        let estimate = mean.estimate().unwrap();
        assert!((estimate.error - (1.0_f64 / 36.0).sqrt()).abs() < 1e-15 && estimate.value == 1.5);
        assert!((estimate.interval[1] - mean.interval.unwrap()[1]).abs() < 0.05, "{mean:?}");
    }

    #[test]
    fn a_row_by_hand() {
        let runs = [(Some(0), 0, 0), (Some(4), 40, 3), (Some(10), 120, 9), (Some(4), 80, 3)];
        let runs = runs.map(|(k, impacts, masses)| one(k, impacts, masses));
        let rejected = Counts { rejected: 1, ..one(None, 0, 0) };
        let counts: Counts = runs.into_iter().chain([rejected]).collect();
        let row = RisePoint::new(0.1, &counts, Column { window_index: 0, largest: 10 });
        assert_eq!((row.ran, row.active, row.mode), (4, 3, Some(4)));
        let mean = |mean: Option<Mean>| mean.map(|mean| (mean.value, mean.error.unwrap()));
        assert_eq!(mean(row.mean), Some((6.0, 2.0))); // s = √12, over √3
        assert_eq!(row.mean_all.unwrap().value, 4.5);
        assert_eq!(mean(row.masses), Some((5.0, 2.0)));
        assert_eq!(row.impacts.unwrap().value, 80.0);
        assert_eq!(row.counts, [1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 1]);
    }

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
}
