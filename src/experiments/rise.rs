//! Where the number of impacts rises: half height, onset and width, with bootstrap intervals.
//!
//! The realisations are resampled, not the rows: realisation i has the same standard normals at
//! every σ, so a resample takes its counts at all σ together.

use crate::params::{LEVEL, RESAMPLES};
use impact_numerics::bootstrap;
use impact_numerics::statistics::{Estimate, count_quantile, last_rise, mode};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Share of N at which the rise has its onset.
pub const ONSET: f64 = 0.05;

/// The place of the rise on the σ axis, in several declared senses. Each is the last rise of a
/// curve through a level, linear between rows; a curve that does not rise through it has none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rise {
    /// Half height: the mean of the kept reaches N/2.
    pub half_height: Option<Estimate>,
    /// The mean of all (those without impact included) reaches N/2.
    pub half_height_all: Option<Estimate>,
    /// Onset: the mean of all reaches N/20.
    pub onset: Option<Estimate>,
    /// Half of the realisations have an impact in the window.
    pub kept_half: Option<Estimate>,
    /// Width of the rise: the mean of all from a tenth to nine tenths of N.
    pub width: Option<Estimate>,
    /// The mean of the kept from N/4 to 3N/4: it is never as low as a tenth where any are kept.
    pub kept_width: Option<Estimate>,
}

/// Bootstrap intervals of one row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Intervals {
    /// Of the mean of the kept.
    pub mean_kept: Option<[f64; 2]>,
    /// Of the mean of all.
    pub mean_all: Option<[f64; 2]>,
    /// Of the mode of the kept.
    pub mode: Option<[usize; 2]>,
}

/// What is computed of the whole sample and of each resample.
struct Curves {
    mean_kept: Vec<Option<f64>>,
    mean_all: Vec<Option<f64>>,
    mode: Vec<Option<usize>>,
    /// The places of [`Rise`], in its order.
    places: [Option<f64>; 6],
}

impl Curves {
    fn new(sigmas: &[f64], counts: &[Vec<Option<u32>>], gaps: usize, weights: &[u32]) -> Self {
        let mut kept_share = Vec::with_capacity(sigmas.len());
        let mut curves = Curves {
            mean_kept: Vec::with_capacity(sigmas.len()),
            mean_all: Vec::with_capacity(sigmas.len()),
            mode: Vec::with_capacity(sigmas.len()),
            places: [None; 6],
        };
        let ratio = |sum: u64, of: u64| (of > 0).then(|| sum as f64 / of as f64);
        let mut histogram = vec![0; gaps + 1];
        for row in counts {
            bootstrap::histogram(row, weights, &mut histogram);
            let [ran, sum] = bootstrap::total(&histogram);
            let kept = ran - u64::from(histogram[0]);
            histogram[0] = 0;
            curves.mean_kept.push(ratio(sum, kept));
            curves.mean_all.push(ratio(sum, ran));
            curves.mode.push(mode(&histogram));
            kept_share.push(ratio(kept, ran));
        }
        let height = gaps as f64;
        let all = |share: f64| last_rise(sigmas, &curves.mean_all, share * height);
        let kept = |share: f64| last_rise(sigmas, &curves.mean_kept, share * height);
        let between = |low: Option<f64>, high: Option<f64>| Some(high? - low?);
        curves.places = [
            kept(0.5),
            all(0.5),
            all(ONSET),
            last_rise(sigmas, &kept_share, 0.5),
            between(all(0.1), all(0.9)),
            between(kept(0.25), kept(0.75)),
        ];
        curves
    }
}

/// The curves of a sample and of its resamples.
pub struct Resampled {
    whole: Curves,
    resampled: Vec<Curves>,
    gaps: usize,
}

/// Finds the rise in `counts[σ][realisation]` of a chain with `gaps` gaps. A row may have only the first of the
/// realisations.
pub fn find(sigmas: &[f64], counts: &[Vec<Option<u32>>], gaps: usize, seed: u64) -> Rise {
    Resampled::of(sigmas, counts, gaps, seed).rise()
}

impl Resampled {
    /// Of what [`find`] is given.
    pub fn of(sigmas: &[f64], counts: &[Vec<Option<u32>>], gaps: usize, seed: u64) -> Self {
        let realisations = counts.iter().map(Vec::len).max().unwrap_or(0);
        let weights = |index| bootstrap::weights(seed, index, realisations);
        let one = |index| Curves::new(sigmas, counts, gaps, &weights(index));
        Resampled {
            whole: Curves::new(sigmas, counts, gaps, &vec![1; realisations]),
            resampled: (0..RESAMPLES as u64).into_par_iter().map(one).collect(),
            gaps,
        }
    }

    fn estimate(&self, pick: impl Fn(&Curves) -> Option<f64>) -> Option<Estimate> {
        let of_resamples: Vec<_> = self.resampled.iter().map(&pick).collect();
        bootstrap::estimate(pick(&self.whole), &of_resamples, LEVEL)
    }

    /// Where the rise is.
    pub fn rise(&self) -> Rise {
        let place = |i: usize| self.estimate(|curves| curves.places[i]);
        Rise {
            half_height: place(0),
            half_height_all: place(1),
            onset: place(2),
            kept_half: place(3),
            width: place(4),
            kept_width: place(5),
        }
    }

    /// The intervals of each row.
    pub fn intervals(&self) -> Vec<Intervals> {
        let interval = |pick: &dyn Fn(&Curves) -> Option<f64>| Some(self.estimate(pick)?.interval);
        let row = |row: usize| Intervals {
            mean_kept: interval(&|curves| curves.mean_kept[row]),
            mean_all: interval(&|curves| curves.mean_all[row]),
            mode: self.whole.mode[row].and_then(|_| mode_interval(self.gaps, &self.resampled, row)),
        };
        (0..self.whole.mode.len()).map(row).collect()
    }
}

/// The percentile interval of the mode: whole numbers, at both ends an order statistic.
fn mode_interval(gaps: usize, resampled: &[Curves], row: usize) -> Option<[usize; 2]> {
    let mut histogram = vec![0; gaps + 1];
    for k in resampled.iter().filter_map(|curves| curves.mode[row]) {
        histogram[k] += 1;
    }
    let tail = 0.5 * (1.0 - LEVEL);
    Some([count_quantile(&histogram, tail)?, count_quantile(&histogram, 1.0 - tail)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four realisations on five σ, N = 10.
    fn counts() -> Vec<Vec<Option<u32>>> {
        [[0, 0, 0, 0], [0, 0, 0, 2], [0, 4, 4, 6], [8, 8, 8, 6], [10, 10, 10, 10]]
            .map(|row| row.map(Some).to_vec())
            .to_vec()
    }

    #[test]
    fn places_by_hand() {
        let sigmas = [0.1, 0.2, 0.3, 0.4, 0.5];
        let curves = Curves::new(&sigmas, &counts(), 10, &[1; 4]);
        assert_eq!(curves.mean_all, [0.0, 0.5, 3.5, 7.5, 10.0].map(Some));
        let kept = [None, Some(2.0), Some(14.0 / 3.0), Some(7.5), Some(10.0)];
        assert_eq!(curves.mean_kept, kept);
        assert_eq!(curves.mode, [None, Some(2), Some(4), Some(8), Some(10)]);
        let expected = [
            0.3 + 0.1 * (5.0 - 14.0 / 3.0) / (7.5 - 14.0 / 3.0),
            0.3 + 0.1 * 1.5 / 4.0,
            0.2,  // N/20 is met exactly at the second row
            0.25, // from 1/4 kept to 3/4
            // From 1, between 0.5 and 3.5, to 9, between 7.5 and 10.
            (0.4 + 0.1 * 0.6) - (0.2 + 0.1 / 6.0),
            0.3 + 0.1 - 0.2 - 0.1 * 0.5 / (14.0 / 3.0 - 2.0),
        ];
        for (place, expected) in curves.places.iter().zip(expected) {
            assert!((place.unwrap() - expected).abs() < 1e-15, "{place:?} {expected}");
        }
    }

    #[test]
    fn rejected_realisations_weigh_nothing() {
        let mut with = counts();
        with.iter_mut().for_each(|row| row.push(None));
        let sigmas = [0.1, 0.2, 0.3, 0.4, 0.5];
        let places = Curves::new(&sigmas, &with, 10, &[1; 5]).places;
        assert_eq!(places, Curves::new(&sigmas, &counts(), 10, &[1; 4]).places);
    }

    #[test]
    fn without_spread_there_is_no_width() {
        // All realisations alike: every resample gives the same places.
        let counts: Vec<_> = [0, 4, 8].map(|k| vec![Some(k); 20]).to_vec();
        let found = Resampled::of(&[0.1, 0.2, 0.3], &counts, 10, 1);
        let (rise, intervals) = (found.rise(), found.intervals());
        let half = rise.half_height_all.unwrap();
        assert!(half.error < 1e-12);
        assert_eq!(half.interval, [half.value, half.value]);
        assert_eq!(rise.width, None, "8 of 10 is below nine tenths");
        assert_eq!(intervals[1].mean_all, Some([4.0, 4.0]));
        assert_eq!(intervals[2].mode, Some([8, 8]));
        assert_eq!(intervals[0].mode, None);
    }
}
