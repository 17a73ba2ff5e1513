//! Finds where the most likely count jumps as σ grows: where one peak of the distribution of counts
//! overtakes another.
//!
//! The counts 1 to N of the realisations with an impact have three parts: one number at an *end*
//! (all N gaps, or a single one), the *bulk*, which is at least N/10 from it, and the numbers
//! *between*. Where the share of the end passes the height of the bulk's peak, the mode *jumps* if
//! no number between is as likely there, and *climbs* if one is more likely, each with 95 %
//! confidence; else the sample does not tell. So a jump is a step of N/10 or more, and a move of
//! the mode among numbers that differ by chance is none.

use impact_numerics::bootstrap;
use impact_numerics::estimates::LEVEL;
use impact_numerics::statistics::Estimate;
#[cfg(feature = "serde")]
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

const RESAMPLES: u64 = 400;

/// Which numbers compete: one at an end, the bulk at least N/10 from it, and those between.
struct Parts {
    end: usize,
    between: RangeInclusive<usize>,
    bulk: RangeInclusive<usize>,
}

impl Parts {
    /// Returns the parts of the counts 1 to `gaps`, whose end is all gaps.
    fn all_gaps(gaps: usize) -> Parts {
        let last = gaps - gaps.div_ceil(10);
        Parts { end: gaps, between: last + 1..=gaps - 1, bulk: 2..=last }
    }

    /// Returns the parts whose end is a single gap.
    fn single_gap(gaps: usize) -> Parts {
        let first = 1 + gaps.div_ceil(10);
        Parts { end: 1, between: 2..=first - 1, bulk: first..=gaps - gaps.div_ceil(10) }
    }
}

/// Shares of chains at one σ: at the end, in the peak of the bulk, and in the likeliest between.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct Heights {
    /// Standard deviation σ of the amplitudes.
    pub sigma: f64,
    /// Share of the number at the end.
    pub end: f64,
    /// Share of the peak of the bulk.
    pub bulk: f64,
    /// Share of the likeliest number between.
    pub between: f64,
    /// Number of gaps at the peak of the bulk.
    pub peak: f64,
    /// Number of chains behind the shares.
    pub chains: f64,
}

/// Returns the mean count of the numbers in the range that lie within `half_width` of one of them.
fn smoothed(histogram: &[u32], range: &RangeInclusive<usize>, k: usize, half_width: usize) -> f64 {
    let from = k.saturating_sub(half_width).max(*range.start());
    let to = (k + half_width).min(*range.end());
    let sum: u32 = histogram[from..=to].iter().sum();
    f64::from(sum) / (to + 1 - from) as f64
}

/// Finds the peak of a range: its place in one half of the chains, its height in the other, since
/// the largest of noisy counts is too high on average; the mean of both ways.
fn peak(
    halves: &[Vec<u32>; 2],
    range: &RangeInclusive<usize>,
    half_width: usize,
    chains: f64,
) -> [f64; 2] {
    let mut mean = [0.0; 2];
    for (half, other) in [(0, 1), (1, 0)] {
        let height = |k: &usize| smoothed(&halves[half], range, *k, half_width);
        let highest =
            range.clone().reduce(|best, k| if height(&k) > height(&best) { k } else { best });
        let place = highest.unwrap_or(*range.start());
        mean[0] += 0.5 * place as f64;
        // Each half has half of the chains.
        mean[1] += smoothed(&halves[other], range, place, half_width) / chains;
    }
    mean
}

impl Heights {
    /// Computes the shares of one σ from the histograms of the two halves of its chains.
    fn new(sigma: f64, halves: &[Vec<u32>; 2], parts: &Parts, half_width: usize) -> Heights {
        let total = |half: &Vec<u32>| half.iter().skip(1).sum::<u32>();
        let chains = f64::from(halves.iter().map(total).sum::<u32>().max(1));
        let [place, bulk] = peak(halves, &parts.bulk, half_width, chains);
        let [_, between] = peak(halves, &parts.between, 0, chains);
        let end = halves.iter().map(|half| half[parts.end]).sum::<u32>();
        Heights { sigma, end: f64::from(end) / chains, bulk, between, peak: place, chains }
    }
}

/// Where the end and the bulk are equally likely, read from lines through the σ around it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Crossing {
    sigma: f64,
    peak: f64,
    /// Height there less that of the likeliest number between, over the height.
    clearance: f64,
}

/// Distance in σ within which curves are taken as straight.
const STRAIGHT: f64 = 0.0075;

/// Finds where the end overtakes the bulk, or the other way round for a single gap: the logarithm
/// of the ratio of their shares is a straight line there. Returns `None` without such a place.
fn crossing(rows: &[Heights], rises: bool) -> Option<Crossing> {
    // Up to there what is overtaken leads in all: one row that is off by chance is no place.
    let (mut sum, mut least, mut after) = (0.0, 0.0, 0_usize);
    for (row, number) in rows.iter().zip(1..) {
        let lead = (row.end - row.bulk) * row.chains.sqrt();
        sum += if rises { lead } else { -lead };
        (least, after) = if sum < least { (sum, number) } else { (least, after) };
    }
    let centre = 0.5 * (rows[after.checked_sub(1)?].sigma + rows.get(after)?.sigma);
    let near = || rows.iter().filter(|row| (row.sigma - centre).abs() <= STRAIGHT + 1e-9);
    // Half a chain more, so that none has a logarithm; weights as of two counts.
    let counts = |row: &Heights| [row.end, row.bulk].map(|share| share * row.chains + 0.5);
    let ratio = |row: &Heights| {
        let [end, bulk] = counts(row);
        (row.sigma - centre, pxfm::f_log(end / bulk), end * bulk / (end + bulk))
    };
    let (level, slope) = line(near().map(ratio))?;
    let shift = -level / slope;
    let value = |column: fn(&Heights) -> f64| {
        let points = near().map(|row| (row.sigma - centre, column(row), row.chains));
        line(points).map(|(level, slope)| level + slope * shift)
    };
    let height = value(|row| 0.5 * (row.end + row.bulk))?;
    let usable = slope != 0.0 && (slope > 0.0) == rises && shift.abs() <= STRAIGHT && height > 0.0;
    usable.then_some(Crossing {
        sigma: centre + shift,
        peak: value(|row| row.peak)?,
        clearance: 1.0 - value(|row| row.between)? / height,
    })
}

/// Returns level and slope of the weighted least-squares line through points (x, y, weight), or
/// `None` below two different x.
fn line(points: impl Iterator<Item = (f64, f64, f64)>) -> Option<(f64, f64)> {
    let [mut w, mut x, mut y, mut xx, mut xy] = [0.0; 5];
    for (abscissa, ordinate, weight) in points {
        w += weight;
        x += weight * abscissa;
        y += weight * ordinate;
        xx += weight * abscissa * abscissa;
        xy += weight * abscissa * ordinate;
    }
    let determinant = w * xx - x * x;
    (determinant > 1e-12 * w * w * STRAIGHT * STRAIGHT)
        .then(|| ((y * xx - x * xy) / determinant, (w * xy - x * y) / determinant))
}

/// The counts of independent realisations at one σ; `None` for a run that was not complete.
#[derive(Clone, Copy, Debug)]
pub struct Sample<'a> {
    /// Standard deviation σ of the amplitudes.
    pub sigma: f64,
    /// The count of each realisation.
    pub counts: &'a [Option<u32>],
    /// Seed of its resamples, another for each σ.
    pub seed: u64,
}

impl Sample<'_> {
    /// Returns the histograms of the even and of the odd realisations, counted by weights.
    fn halves(&self, gaps: usize, weight: impl Fn(usize) -> u32) -> [Vec<u32>; 2] {
        let mut halves = [vec![0; gaps + 1], vec![0; gaps + 1]];
        for (index, count) in self.counts.iter().enumerate() {
            if let Some(k) = count {
                halves[index % 2][*k as usize] += weight(index);
            }
        }
        halves
    }

    /// Returns the same of a resample, in which each half is drawn from itself.
    fn resampled(&self, gaps: usize, resample: u64) -> [Vec<u32>; 2] {
        let size = self.counts.len() / 2;
        let draws = [0, 1].map(|half| bootstrap::weights(self.seed, 2 * resample + half, size));
        self.halves(gaps, |index| draws[index % 2].get(index / 2).copied().unwrap_or(0))
    }
}

/// Where the most likely count passes from one part to another, with bootstrap errors, each `None`
/// where the sample shows none; where the mode surely climbs there is a clearance only.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct Passing {
    /// The σ at which both are equally likely.
    pub sigma: Option<Estimate>,
    /// Number of gaps at the peak of the bulk there.
    pub peak: Option<Estimate>,
    /// Height there less that of the likeliest number between, over the height.
    pub clearance: Option<Estimate>,
}

impl Passing {
    fn new(whole: Option<Crossing>, resamples: &[Option<Crossing>]) -> Passing {
        let estimate = |column: fn(Crossing) -> f64| {
            let values: Vec<_> = resamples.iter().map(|crossing| crossing.map(column)).collect();
            bootstrap::estimate(whole.map(column), &values, LEVEL)
        };
        let clearance = estimate(|crossing| crossing.clearance);
        let climbs = clearance.is_some_and(|clearance| clearance.interval[1] < 0.0);
        let place = |column: fn(Crossing) -> f64| estimate(column).filter(|_| !climbs);
        let sigma = place(|crossing| crossing.sigma);
        Passing { sigma, peak: place(|crossing| crossing.peak), clearance }
    }

    /// Returns whether the mode surely jumps (true) or surely climbs (false), or `None` if neither
    /// is sure.
    #[must_use]
    pub fn is_jump(&self) -> Option<bool> {
        let [low, high] = self.clearance?.interval;
        (low > 0.0 || high < 0.0).then_some(low > 0.0)
    }
}

/// The most likely count in one window, against σ.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct ModeJump {
    /// For each σ the shares of all gaps, of the bulk and of the numbers between.
    pub rows: Vec<Heights>,
    /// For each σ the number of gaps at the peak of the bulk.
    pub peaks: Vec<Option<Estimate>>,
    /// Where all gaps become the most likely number.
    pub all_gaps: Passing,
    /// Where a single gap stops being the most likely number.
    pub single_gap: Passing,
}

/// How counts are read as a distribution.
#[derive(Clone, Copy, Debug)]
pub struct Histogram {
    /// The largest count, N.
    pub gaps: usize,
    /// The bulk is smoothed over the numbers within this of each.
    pub half_width: usize,
}

/// Measures the jump in samples at rising σ.
#[must_use]
pub fn mode_jump(samples: &[Sample<'_>], histogram: Histogram) -> ModeJump {
    let Histogram { gaps, half_width } = histogram;
    let read = |halves: &dyn Fn(&Sample<'_>) -> [Vec<u32>; 2]| {
        let [upper, lower] = [Parts::all_gaps(gaps), Parts::single_gap(gaps)];
        let both = samples.iter().map(|sample| {
            let (halves, sigma) = (halves(sample), sample.sigma);
            let heights = |parts| Heights::new(sigma, &halves, parts, half_width);
            (heights(&upper), heights(&lower))
        });
        let (upper, lower): (Vec<Heights>, Vec<Heights>) = both.unzip();
        let crossings = [crossing(&upper, true), crossing(&lower, false)];
        (upper, crossings)
    };
    let (rows, whole) = read(&|sample| sample.halves(gaps, |_| 1));
    let resamples: Vec<_> =
        (0..RESAMPLES).map(|resample| read(&|sample| sample.resampled(gaps, resample))).collect();
    let passing = |end: usize| {
        let crossings: Vec<_> = resamples.iter().map(|(_, crossings)| crossings[end]).collect();
        Passing::new(whole[end], &crossings)
    };
    let peak = |(place, row): (usize, &Heights)| {
        let peaks: Vec<_> = resamples.iter().map(|(rows, _)| Some(rows[place].peak)).collect();
        bootstrap::estimate(Some(row.peak), &peaks, LEVEL)
    };
    let peaks = rows.iter().enumerate().map(peak).collect();
    ModeJump { peaks, all_gaps: passing(0), single_gap: passing(1), rows }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two halves, each with 20 chains at 39, 40 and 41, `all` at 101 and `between` at 95.
    fn heights(sigma: f64, all: u32, between: u32) -> Heights {
        let mut half = vec![0; 102];
        half[39..=41].fill(20);
        half[101] = all;
        half[95] = between;
        Heights::new(sigma, &[half.clone(), half], &Parts::all_gaps(101), 1)
    }

    #[test]
    fn parts_are_a_tenth_of_all_gaps_apart() {
        let parts = Parts::all_gaps(101);
        assert_eq!((parts.end, parts.between, parts.bulk), (101, 91..=100, 2..=90));
        let parts = Parts::single_gap(101);
        assert_eq!((parts.end, parts.between, parts.bulk), (1, 2..=11, 12..=90));
    }

    #[test]
    fn a_jump_and_a_climb_by_hand() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        let row = heights(0.1, 10, 5);
        // Of 150 chains 20 have all gaps, 40 the peak of the bulk, and 10 the number between.
        assert!(near(row.end, 20.0 / 150.0) && near(row.bulk, 40.0 / 150.0), "{row:?}");
        assert!(near(row.between, 10.0 / 150.0) && row.peak == 40.0, "{row:?}");
        // ln(all/bulk) goes from about −ln 2 to ln 2: 20.5 over 40.5, and 80.5 over 40.5.
        let jump = crossing(&[heights(0.1, 10, 5), heights(0.105, 40, 5)], true).unwrap();
        let [below, above] = [40.5_f64 / 20.5, 80.5 / 40.5].map(f64::ln);
        assert!(near(jump.sigma, 0.1 + 0.005 * below / (below + above)), "{jump:?}");
        assert!(near(jump.peak, 40.0) && jump.clearance > 0.7, "{jump:?}");
        let climb = crossing(&[heights(0.1, 10, 50), heights(0.105, 40, 50)], true).unwrap();
        assert!(climb.clearance < 0.0, "{climb:?}");
        assert_eq!(crossing(&[heights(0.1, 10, 5)], true), None);
        assert_eq!(crossing(&[heights(0.1, 10, 5), heights(0.105, 15, 5)], true), None);
    }

    /// It jumps, or climbs, if the interval of the clearance has one sign; a climb has no place.
    #[test]
    fn an_interval_with_one_sign_decides() {
        let rows = |clearance: [f64; 2]| {
            let row = |i: u32| {
                let clearance = clearance[0] + f64::from(i) * (clearance[1] - clearance[0]) / 39.0;
                Some(Crossing { sigma: 0.1, peak: 50.0, clearance })
            };
            let passing = Passing::new(row(20), &(0..40).map(row).collect::<Vec<_>>());
            (passing.is_jump(), passing.sigma.is_some())
        };
        assert_eq!(rows([0.1, 0.5]), (Some(true), true));
        assert_eq!(rows([-0.5, -0.1]), (Some(false), false));
        assert_eq!(rows([-0.5, 0.5]), (None, true));
        assert_eq!(Passing::new(None, &[]).is_jump(), None);
    }

    /// A line through three values leaves residuals along 1, −2, 1, each by its variance.
    #[test]
    fn a_crossing_of_three_rows() {
        let rows = [(0.1, 10), (0.105, 40), (0.11, 30)].map(|(sigma, all)| heights(sigma, all, 5));
        let fit = |y: [f64; 3], variance: [f64; 3]| {
            let bent = (y[0] - 2.0 * y[1] + y[2]) / (variance[0] + 4.0 * variance[1] + variance[2]);
            [y[0] - bent * variance[0], y[1] + 2.0 * bent * variance[1]]
        };
        let counts = rows.map(|row| [row.end, row.bulk].map(|share| share * row.chains + 0.5));
        let [a, b] = fit(counts.map(|[a, b]| (a / b).ln()), counts.map(|[a, b]| 1.0 / a + 1.0 / b));
        let sigma = crossing(&rows, true).unwrap().sigma;
        assert!((sigma - 0.1 - 0.005 * a / (a - b)).abs() < 1e-9, "{sigma}");
    }

    /// Equal numbers have the height that they have, not that of the luckiest of them.
    #[test]
    fn a_peak_of_noise_is_not_too_high() {
        let halves = [0, 1].map(|half| {
            (0..102).map(|k| if k % 2 == half { 30 } else { 10 }).collect::<Vec<u32>>()
        });
        let [_, height] = peak(&halves, &(2..=90), 0, 1.0);
        assert_eq!(height, 20.0);
    }
}
