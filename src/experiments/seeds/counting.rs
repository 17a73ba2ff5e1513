//! Impacts by their distance from the seed.

use super::run::Trace;
use crate::params::SeedsParams;

/// Counts of impacts by distance from the seed, over runs at one σ.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ByDistance {
    /// Gaps at each distance from a seed, to both sides.
    pub places: Vec<u64>,
    /// For the end of each bin, from none on, those that were hit by then, by distance.
    pub reached: Vec<Vec<u64>>,
    /// For each window that fits in, by its first bin, those that were hit in it, by distance.
    pub active: Vec<Vec<u64>>,
}

/// Runs of which the seed closed, with it.
pub(super) fn ran(traces: &[Option<Trace>]) -> impl Iterator<Item = (usize, &Trace)> {
    traces.iter().flatten().filter_map(|trace| Some((trace.seed?, trace)))
}

/// The bits of `count` bins from one on.
pub(super) fn bits(from: usize, count: usize) -> u64 {
    (0..count).map(|bin| 1 << (from + bin)).fold(0, |all, bit: u64| all | bit)
}

impl ByDistance {
    pub(super) fn count(parameters: &SeedsParams, traces: &[Option<Trace>]) -> Self {
        let (gaps, bins, window) = (parameters.chain.gaps(), parameters.bins, parameters.window);
        let starts = 0..=bins.saturating_sub(window);
        let reached = (0..=bins).map(|bin| bits(0, bin));
        let masks: Vec<u64> = reached.chain(starts.map(|from| bits(from, window))).collect();
        let mut places = vec![0; gaps];
        let mut hit = vec![vec![0; gaps]; masks.len()];
        for (seed, trace) in ran(traces) {
            for (gap, bits) in trace.hits.iter().enumerate() {
                let distance = gap.abs_diff(seed);
                places[distance] += 1;
                if *bits != 0 {
                    let both = hit.iter_mut().zip(&masks);
                    both.for_each(|(hit, mask)| hit[distance] += u64::from(bits & mask != 0));
                }
            }
        }
        let active = hit.split_off(bins + 1);
        ByDistance { places, active, reached: hit }
    }

    /// The sum over groups of runs, without the group of index `left_out` if there is one.
    pub(super) fn sum(groups: &[ByDistance], left_out: usize) -> Self {
        let of = groups.iter().enumerate().filter(|(group, _)| *group != left_out);
        let mut seen = of.map(|(_, group)| group.clone());
        let first = seen.next().unwrap_or_default();
        seen.fold(first, |mut all, group| {
            let add = |all: &mut Vec<u64>, more: &Vec<u64>| {
                all.iter_mut().zip(more).for_each(|(all, more)| *all += more);
            };
            add(&mut all.places, &group.places);
            all.reached.iter_mut().zip(&group.reached).for_each(|(all, more)| add(all, more));
            all.active.iter_mut().zip(&group.active).for_each(|(all, more)| add(all, more));
            all
        })
    }

    /// The share of the gaps at each distance; 0 where no gap has that distance.
    pub(super) fn shares<'a>(&'a self, hit: &'a [u64]) -> impl Iterator<Item = f64> + 'a {
        let share = |(part, all): (&u64, &u64)| {
            if *all > 0 { *part as f64 / *all as f64 } else { 0.0 }
        };
        hit.iter().zip(&self.places).map(share)
    }

    /// The expected number of gaps that a front has passed by the end of a bin, to one side of a long chain.
    pub(super) fn advance(&self, bin: usize) -> f64 {
        self.shares(&self.reached[bin]).skip(1).sum()
    }

    /// d ln(advance)/d ln t from the time that is a quarter of the last one on: 1 for a constant speed.
    pub(super) fn exponent(&self) -> f64 {
        let last = self.reached.len() - 1;
        let ratio = self.advance(last) / self.advance(last / 4);
        pxfm::f_log(ratio) / pxfm::f_log(last as f64 / (last / 4) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponent_by_hand() {
        // After four times the time twice as many.
        let far = |near: u64, far: u64| vec![1, near, far];
        let reached = vec![vec![0; 3], far(1, 0), far(1, 0), far(1, 0), far(1, 1)];
        let seen = ByDistance { places: vec![1, 2, 2], reached, active: Vec::new() };
        assert!((seen.exponent() - 0.5).abs() < 1e-15);
    }
}
