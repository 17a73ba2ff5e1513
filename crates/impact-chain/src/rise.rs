//! Summarises counts of random chains at each σ and where they rise, with bootstrap errors.

use crate::counts::{Counts, Protocol};
pub use crate::resampling::ONSET;
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
    /// Standard error; none from a single number.
    pub error: Option<f64>,
    /// The interval of 95 % by the bootstrap, if there is one.
    pub interval: Option<[f64; 2]>,
}

impl Mean {
    fn of(sample: &[f64]) -> Option<Mean> {
        Some(Mean { value: mean(sample)?, error: standard_error(sample), interval: None })
    }

    /// Returns the mean with its standard error and the normal interval; none without an error.
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
    /// Those of them with at least one impact in the window.
    pub kept: usize,
    /// Different gaps with an impact: mean over those with at least one.
    pub mean: Option<Mean>,
    /// Mean over all that ran.
    pub mean_all: Option<Mean>,
    /// Mode over those with at least one; the lowest of several.
    pub mode: Option<usize>,
    /// The interval of the mode of 95 %.
    pub mode_interval: Option<[usize; 2]>,
    /// Impacts of a whole chain in the window: mean over realisations with at least one.
    pub impacts: Option<Mean>,
    /// Masses of a whole chain that are hit in the window: mean over those with an impact.
    pub masses: Option<Mean>,
    /// Numbers of realisations by their count k = 0..=N.
    pub counts: Vec<u32>,
}

/// Places of the rise on the σ axis, each the last rise of a curve through a level, or none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct Rise {
    /// Half height: the mean over realisations with an impact reaches N/2.
    pub half_height: Option<Estimate>,
    /// The mean over all (those without impact included) reaches N/2.
    pub half_height_all: Option<Estimate>,
    /// Onset: the mean over all reaches N/20.
    pub onset: Option<Estimate>,
    /// Half of the realisations have an impact in the window.
    pub kept_half: Option<Estimate>,
    /// Width of the rise: the mean over all from a tenth to nine tenths of N.
    pub width: Option<Estimate>,
    /// Width of the mean over realisations with an impact, from N/4 to 3N/4.
    pub kept_width: Option<Estimate>,
    /// Width of the mean over all, from N/4 to 3N/4.
    pub quarters: Option<Estimate>,
}

/// What a [`Curve`] is computed from.
#[derive(Clone, Copy, Debug)]
pub struct CurveData<'a> {
    /// The window.
    pub protocol: Protocol,
    /// Its number among those of the counts, from 0 on.
    pub window: usize,
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
    pub fn new(data: &CurveData) -> Curve {
        let &CurveData { window, protocol, sigmas, counts, compared, gaps, seed } = data;
        let mut used: Vec<&[Option<u32>]> = Vec::new();
        for (found, &compared) in counts.iter().zip(compared) {
            used.push(if compared { &found.distinct[window] } else { &[] });
        }
        let sample = Sample { sigmas, counts: used, gaps };
        let all = Resampled::new(&sample, seed);
        let interval = |pick: &dyn Fn(&Places) -> Option<f64>| Some(all.estimate(pick)?.interval);
        let mut rows = Vec::with_capacity(counts.len());
        for (row, (&sigma, found)) in sigmas.iter().zip(counts).enumerate() {
            let mut point = RisePoint::new(sigma, found, Column { window, largest: all.largest });
            point.mode_interval = all.mode_interval(row);
            if let Some(mean) = &mut point.mean {
                mean.interval = interval(&|places| places.mean[row]);
            }
            if let Some(mean) = &mut point.mean_all {
                mean.interval = interval(&|places| places.mean_all[row]);
            }
            rows.push(point);
        }
        let [half_height, half_height_all, onset, kept_half, width, kept_width, quarters] =
            all.rise();
        let rise =
            Rise { half_height, half_height_all, onset, kept_half, width, kept_width, quarters };
        Curve { protocol, rows, rise }
    }
}

/// Which of the counts a [`RisePoint`] shows.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// The number of the window, from 0 on.
    pub window: usize,
    /// The largest count that is possible.
    pub largest: usize,
}

impl RisePoint {
    /// Computes the row of a σ, without intervals.
    ///
    /// # Panics
    /// Panics if the counts have no such window, or one is above the largest.
    pub fn new(sigma: f64, found: &Counts, column: Column) -> RisePoint {
        let Column { window, largest } = column;
        let mut counts = vec![0; largest + 1];
        let mut all = Vec::new();
        for &k in found.distinct[window].iter().flatten() {
            counts[k as usize] += 1;
            all.push(f64::from(k));
        }
        let kept: Vec<f64> = all.iter().copied().filter(|&k| k > 0.0).collect();
        let mut kept_counts = counts.clone();
        kept_counts[0] = 0;
        let runs = found.impacts[window].iter().zip(&found.masses[window]);
        let hit = runs.filter(|(impacts, _)| **impacts > 0);
        let (impacts, masses): (Vec<_>, Vec<_>) =
            hit.map(|(&impacts, &masses)| (impacts as f64, f64::from(masses))).unzip();
        RisePoint {
            sigma,
            ran: all.len(),
            kept: kept.len(),
            mean: Mean::of(&kept),
            mean_all: Mean::of(&all),
            mode: mode(&kept_counts),
            mode_interval: None,
            impacts: Mean::of(&impacts),
            masses: Mean::of(&masses),
            counts,
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
        let of = |counts: [u32; 2]| (0..10).map(|i| one(Some(counts[i % 2]), 1, 1)).collect();
        let counts: [Counts; 5] = [[0, 0], [1, 2], [4, 4], [0, 0], [10, 10]].map(of);
        let sigmas = [0.1, 0.2, 0.3, 0.4, 0.5];
        let protocol = Protocol { transient: 0.0, window: 1.0 };
        let compared = [true, true, true, false, true];
        let (sigmas, counts, compared) = (&sigmas[..], &counts[..], &compared[..]);
        let data = CurveData { window: 0, protocol, sigmas, counts, compared, gaps: 10.0, seed: 1 };
        let found = Curve::new(&data);
        let near =
            |place: Option<Estimate>, value: f64| (place.unwrap().value - value).abs() < 1e-14;
        assert!(near(found.rise.half_height, 0.3 + 0.2 / 6.0));
        assert!(near(found.rise.half_height_all, 0.3 + 0.2 / 6.0));
        assert!(near(found.rise.onset, 0.1 + 0.1 / 3.0) && near(found.rise.kept_half, 0.15));
        assert!(near(found.rise.width, 0.3 + 0.2 * 5.0 / 6.0 - 0.1 - 0.1 / 1.5));
        assert!(near(found.rise.kept_width, 0.3 + 0.2 * 3.5 / 6.0 - 0.24));
        assert!(near(found.rise.quarters, 0.3 + 0.2 * 3.5 / 6.0 - 0.24));
        assert_eq!((found.rows[1].mode, found.rows[1].mode_interval), (Some(1), Some([1, 2])));
        assert_eq!((found.rows[3].ran, found.rows[3].mode_interval), (10, None));
        // s = √(2.5/9), over √10.
        let mean = found.rows[1].mean.unwrap();
        let estimate = mean.estimate().unwrap();
        assert!((estimate.error - (1.0_f64 / 36.0).sqrt()).abs() < 1e-15 && estimate.value == 1.5);
        assert!((estimate.interval[1] - mean.interval.unwrap()[1]).abs() < 0.05, "{mean:?}");
    }

    #[test]
    fn a_row_by_hand() {
        let all = [(Some(0), 0, 0), (Some(4), 40, 3), (Some(10), 120, 9), (Some(4), 80, 3)];
        let all = all.map(|(k, impacts, masses)| one(k, impacts, masses));
        let rejected = Counts { rejected: 1, ..one(None, 0, 0) };
        let counts: Counts = all.into_iter().chain([rejected]).collect();
        let row = RisePoint::new(0.1, &counts, Column { window: 0, largest: 10 });
        assert_eq!((row.ran, row.kept, row.mode), (4, 3, Some(4)));
        let mean = |mean: Option<Mean>| mean.map(|mean| (mean.value, mean.error.unwrap()));
        assert_eq!(mean(row.mean), Some((6.0, 2.0))); // s = √12, over √3
        assert_eq!(row.mean_all.unwrap().value, 4.5);
        assert_eq!(mean(row.masses), Some((5.0, 2.0)));
        assert_eq!(row.impacts.unwrap().value, 80.0);
        assert_eq!(row.counts, [1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 1]);
    }
}
