//! Counts impacts by their distance from the seed.

use crate::experiments::prelude::*;

/// One run, in time since its first impact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// The gap that closes by itself, or `None` if it had not closed when the wait ended.
    pub(super) seed: Option<usize>,
    /// For each gap the bins in which it was hit, as bits.
    pub(super) hits: Vec<u64>,
    /// For each gap the time of its first impact, in whole units.
    pub(super) firsts: Vec<Option<u32>>,
}

/// Runs at one σ; `None` where the engine gave up.
pub type Part = Vec<Option<Trace>>;

/// Counts of impacts by distance from the seed, over runs at one σ.
#[derive(Clone)]
pub struct ByDistance {
    /// Gaps at each distance from a seed, to both sides.
    pub places: Vec<u64>,
    /// Gaps hit before each bin, and last before the end of the run, by distance.
    pub reached: Vec<Vec<u64>>,
    /// Gaps hit in each window that fits into the run, by its first bin, by distance.
    pub active: Vec<Vec<u64>>,
}

/// Lists the runs whose seed closed, each with the gap of its seed.
pub(super) fn seeded(traces: &[Option<Trace>]) -> impl Iterator<Item = (usize, &Trace)> {
    traces.iter().flatten().filter_map(|trace| Some((trace.seed?, trace)))
}

/// Returns a mask of `count` bins from `from` on.
pub(super) fn bits(from: usize, count: usize) -> u64 {
    (from..from + count).fold(0, |mask, bin| mask | 1 << bin)
}

impl ByDistance {
    pub(super) fn count(parameters: &SeedsParams, traces: &[Option<Trace>]) -> Self {
        let (gaps, bins, window) = (parameters.chain.gaps(), parameters.bins, parameters.window);
        let mut places = vec![0; gaps];
        let [mut reached, mut active] = [bins + 1, bins].map(|rows| vec![0; rows * gaps]);
        let (reached, active) = (&mut reached[..], &mut active[..]);
        for (seed, trace) in seeded(traces) {
            for (gap, &bits) in trace.hits.iter().enumerate() {
                let distance = gap.abs_diff(seed);
                places[distance] += 1;
                if bits == 0 {
                    continue;
                }
                reached[(bits.trailing_zeros() as usize + 1) * gaps + distance] += 1;
                let mut windows = (0..window).fold(0, |windows, bin| windows | bits >> bin);
                while windows != 0 {
                    active[windows.trailing_zeros() as usize * gaps + distance] += 1;
                    windows &= windows - 1;
                }
            }
        }
        for place in gaps..reached.len() {
            reached[place] += reached[place - gaps];
        }
        let [reached, mut active] = [reached, active]
            .map(|rows| rows.chunks(gaps).map(<[u64]>::to_vec).collect::<Vec<_>>());
        active.truncate(bins.saturating_sub(window) + 1);
        ByDistance { places, reached, active }
    }

    /// Returns the sums over all groups of runs but one, for each group in turn, and last over all.
    pub(super) fn sums(groups: &[ByDistance]) -> Vec<Self> {
        let first = groups.first().expect("there are several groups").clone();
        let total = groups[1..].iter().fold(first, |sum, group| sum.with(group, |a, b| a + b));
        let mut sums: Vec<Self> =
            groups.iter().map(|group| total.clone().with(group, |sum, part| sum - part)).collect();
        sums.push(total);
        sums
    }

    fn with(mut self, other: &ByDistance, new: fn(u64, u64) -> u64) -> Self {
        let rows = self.reached.iter_mut().chain(&mut self.active).chain([&mut self.places]);
        let others = other.reached.iter().chain(&other.active).chain([&other.places]);
        for (row, more) in rows.zip(others) {
            row.iter_mut().zip(more).for_each(|(count, more)| *count = new(*count, *more));
        }
        self
    }

    /// Returns the share of the gaps at each distance; 0 where no gap has that distance.
    pub(super) fn shares(&self, hit: &[u64]) -> impl Iterator<Item = f64> {
        hit.iter().zip(&self.places).map(|(part, places)| *part as f64 / (*places).max(1) as f64)
    }

    /// Returns the expected number of gaps that a front to one side has passed by a bin's end.
    pub(super) fn advance(&self, bin: usize) -> f64 {
        self.shares(&self.reached[bin]).skip(1).sum()
    }

    /// Returns the exponent of a power law fitted to the advance in the last three quarters of the
    /// time, or `None` if a bin has no advance.
    pub(super) fn exponent(&self) -> Option<f64> {
        let last = self.reached.len() - 1;
        let point = |bin: usize| {
            let advance = self.advance(bin);
            (advance > 0.0).then(|| (pxfm::f_log(bin as f64), pxfm::f_log(advance)))
        };
        let points: Option<Vec<(f64, f64)>> = ((last / 4).max(1)..=last).map(point).collect();
        slope(&points?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponent_by_hand() {
        // The numbers of gaps at the times 1, 2, 3 and 4 are 1, 2, 3 and 4.
        let far = |far: u64| vec![1, far];
        let reached = vec![vec![0; 2], far(1), far(2), far(3), far(4)];
        let seen = ByDistance { places: vec![1, 4], reached, active: Vec::new() };
        assert!((seen.exponent().unwrap() - 1.0).abs() < 1e-15);
        let silent = ByDistance { reached: vec![vec![0; 2]; 5], ..seen };
        assert_eq!(silent.exponent(), None);
    }
}
