//! Summarises counts of random chains at each σ and where they rise, with bootstrap errors.

use crate::counts::{Counts, Protocol};
pub use crate::resampling::{ONSET, Rise};
use crate::resampling::{Places, Resampled, Sample};
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::{Estimate, mean, mode, standard_error};
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
        let counts: [Counts; 5] = [[0, 0], [1, 2], [4, 4], [0, 0], [10, 10]].map(ten);
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
        assert!(near(curve.rise.half_height_all, 0.3 + 0.2 / 6.0));
        assert!(near(curve.rise.onset, 0.1 + 0.1 / 3.0) && near(curve.rise.kept_half, 0.15));
        assert!(near(curve.rise.width, 0.3 + 0.2 * 5.0 / 6.0 - 0.1 - 0.1 / 1.5));
        assert!(near(curve.rise.kept_width, 0.3 + 0.2 * 3.5 / 6.0 - 0.24));
        assert!(near(curve.rise.quarters, 0.3 + 0.2 * 3.5 / 6.0 - 0.24));
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
}
