//! Impacts by their distance from the seed, and what they say about spreading.

use super::run::Trace;
use super::{Moment, course, growth};
use crate::circuits;
use crate::circuits::balance::variance_ratio;
use crate::circuits::impact_probability::ImpactProbability;
use crate::experiments::Error;
use crate::experiments::estimates::average_count;
use crate::numerics::statistics::Estimate;
use crate::params::{Chain, SeedsParams};
use serde::{Deserialize, Serialize};

/// Counts of impacts by distance from the seed, over all runs at one σ.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ByDistance {
    /// Gaps at each distance from a seed, to both sides.
    pub places: Vec<u64>,
    /// For the end of each bin, from none on, those that were hit by then, by distance.
    pub reached: Vec<Vec<u64>>,
    /// For each window that fits in, by its first bin, those that were hit in it, by distance.
    pub active: Vec<Vec<u64>>,
    /// For each of these windows, the runs with an impact in it.
    pub alive: Vec<u64>,
}

/// What runs at one σ say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Standard deviation σ.
    pub sigma: f64,
    /// Chains that were drawn.
    pub drawn: u64,
    /// Runs.
    pub seeds: u64,
    /// Chains whose gap did not close in time.
    pub late: u64,
    /// Runs that the engine ended early.
    pub failed: u64,
    /// The mean count by the graph theory: with Eq. (25), with p for a start from rest, and with that of a
    /// chain as hot as the balance of rare impacts makes it.
    pub graph: [f64; 3],
    /// Gaps that were hit by the last bin, of each run.
    pub spreads: Vec<u64>,
    /// Their mean.
    pub spread: Option<Estimate>,
    /// Share of the runs with an impact in the last window.
    pub survival: f64,
    /// For the end of each bin the expected number of gaps that a front has passed, to one side of a long chain:
    /// the sum over distances of the share that was reached.
    pub advance: Vec<f64>,
    /// d ln(advance)/d ln t from the time that is a quarter of the last one on: 1 for a constant speed.
    pub exponent: f64,
    /// The root mean square distance of the gaps that were reached from the seed, at the end.
    pub radius: f64,
    /// How it came to that.
    pub course: Vec<Moment>,
}

impl ByDistance {
    /// What groups of runs saw together, one of them left out if there is one of that number.
    pub fn sum(groups: &[ByDistance], left_out: usize) -> ByDistance {
        let of = groups.iter().enumerate().filter(|(group, _)| *group != left_out);
        let mut seen = of.map(|(_, own)| own.clone());
        let first = seen.next().unwrap_or_default();
        seen.fold(first, |mut all, own| {
            let add = |all: &mut Vec<u64>, own: &Vec<u64>| {
                all.iter_mut().zip(own).for_each(|(all, own)| *all += own);
            };
            add(&mut all.places, &own.places);
            add(&mut all.alive, &own.alive);
            all.reached.iter_mut().zip(&own.reached).for_each(|(all, own)| add(all, own));
            all.active.iter_mut().zip(&own.active).for_each(|(all, own)| add(all, own));
            all
        })
    }
}

/// Runs of which the seed closed, with it.
pub(super) fn ran(traces: &[Option<Trace>]) -> impl Iterator<Item = (usize, &Trace)> {
    traces.iter().flatten().filter_map(|trace| Some((trace.seed?, trace)))
}

/// The bits of `count` bins from one on.
pub(super) fn bits(from: usize, count: usize) -> u64 {
    (0..count).map(|bin| 1 << (from + bin)).fold(0, |all, bit: u64| all | bit)
}

/// Counts the impacts of some runs.
pub(super) fn count(parameters: &SeedsParams, traces: &[Option<Trace>]) -> ByDistance {
    let (gaps, bins, window) = (parameters.chain.gaps(), parameters.bins, parameters.window);
    let in_bins = |mask: u64| {
        let mut by_distance = vec![0; gaps];
        for (seed, trace) in ran(traces) {
            for (gap, own) in trace.hits.iter().enumerate() {
                by_distance[gap.abs_diff(seed)] += u64::from(own & mask != 0);
            }
        }
        by_distance
    };
    let starts = 0..=bins.saturating_sub(window);
    let alive = |from: usize| {
        let within = |hits: &[u64]| hits.iter().any(|own| own & bits(from, window) != 0);
        ran(traces).filter(|(_, trace)| within(&trace.hits)).count() as u64
    };
    let mut places = vec![0; gaps];
    for (seed, trace) in ran(traces) {
        (0..trace.hits.len()).for_each(|gap| places[gap.abs_diff(seed)] += 1);
    }
    ByDistance {
        places,
        reached: (0..=bins).map(|bin| in_bins(bits(0, bin))).collect(),
        active: starts.clone().map(|from| in_bins(bits(from, window))).collect(),
        alive: starts.map(alive).collect(),
    }
}

/// What runs say, and their counts.
pub(super) fn spread(
    parameters: &SeedsParams,
    sigma: f64,
    traces: &[Option<Trace>],
    seen: &ByDistance,
) -> Result<Spread, Error> {
    let seeds = ran(traces).count() as u64;
    let reached = |hits: &[u64]| hits.iter().filter(|own| **own != 0).count() as u64;
    let spreads: Vec<u64> = ran(traces).map(|(_, trace)| reached(&trace.hits)).collect();
    let advance: Vec<f64> =
        seen.reached.iter().map(|own| growth::shares(own, &seen.places).skip(1).sum()).collect();
    let last = parameters.bins;
    let slope = pxfm::f_log(advance[last] / advance[last / 4])
        / pxfm::f_log(last as f64 / (last / 4) as f64);
    Ok(Spread {
        sigma,
        graph: graph(&parameters.chain, sigma).map_err(refused)?,
        drawn: traces.iter().flatten().map(|trace| trace.drawn).sum(),
        seeds,
        late: traces.iter().flatten().filter(|trace| trace.seed.is_none()).count() as u64,
        failed: traces.iter().filter(|trace| trace.is_none()).count() as u64,
        spread: average_count(&spreads),
        spreads,
        survival: seen.alive.last().copied().unwrap_or(0) as f64 / seeds.max(1) as f64,
        exponent: if slope.is_finite() { slope } else { 0.0 },
        radius: course::radius(seen, last),
        course: course::course(parameters, traces, seen),
        advance,
    })
}

/// An error of the theory, as one of the parameters.
pub(super) fn refused(error: circuits::Error) -> Error {
    Error::input("sigmas", error.to_string(), "see src/params/nucleation.rs")
}

/// The mean count by the graph theory, with each relation of p and σ.
fn graph(chain: &Chain, sigma: f64) -> Result<[f64; 3], circuits::Error> {
    let (d, omega, big_omega) = (chain.spacing, chain.natural_frequency, chain.forcing_frequency);
    let law = ImpactProbability::new(sigma, d, omega, big_omega)?;
    let balanced = law.heated(variance_ratio(chain)?)?;
    let mean = |p| growth::circuits(chain, p);
    Ok([mean(law.p()?)?, mean(law.p_from_rest()?)?, mean(balanced.p()?)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Profile;

    #[test]
    fn counts_of_a_run_by_hand() {
        // Gap 1 of three is the seed. Gap 2 is hit in bins 1 and 3, gap 0 never.
        let mut parameters = SeedsParams::new(Profile::Quick);
        parameters.chain.masses = 2;
        (parameters.bins, parameters.window) = (4, 2);
        let trace =
            Trace { drawn: 5, seed: Some(1), hits: vec![0, 0b0001, 0b1010], ..Trace::default() };
        let late = Trace { drawn: 1, ..Trace::default() };
        let seen = count(&parameters, &[Some(trace), None, Some(late)]);
        assert_eq!(seen.places, [1, 2, 0]);
        assert_eq!(seen.reached.concat(), [0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 1, 1, 0]);
        assert_eq!(seen.active, [[1, 1, 0], [0, 1, 0], [0, 1, 0]]);
        assert_eq!(seen.alive, [1, 1, 1]);
        let twice = ByDistance::sum(&[seen.clone(), seen.clone(), seen.clone()], 1);
        assert_eq!((twice.places, twice.alive), (vec![2, 4, 0], vec![2, 2, 2]));
    }
}
