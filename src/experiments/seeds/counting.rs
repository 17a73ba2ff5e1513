//! Counts impacts by their distance from the seed.

use super::run::Trace;
use crate::params::SeedsParams;
use impact_numerics::statistics::slope;

/// Counts of impacts by distance from the seed, over runs at one σ.
#[derive(Clone)]
pub struct ByDistance {
    /// Gaps at each distance from a seed, to both sides.
    pub places: Vec<u64>,
    /// For the end of each bin, from none on, those that were hit by then, by distance.
    pub reached: Vec<Vec<u64>>,
    /// For each window that fits in, by its first bin, those that were hit in it, by distance.
    pub active: Vec<Vec<u64>>,
}

/// Returns the runs of which the seed closed, with it.
pub(super) fn ran(traces: &[Option<Trace>]) -> impl Iterator<Item = (usize, &Trace)> {
    traces.iter().flatten().filter_map(|trace| Some((trace.seed?, trace)))
}

pub(super) fn bits(from: usize, count: usize) -> u64 {
    (from..from + count).fold(0, |all, bin| all | 1 << bin)
}

impl ByDistance {
    pub(super) fn count(parameters: &SeedsParams, traces: &[Option<Trace>]) -> Self {
        let (gaps, bins, window) = (parameters.chain.gaps(), parameters.bins, parameters.window);
        let starts = bins.saturating_sub(window) + 1;
        let mut places = vec![0; gaps];
        let [mut reached, mut active] = [bins + 1, starts].map(|rows| vec![vec![0; gaps]; rows]);
        for (seed, trace) in ran(traces) {
            for (gap, &bits) in trace.hits.iter().enumerate() {
                let distance = gap.abs_diff(seed);
                places[distance] += 1;
                if bits == 0 {
                    continue;
                }
                reached[bits.trailing_zeros() as usize + 1][distance] += 1;
                let windows = (0..window).fold(0, |windows, bin| windows | bits >> bin);
                for (start, active) in active.iter_mut().enumerate() {
                    active[distance] += windows >> start & 1;
                }
            }
        }
        for bin in 1..=bins {
            let (before, now) = reached.split_at_mut(bin);
            add(&mut now[0], &before[bin - 1]);
        }
        ByDistance { places, reached, active }
    }

    /// Returns the sum over groups of runs, perhaps without one of them.
    pub(super) fn sum(groups: &[ByDistance], left_out: Option<usize>) -> Self {
        let used = groups.iter().enumerate().filter(|(group, _)| Some(*group) != left_out);
        let mut used = used.map(|(_, group)| group);
        let mut all = used.next().expect("there are several groups").clone();
        for group in used {
            add(&mut all.places, &group.places);
            let sums = all.reached.iter_mut().chain(&mut all.active);
            let more = group.reached.iter().chain(&group.active);
            sums.zip(more).for_each(|(sums, more)| add(sums, more));
        }
        all
    }

    /// Returns the share of the gaps at each distance; 0 where no gap has that distance.
    pub(super) fn shares(&self, hit: &[u64]) -> impl Iterator<Item = f64> {
        hit.iter().zip(&self.places).map(|(part, all)| *part as f64 / (*all).max(1) as f64)
    }

    /// Returns the expected number of gaps that a front to one side has passed by a bin's end.
    pub(super) fn advance(&self, bin: usize) -> f64 {
        self.shares(&self.reached[bin]).skip(1).sum()
    }

    /// Returns the exponent of a power law of time from a quarter on; none if no gap was passed.
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

fn add(sums: &mut [u64], more: &[u64]) {
    sums.iter_mut().zip(more).for_each(|(sum, count)| *sum += count);
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
