//! What follows from the counts of an ensemble: means, shares and modes at each σ, and where the number of impacts rises,
//! with bootstrap errors.
//!
//! The realisations are resampled, not the rows: realisation i has the same standard normals at every σ, so a resample
//! takes its counts at all σ together.

use crate::counts::{Counts, Total};
use crate::ensemble::{Ensemble, Protocol};
use impact_numerics::bootstrap;
use impact_numerics::estimates::{LEVEL, with_error};
use impact_numerics::statistics::{
    self as stat, Estimate, count_quantile, last_rise, mode, standard_error,
};
use serde::{Deserialize, Serialize};

/// Share of N at which the rise has its onset.
pub const ONSET: f64 = 0.05;

/// Resamples behind each interval.
const RESAMPLES: u64 = 1000;

/// An ensemble with its results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Counted {
    /// What was run.
    pub ensemble: Ensemble,
    /// For each σ, totals of whole runs.
    pub runs: Vec<RunTotals>,
    /// For each window, the counts against σ.
    pub curves: Vec<Curve>,
}

/// The runs at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunTotals {
    /// Standard deviation σ of the amplitudes.
    pub sigma: f64,
    /// Realisations drawn.
    pub realisations: usize,
    /// With an overlapping start.
    pub rejected: usize,
    /// Ended by the engine before the last window did.
    pub failed: usize,
    /// All impacts.
    pub total: Total,
}

/// Counts in one window, against σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The window.
    pub protocol: Protocol,
    /// One row for each σ, rising.
    pub rows: Vec<RisePoint>,
    /// Where the rise is.
    pub rise: Rise,
}

/// A mean with its errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mean {
    /// The mean.
    pub value: f64,
    /// Its standard error; none from a single number.
    pub error: Option<f64>,
    /// Its bootstrap interval.
    pub interval: Option<[f64; 2]>,
}

impl Mean {
    fn of(sample: &[f64], interval: Option<[f64; 2]>) -> Option<Mean> {
        Some(Mean { value: stat::mean(sample)?, error: standard_error(sample), interval })
    }

    /// The mean with its standard error and the normal interval.
    pub fn estimate(&self) -> Option<Estimate> {
        Some(with_error(self.value, self.error?))
    }
}

/// Counts at one σ, of chains or of the pieces in which they are counted. The paper discards those without an impact in
/// the window.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RisePoint {
    /// Standard deviation σ of the amplitudes.
    pub sigma: f64,
    /// Realisations that ran to the end of the window.
    pub ran: usize,
    /// Of these, with at least one impact in the window.
    pub kept: usize,
    /// Different gaps with an impact: mean over those with at least one.
    pub mean: Option<Mean>,
    /// Mean over all that ran.
    pub mean_all: Option<Mean>,
    /// Mode over those with at least one; of several the lowest.
    pub mode: Option<usize>,
    /// Bootstrap interval of the mode.
    pub mode_interval: Option<[usize; 2]>,
    /// Impacts in the window of a whole chain: mean over realisations with at least one.
    pub impacts: Option<Mean>,
    /// Masses of a whole chain that are hit in the window: mean over realisations with at least one.
    pub masses: Option<Mean>,
    /// Numbers of realisations by their count k = 0..=N.
    pub counts: Vec<u32>,
}

/// The place of the rise on the σ axis, in several senses. Each is the last rise of a curve through a level, linear
/// between rows; none if it does not rise through it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
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

impl Counted {
    /// From the counts at each σ, and the curve of each window.
    pub fn new(ensemble: Ensemble, counts: &[Counts], curves: Vec<Curve>) -> Counted {
        let runs = |(&sigma, counts): (&f64, &Counts)| RunTotals {
            sigma,
            realisations: ensemble.realisations_at(sigma),
            rejected: counts.rejected,
            failed: counts.failed,
            total: counts.total.clone(),
        };
        Counted { runs: ensemble.sigmas.iter().zip(counts).map(runs).collect(), curves, ensemble }
    }

    /// The curve of a window.
    pub fn curve(&self, transient: f64, window: f64) -> Option<&Curve> {
        self.curves.iter().find(|curve| curve.protocol == Protocol { transient, window })
    }

    /// The curve of the first window.
    pub fn first(&self) -> &Curve {
        &self.curves[0]
    }

    /// Its rows whose share of overlapping starts is small enough ([`Ensemble::most_rejected`]).
    pub fn comparable(&self) -> impl Iterator<Item = &RisePoint> {
        let both = self.first().rows.iter().zip(&self.runs);
        let most = self.ensemble.most_rejected;
        let few = move |runs: &RunTotals| runs.rejected as f64 <= most * runs.realisations as f64;
        both.filter(move |(_, runs)| few(runs)).map(|(row, _)| row)
    }
}

/// Means, modes and places of a sample or of a resample.
struct Places {
    mean: Vec<Option<f64>>,
    mean_all: Vec<Option<f64>>,
    mode: Vec<Option<usize>>,
    /// In the order of [`Rise`].
    places: [Option<f64>; 7],
}

/// Counts of one window: `counts[σ][realisation]`. A row may have only the first of the realisations.
struct Sample<'a> {
    sigmas: &'a [f64],
    counts: Vec<&'a [Option<u32>]>,
    /// Gaps N behind each count, on average where long chains are counted in pieces.
    gaps: f64,
}

impl Sample<'_> {
    fn largest(&self) -> usize {
        self.gaps.ceil() as usize
    }

    fn places(&self, weights: &[u32]) -> Places {
        let sigmas = self.sigmas;
        let mut share = Vec::with_capacity(sigmas.len());
        let mut found = Places {
            mean: Vec::with_capacity(sigmas.len()),
            mean_all: Vec::with_capacity(sigmas.len()),
            mode: Vec::with_capacity(sigmas.len()),
            places: [None; 7],
        };
        let over = |sum: u64, of: u64| (of > 0).then(|| sum as f64 / of as f64);
        let mut histogram = vec![0; self.largest() + 1];
        for row in &self.counts {
            bootstrap::histogram(row, weights, &mut histogram);
            let [ran, sum] = bootstrap::total(&histogram);
            let kept = ran - u64::from(histogram[0]);
            histogram[0] = 0;
            found.mean.push(over(sum, kept));
            found.mean_all.push(over(sum, ran));
            found.mode.push(mode(&histogram));
            share.push(over(kept, ran));
        }
        let all = |share: f64| last_rise(sigmas, &found.mean_all, share * self.gaps);
        let kept = |share: f64| last_rise(sigmas, &found.mean, share * self.gaps);
        let between = |low: Option<f64>, high: Option<f64>| Some(high? - low?);
        found.places = [
            kept(0.5),
            all(0.5),
            all(ONSET),
            last_rise(sigmas, &share, 0.5),
            between(all(0.1), all(0.9)),
            between(kept(0.25), kept(0.75)),
            between(all(0.25), all(0.75)),
        ];
        found
    }
}

/// A sample and its resamples.
struct Resampled {
    whole: Places,
    resamples: Vec<Places>,
    largest: usize,
}

impl Resampled {
    fn new(sample: &Sample<'_>, seed: u64) -> Self {
        let size = sample.counts.iter().map(|counts| counts.len()).max().unwrap_or(0);
        let one = |index| sample.places(&bootstrap::weights(seed, index, size));
        Resampled {
            whole: sample.places(&vec![1; size]),
            resamples: (0..RESAMPLES).map(one).collect(),
            largest: sample.largest(),
        }
    }

    fn estimate(&self, pick: impl Fn(&Places) -> Option<f64>) -> Option<Estimate> {
        let resamples: Vec<_> = self.resamples.iter().map(&pick).collect();
        bootstrap::estimate(pick(&self.whole), &resamples, LEVEL)
    }

    fn rise(&self) -> Rise {
        let place = |i: usize| self.estimate(|sample| sample.places[i]);
        let [half_height, half_height_all, onset, kept_half, width, kept_width, quarters] =
            std::array::from_fn(place);
        Rise { half_height, half_height_all, onset, kept_half, width, kept_width, quarters }
    }

    /// The percentile interval of the mode at a σ: whole numbers, at both ends an order statistic.
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

impl Curve {
    /// The curve of the window with this index.
    pub fn new(ensemble: &Ensemble, counts: &[Counts], window: usize) -> Curve {
        let mut used: Vec<&[Option<u32>]> = Vec::new();
        for (&sigma, found) in ensemble.sigmas.iter().zip(counts) {
            let most = ensemble.most_rejected * ensemble.realisations_at(sigma) as f64;
            used.push(if found.rejected as f64 <= most { &found.distinct[window] } else { &[] });
        }
        let gaps = ensemble.chain.gaps() as f64 / ensemble.pieces as f64;
        let sample = Sample { sigmas: &ensemble.sigmas, counts: used, gaps };
        let all = Resampled::new(&sample, ensemble.seed);
        let interval = |pick: &dyn Fn(&Places) -> Option<f64>| Some(all.estimate(pick)?.interval);
        let row = |(row, (&sigma, found)): (usize, (&f64, &Counts))| RisePoint {
            mode_interval: all.mode_interval(row),
            ..RisePoint::new(
                sigma,
                found,
                window,
                all.largest,
                [interval(&|places| places.mean[row]), interval(&|places| places.mean_all[row])],
            )
        };
        let rows = ensemble.sigmas.iter().zip(counts).enumerate().map(row).collect();
        Curve { protocol: ensemble.protocols[window], rows, rise: all.rise() }
    }
}

impl RisePoint {
    /// The row of a σ in one window, without the interval of the mode; counts go up to `largest`, and the intervals are
    /// those of both means.
    pub fn new(
        sigma: f64,
        of: &Counts,
        window: usize,
        largest: usize,
        intervals: [Option<[f64; 2]>; 2],
    ) -> RisePoint {
        let mut counts = vec![0; largest + 1];
        of.distinct[window].iter().flatten().for_each(|&k| counts[k as usize] += 1);
        let all: Vec<f64> = of.distinct[window].iter().flatten().map(|&k| f64::from(k)).collect();
        let kept: Vec<f64> = all.iter().copied().filter(|&k| k > 0.0).collect();
        let mut kept_counts = counts.clone();
        kept_counts[0] = 0;
        let active = || of.impacts[window].iter().zip(&of.masses[window]).filter(|run| *run.0 > 0);
        let impacts: Vec<f64> = active().map(|(impacts, _)| *impacts as f64).collect();
        let masses: Vec<f64> = active().map(|(_, masses)| f64::from(*masses)).collect();
        RisePoint {
            sigma,
            ran: all.len(),
            kept: kept.len(),
            mean: Mean::of(&kept, intervals[0]),
            mean_all: Mean::of(&all, intervals[1]),
            mode: mode(&kept_counts),
            mode_interval: None,
            impacts: Mean::of(&impacts, None),
            masses: Mean::of(&masses, None),
            counts,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIGMAS: [f64; 5] = [0.1, 0.2, 0.3, 0.4, 0.5];

    /// Four realisations on five σ, N = 10.
    fn counts() -> Vec<Vec<Option<u32>>> {
        [[0, 0, 0, 0], [0, 0, 0, 2], [0, 4, 4, 6], [8, 8, 8, 6], [10, 10, 10, 10]]
            .map(|row| row.map(Some).to_vec())
            .to_vec()
    }

    fn sample<'a>(sigmas: &'a [f64], counts: &'a [Vec<Option<u32>>]) -> Sample<'a> {
        Sample { sigmas, counts: counts.iter().map(Vec::as_slice).collect(), gaps: 10.0 }
    }

    #[test]
    fn places_by_hand() {
        let found = sample(&SIGMAS, &counts()).places(&[1; 4]);
        assert_eq!(found.mean_all, [0.0, 0.5, 3.5, 7.5, 10.0].map(Some));
        let kept = [None, Some(2.0), Some(14.0 / 3.0), Some(7.5), Some(10.0)];
        assert_eq!(found.mean, kept);
        assert_eq!(found.mode, [None, Some(2), Some(4), Some(8), Some(10)]);
        let expected = [
            0.3 + 0.1 * (5.0 - 14.0 / 3.0) / (7.5 - 14.0 / 3.0),
            0.3 + 0.1 * 1.5 / 4.0,
            0.2,  // N/20 is met exactly at the second row
            0.25, // from 1/4 with an impact to 3/4
            // From 1, between 0.5 and 3.5, to 9, between 7.5 and 10.
            (0.4 + 0.1 * 0.6) - (0.2 + 0.1 / 6.0),
            0.3 + 0.1 - 0.2 - 0.1 * 0.5 / (14.0 / 3.0 - 2.0),
            // From 2.5, between 0.5 and 3.5, to 7.5.
            0.4 - (0.2 + 0.1 * 2.0 / 3.0),
        ];
        for (place, expected) in found.places.iter().zip(expected) {
            assert!((place.unwrap() - expected).abs() < 1e-15, "{place:?} {expected}");
        }
    }

    fn one(distinct: Option<u32>, impacts: u64, masses: u32) -> Counts {
        Counts {
            distinct: vec![vec![distinct]],
            impacts: vec![vec![impacts]],
            masses: vec![vec![masses]],
            ..Counts::default()
        }
    }

    #[test]
    fn a_row_by_hand() {
        let all = [(Some(0), 0, 0), (Some(4), 40, 3), (Some(10), 120, 9), (Some(4), 80, 3)];
        let all = all.map(|(k, impacts, masses)| one(k, impacts, masses));
        let rejected = Counts { rejected: 1, ..one(None, 0, 0) };
        let counts: Counts = all.into_iter().chain([rejected]).collect();
        let row = RisePoint::new(0.1, &counts, 0, 10, [None; 2]);
        assert_eq!((row.ran, row.kept, row.mode), (4, 3, Some(4)));
        let mean = |mean: Option<Mean>| mean.map(|mean| (mean.value, mean.error.unwrap()));
        assert_eq!(mean(row.mean), Some((6.0, 2.0))); // s = √12, over √3
        assert_eq!(row.mean_all.unwrap().value, 4.5);
        assert_eq!(mean(row.masses), Some((5.0, 2.0)));
        assert_eq!(row.impacts.unwrap().value, 80.0);
        assert_eq!(row.counts, [1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 1]);
    }

    #[test]
    fn where_many_starts_overlap_no_place_is_read() {
        let overlapping = |k| -> Counts {
            let rejected = Counts { rejected: 1, ..one(None, 0, 0) };
            (0..6).map(|_| one(Some(k), 1, 1)).chain([rejected]).collect()
        };
        let ensemble = Ensemble {
            chain: crate::Chain { masses: 9, ..crate::Chain::default() },
            sigmas: vec![0.1, 0.2],
            realisations: 7,
            ..Ensemble::default()
        };
        let curve = Curve::new(&ensemble, &[overlapping(0), overlapping(10)], 0);
        assert_eq!((curve.rise.half_height_all, curve.rows[1].ran), (None, 6));
    }
}
