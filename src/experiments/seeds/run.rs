//! Runs of chains in which exactly one gap closes by itself.

use super::{Moment, Seeds, Waits, course, fronts, growth};
use crate::circuits;
use crate::circuits::balance::variance_ratio;
use crate::circuits::impact_probability::ImpactProbability;
use crate::circuits::nucleation::reach::closes_by_itself;
use crate::dynamics::{self, Engine, Initial, Scenario};
use crate::experiments::cutting::{Cutting, Row, Unit};
use crate::experiments::estimates::average_count;
use crate::experiments::nucleation::differences;
use crate::experiments::progress::Stage;
use crate::experiments::{Error, Progress, weights};
use crate::numerics::random::NormalPairs;
use crate::numerics::statistics::Estimate;
use crate::params::{Chain, SeedsParams};
use serde::{Deserialize, Serialize};

/// One run, in time since its first impact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// Chains that were drawn until one had exactly one gap that closes by itself.
    pub(super) drawn: u64,
    /// That gap; none if it had not closed when the wait ended.
    pub(super) seed: Option<usize>,
    /// For each gap the bins in which it was hit, as bits.
    pub(super) hits: Vec<u64>,
    /// For each gap the tick of its first impact.
    pub(super) firsts: Vec<Option<u32>>,
    /// For each gap the whole parts of its width that its own motion from rest crosses.
    pub(super) crossed: Vec<u8>,
}

/// Some runs at one σ; none where the engine gave up.
pub type Part = Vec<Option<Trace>>;

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

/// The experiment in units of work.
pub const CUTTING: Cutting<SeedsParams, Part, Seeds> = Cutting { rows, part, fits, join };

fn weight(parameters: &SeedsParams, sigma: f64) -> u64 {
    weights::run(&parameters.chain, sigma, parameters.bin * parameters.bins as f64)
}

fn rows(parameters: &SeedsParams) -> Vec<Row> {
    let row = |&sigma: &f64| Row {
        covers: format!("sigma = {sigma}"),
        realisations: parameters.realisations,
        weight: weight(parameters, sigma),
    };
    parameters.sigmas.iter().map(row).collect()
}

fn part(
    parameters: &SeedsParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Part, Error> {
    let sigma = parameters.sigmas[unit.row];
    unit.each(stage, |index| trace(parameters, sigma, index, progress))
}

/// The amplitudes of a chain with exactly one gap that closes by itself, that gap, and how many chains
/// were drawn for it.
fn draw(
    parameters: &SeedsParams,
    sigma: f64,
    normals: &mut NormalPairs,
    progress: &Progress,
) -> Result<(Vec<[f64; 2]>, usize, u64), Error> {
    let chain = &parameters.chain;
    let mut forcing: Vec<[f64; 2]> = Vec::with_capacity(chain.masses);
    for drawn in 1.. {
        if drawn % 1024 == 0 {
            progress.check()?;
        }
        forcing.clear();
        let (mut seed, mut seeds, mut before) = (0, 0, [0.0; 2]);
        for gap in 0..=chain.masses {
            let after = match gap == chain.masses {
                true => [0.0; 2],
                false => normals.pair().map(|x| sigma * x),
            };
            if closes_by_itself(chain, [after[0] - before[0], after[1] - before[1]]) {
                (seed, seeds) = (gap, seeds + 1);
                if seeds > 1 {
                    break;
                }
            }
            forcing.push(after);
            before = after;
        }
        if seeds == 1 {
            forcing.truncate(chain.masses);
            return Ok((forcing, seed, drawn));
        }
    }
    unreachable!("a u64 of chains")
}

/// The whole parts of its width that a gap's own motion from rest crosses: as many as it would close by itself
/// were it only so wide.
fn crossed(chain: &Chain, delta: [f64; 2]) -> u8 {
    let closes = |parts: &u8| {
        let part = f64::from(*parts) / fronts::PARTS as f64;
        closes_by_itself(&Chain { spacing: part * chain.spacing, ..chain.clone() }, delta)
    };
    (1..fronts::PARTS as u8).take_while(closes).count() as u8
}

fn trace(
    parameters: &SeedsParams,
    sigma: f64,
    index: u64,
    progress: &Progress,
) -> Result<Option<Trace>, Error> {
    progress.check()?;
    let chain = &parameters.chain;
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let (forcing, seed, drawn) = draw(parameters, sigma, &mut normals, progress)?;
    let crossed = differences(&forcing).map(|delta| crossed(chain, delta)).collect();
    let still = Chain { masses: 0, ..chain.clone() };
    let scenario =
        Scenario { forcing, initial: Initial::Rest, ..Scenario::draw(&still, sigma, &mut normals) };
    let fault = |source| Error::Dynamics { experiment: "seeds", source };
    let mut engine = Engine::new(&scenario).map_err(fault)?;
    let mut first = None;
    let begun = engine.run(parameters.wait, |impact| {
        first = Some((impact.time, impact.gap));
        false
    });
    begun.map_err(fault)?;
    let Some((first, gap)) = first else {
        return Ok(Some(Trace { drawn, ..Trace::default() }));
    };
    debug_assert_eq!(gap, seed);
    let mut hits = vec![0_u64; chain.gaps()];
    hits[seed] = 1;
    let mut firsts = vec![None; chain.gaps()];
    firsts[seed] = Some(0);
    let until = first + parameters.bin * parameters.bins as f64;
    let ended = engine.run(until, |impact| {
        let bin = ((impact.time - first) / parameters.bin) as usize;
        hits[impact.gap] |= 1 << bin.min(parameters.bins - 1);
        let tick = ((impact.time - first) / parameters.tick) as u32;
        firsts[impact.gap].get_or_insert(tick.min(parameters.ticks() as u32));
        !progress.stopped()
    });
    progress.check()?;
    match ended {
        Ok(()) => Ok(Some(Trace { drawn, seed: Some(seed), hits, firsts, crossed })),
        Err(dynamics::Error::Work { .. }) => Ok(None),
        Err(source) => Err(fault(source)),
    }
}

fn fits(parameters: &SeedsParams, unit: &Unit, traces: &Part) -> bool {
    let gaps = parameters.chain.gaps();
    let fits = |trace: &Trace| match trace.seed {
        Some(seed) => {
            let beyond = |bins: &u64| bins.checked_shr(parameters.bins as u32).unwrap_or(0) == 0;
            let lengths = [trace.hits.len(), trace.firsts.len(), trace.crossed.len()];
            let parts = |own: &u8| usize::from(*own) < fronts::PARTS;
            seed < gaps
                && lengths == [gaps; 3]
                && trace.hits.iter().all(beyond)
                && trace.crossed.iter().all(parts)
                && outwards(parameters, seed, &trace.firsts)
        }
        None => *trace == Trace { drawn: trace.drawn, ..Trace::default() },
    };
    traces.len() == unit.realisations.len() && traces.iter().flatten().all(fits)
}

/// Whether impacts came to one gap after the other, from the seed to both sides, within the run.
fn outwards(parameters: &SeedsParams, seed: usize, firsts: &[Option<u32>]) -> bool {
    let last = parameters.ticks() as u32 + 1;
    let tick = |gap: usize| firsts[gap].unwrap_or(last);
    let after = |gap: usize| match firsts[gap] {
        Some(tick) => tick < last,
        None => true,
    };
    firsts[seed] == Some(0)
        && (0..firsts.len()).all(after)
        && (1..=seed).all(|gap| tick(gap) <= tick(gap - 1))
        && (seed + 1..firsts.len()).all(|gap| tick(gap - 1) <= tick(gap))
}

/// Groups of runs, each of which is left out in turn for the errors of what all say together.
const GROUPS: usize = 8;

fn join(
    parameters: &SeedsParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<Seeds, Error> {
    let (mut seen, mut rows) = (Vec::new(), Vec::new());
    let (mut waits, mut advances) = (Vec::new(), Vec::new());
    for (sigma, parts) in parameters.sigmas.iter().zip(parts) {
        progress.check()?;
        let traces = parts.concat();
        let at = |group: usize| group * traces.len() / GROUPS;
        let groups = (0..GROUPS).map(|group| count(parameters, &traces[at(group)..at(group + 1)]));
        let groups: Vec<ByDistance> = groups.collect();
        rows.push(spread(parameters, *sigma, &traces, &ByDistance::sum(&groups, GROUPS))?);
        seen.push(groups);
        let tallies = fronts::tallies(parameters, &traces);
        advances.push(fronts::fronts(parameters, *sigma, &tallies));
        waits.push(Waits::sum(parameters, &tallies));
    }
    let closing = growth::closing(parameters);
    let predictions = growth::predictions(parameters, &closing, &seen).map_err(refused)?;
    let seen = seen.iter().map(|groups| ByDistance::sum(groups, GROUPS)).collect();
    let parameters = parameters.clone();
    Ok(Seeds { parameters, closing, seen, rows, waits, fronts: advances, predictions })
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

fn count(parameters: &SeedsParams, traces: &[Option<Trace>]) -> ByDistance {
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

fn spread(
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

fn refused(error: circuits::Error) -> Error {
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
    use crate::experiments::nucleation::differences;
    use crate::params::Profile;

    fn small() -> SeedsParams {
        let mut parameters = SeedsParams::new(Profile::Quick);
        parameters.chain.masses = 20;
        parameters.sigmas = vec![0.1, 0.14];
        parameters.realisations = 60;
        (parameters.bin, parameters.bins, parameters.window) = (10.0, 12, 3);
        parameters.transients = vec![0, 4, 9];
        parameters
    }

    #[test]
    fn a_drawn_chain_has_one_gap_that_closes_by_itself() {
        let parameters = small();
        let quiet = Progress::silent();
        for index in 0..20 {
            let mut normals = NormalPairs::new("test of seeds", 1, index);
            let (forcing, seed, drawn) = draw(&parameters, 0.12, &mut normals, &quiet).unwrap();
            let closes: Vec<usize> = differences(&forcing)
                .enumerate()
                .filter(|(_, delta)| closes_by_itself(&parameters.chain, *delta))
                .map(|(gap, _)| gap)
                .collect();
            assert_eq!((closes, forcing.len()), (vec![seed], 20));
            assert!(drawn >= 1);
        }
    }

    #[test]
    fn counts_of_a_run_by_hand() {
        // Gap 1 of three is the seed. Gap 2 is hit in bins 1 and 3, gap 0 never.
        let mut parameters = small();
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

    #[test]
    fn a_gap_crosses_the_parts_that_its_own_motion_reaches() {
        let chain = Chain::default();
        // With Ω² = 2 it reaches (1 + √2) times a difference of sines.
        let reach = 1.0 + std::f64::consts::SQRT_2;
        for (share, parts) in [(0.1, 0), (0.26, 1), (0.49, 1), (0.51, 2), (0.76, 3), (0.99, 3)] {
            assert_eq!(crossed(&chain, [0.0, -share / reach]), parts, "{share}");
        }
    }

    #[test]
    fn parts_whose_impacts_jump_are_refused() {
        let mut parameters = small();
        parameters.chain.masses = 3;
        let unit = Unit { row: 0, realisations: 0..1, covers: String::new(), weight: 1 };
        let own = |firsts: [Option<u32>; 4]| {
            let (hits, crossed) = (vec![1; 4], vec![0; 4]);
            let firsts = firsts.to_vec();
            vec![Some(Trace { drawn: 1, seed: Some(1), hits, firsts, crossed })]
        };
        assert!(fits(&parameters, &unit, &own([None, Some(0), Some(7), Some(7)])));
        assert!(!fits(&parameters, &unit, &own([None, Some(0), None, Some(7)])));
        assert!(!fits(&parameters, &unit, &own([None, Some(0), Some(8), Some(7)])));
        assert!(!fits(&parameters, &unit, &own([None, Some(0), Some(7), Some(121)])));
        assert!(!fits(&parameters, &unit, &own([None, Some(1), Some(7), Some(7)])));
        let mut torn = own([None, Some(0), Some(7), Some(7)]);
        torn[0].as_mut().unwrap().crossed.pop();
        assert!(!fits(&parameters, &unit, &torn));
    }

    #[test]
    fn impacts_spread_from_the_seed_and_the_prediction_knows_its_limits() {
        let parameters = small();
        let found = CUTTING.run(&parameters, "test", &Progress::silent()).unwrap();
        for (row, seen) in found.rows.iter().zip(&found.seen) {
            assert_eq!(row.seeds + row.late + row.failed, 60);
            assert!(row.spreads.iter().all(|gaps| (1..=21).contains(gaps)), "{row:?}");
            assert!(row.advance.windows(2).all(|pair| pair[0] <= pair[1]), "{row:?}");
            assert_eq!(seen.reached[1][0], row.seeds);
        }
        // Each gap that was reached, but for the seed, is a step of a front, and each wait has an end.
        for (row, waits) in found.rows.iter().zip(&found.waits) {
            let [steps, cut] = [&waits.ended, &waits.cut].map(|own| own.iter().sum::<u64>());
            assert_eq!(steps, row.spreads.iter().sum::<u64>() - row.seeds);
            assert!(cut <= waits.fronts && waits.fronts <= 2 * row.seeds);
        }
        let [low, high] = &found.rows[..] else { panic!() };
        assert!(high.spread.unwrap().value > low.spread.unwrap().value);
        // Without a transient all that is reached counts: later windows see more of the spreading, and
        // no count exceeds the gaps.
        for prediction in &found.predictions {
            let means: Vec<f64> = prediction.means.iter().map(|own| own.value).collect();
            assert!(0.0 < means[0] && means[0] < means[1] && means[1] <= 21.0, "{means:?}");
        }
    }
}
