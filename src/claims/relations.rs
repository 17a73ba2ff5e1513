//! Relations between numbers of this edition that must hold whatever was drawn: each between two independent routes,
//! as two samples of one thing, or a simulation and its bound; and the promises about the engine.

use super::judge::{Error, Evidence};
use super::{Basis, Check, Kind, Published, Text, integer, level, significant};
use crate::experiments::accuracy::trials::right;
use crate::experiments::rise::{Curve, RisePoint};
use crate::experiments::{
    LENGTHS, NUCLEATION, PROTOCOL, RACE, Results, SCALE, SECOND_SEED, TRIALS, lengths,
};
use crate::params::MethodName;
use impact_numerics::estimates::difference;
use impact_numerics::statistics::Estimate;
use literate::Failure;

/// Departures from a relation, each over its tolerance (chance, and the error of a formula): at most one.
type Departures = Result<Vec<f64>, Error>;

/// Its id, its statement, and its departures.
type Relation = (&'static str, &'static str, fn(&Evidence) -> Departures);

/// Functions with their statements; the name of a function is the id.
macro_rules! relations {
    ($($name:ident: $what:literal;)*) => { [$((stringify!($name), $what, $name)),*] };
}

const RELATIONS: [Relation; 10] = relations! {
    printed_threshold: "with our protocol the mean of the realisations with an impact passes half of all gaps at the printed σ";
    two_seeds: "two seeds of the main sweep have one half height, and one mean at each σ";
    laws_of_chance: "impacts near in time go with the time between, and slow ones with the square of their speed";
    map_meets_sweep: "the map of protocols and the main sweep, which drew other forces, have one rise";
    no_rise_before_seeds: "from rest no share of the chains has impacts before as many have a gap that closes by itself";
    above_stays_above: "chains from above have at least as many gaps with an impact as chains from rest under the same forces";
    branches_approach: "with time the half heights from rest and from above do not part";
    seeds_before_circuits: "mean counts by nucleation and growth are nearer to the simulation than those by circuits after every transient";
    first_impacts_as_expected: "as many chains have an impact as the theory of clumps expects";
    engine_as_promised: "the engine misses no impact from exact states, is exact to rounding, does not work more in long chains, and meets each scene of failure as expected";
};

/// All relations, as checks.
///
/// # Errors
/// If a result was not run.
pub fn relations(results: &Results, published: &Published) -> Result<Vec<Check>, Failure> {
    let e = Evidence { results, published, level: level() };
    let one = |(id, statement, find): Relation| {
        let found = match find(&e) {
            Err(Error::Undecided) => Vec::new(),
            found => found?,
        };
        let largest = found.iter().copied().fold(0.0, f64::max);
        let text = "the largest of {} departures is {} of what is allowed";
        let text = Text::of(text, [integer(found.len()), significant(largest, 2)]);
        let check = Check::new(Kind::Relation, id, statement, text).on(Basis::Statistics);
        let holds = found.iter().all(|departure| *departure <= 1.0);
        Ok(if found.is_empty() { check } else { check.judged(holds) })
    };
    RELATIONS.into_iter().map(one).collect()
}

/// The difference of two estimates over that which chance allows.
fn apart(e: &Evidence, a: &Estimate, b: &Estimate) -> f64 {
    (a.value - b.value).abs() / (e.level.quantile * difference(*a, *b).error)
}

/// The unprinted protocol decides whether the printed threshold is found; with ours it is.
fn printed_threshold(e: &Evidence) -> Departures {
    let s = e.published.statement("sec2_half_height")?;
    let Some(half) = e.sweep()?.first().rise.half_height else { return Err(Error::Undecided) };
    let room = s.half_unit() + e.level.quantile * half.error;
    Ok(vec![(half.value - s.number()?).abs() / room])
}

/// Fewest realisations of a mean whose error is taken as normal.
const FEWEST: usize = 30;

fn two_seeds(e: &Evidence) -> Departures {
    let (first, second) = (e.sweep()?.first(), e.results.of(&SECOND_SEED)?[0].first());
    let halves = first.rise.half_height.zip(second.rise.half_height);
    let halves = halves.map(|(a, b)| apart(e, &a, &b));
    let estimate = |row: &RisePoint| row.mean.filter(|_| row.kept >= FEWEST)?.estimate();
    let between = |b: &RisePoint| {
        let a = first.rows.iter().find(|a| a.sigma == b.sigma)?;
        Some(difference(estimate(a)?, estimate(b)?)).filter(|apart| apart.error > 0.0)
    };
    let means: Vec<Estimate> = second.rows.iter().filter_map(between).collect();
    let quantile = e.level.among(means.len());
    let means = means.iter().map(|apart| apart.value.abs() / (quantile * apart.error));
    Ok(halves.into_iter().chain(means).collect())
}

/// Laws of independent impacts: of those within a time of one in an adjacent gap a tenth are within a tenth of it, and
/// of those below a speed a hundredth are below a tenth of it. Over all decades; for speeds only where no pair came in
/// contact, since the last bounces of a chatter are slow.
fn laws_of_chance(e: &Evidence) -> Departures {
    let row = e.sweep()?.runs.iter().find(|row| row.sigma == 0.2);
    let total = &row.ok_or(Error::Undecided)?.total;
    let slow = (total.contact_phases == 0).then_some((&total.slow[..], 0.01));
    let off = |(nested, share): (&[u64], f64)| {
        let sum = |decades: &[u64]| decades.iter().sum::<u64>() as f64;
        let (all, nearer) = (sum(&nested[..nested.len() - 1]), sum(&nested[1..]));
        let error = (share * (1.0 - share) / all).sqrt();
        // Where hardly any is expected the error is not that of a normal variable.
        let expected = (share * all >= 10.0).then_some(share)?;
        Some((nearer / all - expected).abs() / (e.level.quantile * error))
    };
    Ok(std::iter::once((&total.near[1..], 0.1)).chain(slow).filter_map(off).collect())
}

/// Half heights of the mean of the realisations with an impact and of all, onset, and where half of the realisations have
/// one.
fn map_meets_sweep(e: &Evidence) -> Departures {
    let sweep = e.sweep()?.first();
    let map = &e.results.of(&PROTOCOL)?[0];
    let Some(cell) = map.curve(sweep.protocol.transient, sweep.protocol.window) else {
        return Err(Error::Undecided);
    };
    let places = |cell: &Curve| {
        let rise = &cell.rise;
        [rise.half_height, rise.half_height_all, rise.onset, rise.kept_half]
    };
    let pairs = places(cell).into_iter().zip(places(sweep));
    Ok(pairs.filter_map(|(a, b)| Some(apart(e, &a?, &b?))).collect())
}

/// For every transient and every r, the mean over all reaches N/2 at no lower σ than half of the chains have a gap that
/// closes by itself, and N/20 at no lower σ than a twentieth of them.
fn no_rise_before_seeds(e: &Evidence) -> Departures {
    let [half, onset] = e.numbers("theory.relation", ["sigma_kept_half", "sigma_kept_onset"])?;
    let (map, found) = (&e.results.of(&PROTOCOL)?[0], e.results.of(&LENGTHS)?);
    let masses = map.ensemble.chain.masses;
    let long = lengths::from_rest(found).filter(|(all, _)| all.ensemble.chain.masses == masses);
    let bounds = map.curves.iter().chain(long.map(|(_, curve)| curve)).flat_map(|cell| {
        let rise = &cell.rise;
        [(rise.half_height_all, half), (rise.kept_half, half), (rise.onset, onset)]
    });
    let other = e.results.table("restitution.curves")?.estimates(&[], "r", "half_height");
    let all = bounds.chain(other.into_iter().map(|(_, at)| (Some(at), half)));
    let early = all.filter_map(|(at, bound)| at.map(|at| (bound - at.value, at.error)));
    Ok(early.map(|(early, error)| over(early, e.level.quantile * error)).collect())
}

/// An excess over the allowed one; 0 if there is none.
fn over(excess: f64, allowed: f64) -> f64 {
    if excess <= 0.0 { 0.0 } else { excess / allowed }
}

fn above_stays_above(e: &Evidence) -> Departures {
    let excesses = e.results.table("branches.shares")?.estimates(&[], "sigma", "excess");
    Ok(excesses.iter().map(|(_, excess)| over(-excess.value, 5.0 * excess.error)).collect())
}

fn branches_approach(e: &Evidence) -> Departures {
    let table = e.results.table("branches.half_heights")?;
    let changes = table.estimates(&[], "transient", "change_of_distance");
    let part = |(_, change): &(f64, Estimate)| over(change.value, e.level.quantile * change.error);
    Ok(changes.iter().map(part).collect())
}

fn seeds_before_circuits(e: &Evidence) -> Departures {
    let scores = e.results.table("seeds.scores")?;
    let of = |column| scores.points(&[], "transient", column).into_iter().map(|point| point.1);
    let circuits = of("eq25").zip(of("from_rest")).map(|(a, b)| a.min(b));
    Ok(of("grown").zip(circuits).map(|(grown, circuits)| grown / circuits).collect())
}

/// The error of the formula, times n: a clump excludes others from the gaps next to it, which changes the share
/// by some gaps of n times λ²e^{−λ}/2.
const LEFT_OUT: f64 = 1.5;

/// Up to the error of the formula and chance: five standard errors, and five chains where hardly any is expected.
fn first_impacts_as_expected(e: &Evidence) -> Departures {
    let chains = e.results.table("nucleation.chains")?;
    let lengths = &e.results.of(&NUCLEATION)?.parameters.lengths;
    let of_length = |(masses, n): &(usize, usize)| {
        let (masses, n) = (*masses as f64, *n as f64);
        let points = chains.points(&[("masses", masses)], "clumps", "found");
        let off = points.into_iter().map(move |(p, found)| {
            let room = LEFT_OUT / masses + 5.0 * (p * (1.0 - p) / n).sqrt() + 5.0 / n;
            (found - p).abs() / room
        });
        off.collect::<Vec<f64>>()
    };
    Ok(lengths.iter().flat_map(of_length).collect())
}

/// Largest error of a waiting time that is allowed, in units of ε (d + R₁ + R₂) over the closing speed (ours).
const WAITING: f64 = 8.0;

/// What was promised before it was measured: no miss, waiting times to some units of rounding, evaluations per impact in
/// the largest chain at most twice those at a hundred masses, and no scene of failure with another outcome than expected.
fn engine_as_promised(e: &Evidence) -> Departures {
    let (scale, race) = (e.results.of(&SCALE)?, e.results.of(&RACE)?);
    let rows = || scale.iter().filter(|row| row.0.method == MethodName::Certified);
    let largest = rows().max_by_key(|row| row.1).zip(rows().find(|row| row.1 == 100));
    let entry = race.entries.iter().find(|entry| entry.setting.method == MethodName::Certified);
    // The engine is the first of the methods.
    let first = e.results.of(&TRIALS)?.scenes.iter().map(|(_, trials)| &trials[0]);
    let wrong: usize = first.map(|trial| trial.len() - right(trial)).sum();
    let counted = [Some(wrong), entry.map(|entry| entry.misses as usize)];
    let counted = counted.into_iter().flatten().map(|count| 2.0 * count as f64);
    let work = largest.map(|(a, b)| a.2 / b.2 / 2.0);
    let waiting = entry.and_then(|entry| entry.units).map(|units| units / WAITING);
    Ok(counted.chain(work).chain(waiting).collect())
}
