//! Judges relations between numbers of this edition that must hold whatever was drawn: each between
//! two independent routes, as two samples of one thing, or a simulation and its bound; and the
//! promises about the engine.

use super::shared::*;
use crate::experiments::accuracy::case::Outcome::{Refused, Right};
use crate::experiments::{NUCLEATION, RACE, SCALE, SECOND_SEED, TRIALS, lengths};
use literate::claims::Basis::Statistics;

/// Makes the rules of functions; the name of a function is the id.
macro_rules! relations {
    ($($name:ident),* $(,)?) => { vec![$(relation(stringify!($name), $name)),*] };
}

pub fn rules() -> Vec<Rule> {
    relations![
        printed_threshold,
        two_seeds,
        laws_of_chance,
        map_meets_sweep,
        no_rise_before_seeds,
        above_stays_above,
        branches_approach,
        seeds_before_circuits,
        first_impacts_as_expected,
        engine_as_promised,
    ]
}

/// Departures from a relation, each over its tolerance (chance, and the error of a formula).
type Departures = Result<Vec<f64>, Error>;

/// Makes the rule of a relation that holds if no departure is above one; without any it is open.
fn relation(id: &'static str, departures: fn(&Evidence<'_>) -> Departures) -> Rule {
    let judge = move |e: &Evidence<'_>| {
        let departures = match departures(e) {
            Err(Undecided) => Vec::new(),
            departures => departures?,
        };
        let largest = departures.iter().copied().fold(0.0, f64::max);
        let agrees = departures.iter().all(|departure| *departure <= 1.0);
        let decided = (!departures.is_empty()).then_some(agrees);
        e.check(decided, numbers![departures = departures.len(), largest])
    };
    Rule::new(id, judge).relation("").on(Statistics)
}

/// Returns the difference of two estimates over that which chance allows.
fn departure(quantile: f64, a: &Estimate, b: &Estimate) -> f64 {
    (a.value - b.value).abs() / (quantile * difference(*a, *b).error)
}

/// The unprinted protocol decides whether the printed threshold is found; with ours it is.
fn printed_threshold(e: &Evidence<'_>) -> Departures {
    let printed = e.published.statement("sec2_half_height")?;
    let half = e.estimate("sweep.rise.half_height")?;
    let room = printed.half_unit() + e.level()?.quantile * half.error;
    Ok(vec![(half.value - printed.number()?).abs() / room])
}

/// Fewest realisations of a mean whose error is taken as normal.
const FEWEST: usize = 30;

fn two_seeds(e: &Evidence<'_>) -> Departures {
    let mut departures = Vec::new();
    let halves = ["sweep.rise.half_height", "second_seed.rise.half_height"];
    if let [Ok(first), Ok(second)] = halves.map(|address| e.estimate(address)) {
        departures.push(departure(e.level()?.quantile, &first, &second));
    }
    let first = sweep::main_sweep(e.results)?.first_curve();
    let second = ensemble(e.results.of(&SECOND_SEED)?, "sweep")?.first_curve();
    let estimate = |row: &RisePoint| row.mean.filter(|_| row.active >= FEWEST)?.estimate();
    let between = |row: &RisePoint| {
        let same = first.rows.iter().find(|other| other.sigma == row.sigma)?;
        Some(difference(estimate(same)?, estimate(row)?)).filter(|between| between.error > 0.0)
    };
    let differences: Vec<Estimate> = second.rows.iter().filter_map(between).collect();
    let quantile = e.level()?.quantile_among(differences.len());
    let share = |difference: &Estimate| difference.value.abs() / (quantile * difference.error);
    departures.extend(differences.iter().map(share));
    Ok(departures)
}

/// Laws of independent impacts: of those within a time of one in an adjacent gap a tenth are within
/// a tenth of it, and of those below a speed a hundredth are below a tenth of it. Over all decades;
/// for speeds only where no pair came in contact, since the last bounces of a chatter are slow.
fn laws_of_chance(e: &Evidence<'_>) -> Departures {
    let row = sweep::main_sweep(e.results)?.runs.iter().find(|row| row.sigma == 0.2);
    let total = &row.ok_or(Undecided)?.total;
    // Impacts within each of some limits, where the next limit leaves this share of them.
    let mut laws = vec![(&total.near[1..], 0.1)];
    if total.contact_phases == 0 {
        laws.push((&total.slow[..], 0.01));
    }
    let mut departures = Vec::new();
    for (nested, share) in laws {
        let sum = |decades: &[u64]| decades.iter().sum::<u64>() as f64;
        let (outer, inner) = (sum(&nested[..nested.len() - 1]), sum(&nested[1..]));
        let error = (share * (1.0 - share) / outer).sqrt();
        // Where hardly any is expected the error is not that of a normal variable.
        if share * outer >= 10.0 {
            departures.push((inner / outer - share).abs() / (e.level()?.quantile * error));
        }
    }
    Ok(departures)
}

/// Half heights of the mean of active realisations and of all, onset, and where half are active.
fn map_meets_sweep(e: &Evidence<'_>) -> Departures {
    let sweep = sweep::main_sweep(e.results)?.first_curve();
    let map = ensemble(e.results.of(&PROTOCOL)?, "protocol")?;
    let window = map.find_curve(sweep.protocol).ok_or(Undecided)?;
    let places = |curve: &Curve| {
        let rise = &curve.rise;
        [rise.half_height, rise.half_height_all, rise.onset, rise.kept_half]
    };
    let quantile = e.level()?.quantile;
    let pairs = places(window).into_iter().zip(places(sweep));
    Ok(pairs.filter_map(|(a, b)| Some(departure(quantile, &a?, &b?))).collect())
}

/// For every transient and every r, the mean over all reaches N/2 at no lower σ than half of the
/// chains have a gap that closes by itself, and N/20 at no lower σ than a twentieth of them.
fn no_rise_before_seeds(e: &Evidence<'_>) -> Departures {
    let [half, onset] = e.numbers("theory.relation", ["sigma_kept_half", "sigma_kept_onset"])?;
    let map = ensemble(e.results.of(&PROTOCOL)?, "protocol")?;
    let mut curves: Vec<&Curve> = map.curves.iter().collect();
    for (chains, curve) in lengths::from_rest(e.results.of(&LENGTHS)?) {
        if chains.ensemble.chain.masses == map.ensemble.chain.masses {
            curves.push(curve);
        }
    }
    let mut places = Vec::new();
    for Curve { rise, .. } in curves {
        places.extend(rise.half_height_all.map(|place| (place, half)));
        places.extend(rise.kept_half.map(|place| (place, half)));
        places.extend(rise.onset.map(|place| (place, onset)));
    }
    let restitutions = e.results.table("restitution.curves")?.series(&[], "r", "half_height")?;
    places.extend(restitutions.into_iter().map(|(_, place)| (place, half)));
    let quantile = e.level()?.quantile;
    let early = |(place, bound): (Estimate, f64)| over(bound - place.value, quantile * place.error);
    Ok(places.into_iter().map(early).collect())
}

/// Returns an excess over the one that is allowed, 0 if there is none.
fn over(excess: f64, allowed: f64) -> f64 {
    if excess <= 0.0 { 0.0 } else { excess / allowed }
}

fn above_stays_above(e: &Evidence<'_>) -> Departures {
    let excesses = e.results.table("branches.shares")?.series(&[], "sigma", "excess")?;
    Ok(excesses.iter().map(|(_, excess)| over(-excess.value, 5.0 * excess.error)).collect())
}

fn branches_approach(e: &Evidence<'_>) -> Departures {
    let table = e.results.table("branches.half_heights")?;
    let quantile = e.level()?.quantile;
    let part = |(_, change): &(f64, Estimate)| over(change.value, quantile * change.error);
    Ok(table.series(&[], "transient", "change_of_distance")?.iter().map(part).collect())
}

fn seeds_before_circuits(e: &Evidence<'_>) -> Departures {
    let scores = e.results.table("seeds.scores")?;
    let column = |name| scores.curve(&[], "transient", name);
    let (grown, eq25, from_rest) = (column("grown")?, column("eq25")?, column("from_rest")?);
    let circuits = eq25.iter().zip(&from_rest).map(|(a, b)| a.1.min(b.1));
    Ok(grown.iter().zip(circuits).map(|(grown, circuits)| grown.1 / circuits).collect())
}

/// The error of the formula, times n: a clump excludes others from the gaps next to it, which
/// changes the share by some gaps of n times λ²e^{−λ}/2.
const LEFT_OUT: f64 = 1.5;

/// Up to the error of the formula, five standard errors, and five chains where few are expected.
fn first_impacts_as_expected(e: &Evidence<'_>) -> Departures {
    let chains = e.results.table("nucleation.chains")?;
    let mut departures = Vec::new();
    for (masses, n) in &e.results.of(&NUCLEATION)?.parameters.lengths {
        let (masses, n) = (*masses as f64, *n as f64);
        for (expected, found) in chains.curve(&[("masses", masses)], "clumps", "found")? {
            let error = (expected * (1.0 - expected) / n).sqrt();
            let room = LEFT_OUT / masses + 5.0 * error + 5.0 / n;
            departures.push((found - expected).abs() / room);
        }
    }
    Ok(departures)
}

/// Largest error allowed of a waiting time, in units of ε (d + R₁ + R₂)/closing speed (ours).
const WAITING: f64 = 8.0;

/// What was promised before it was measured: no miss, waiting times to some units of rounding,
/// evaluations per impact in the largest chain at most twice those at a hundred masses, and no
/// scene of failure with a wrong outcome.
fn engine_as_promised(e: &Evidence<'_>) -> Departures {
    let mut departures = Vec::new();
    // The engine is the first of the methods.
    let trials = e.results.of(&TRIALS)?.trials.iter().map(|trials| &trials[0]);
    let wrong = trials.flatten().filter(|outcome| !matches!(outcome, Right | Refused));
    departures.push(2.0 * wrong.count() as f64);
    let race = e.results.of(&RACE)?.entries.iter();
    if let Some(engine) = race.clone().find(|entry| entry.setting.method == MethodName::Certified) {
        departures.push(2.0 * engine.misses as f64);
        departures.extend(engine.units.map(|units| units / WAITING));
    }
    let scale = e.results.of(&SCALE)?.iter();
    let engine = || scale.clone().filter(|row| row.setting.method == MethodName::Certified);
    let largest = engine().max_by_key(|row| row.masses);
    let hundred = engine().find(|row| row.masses == 100);
    if let [Some(most), Some(few)] = [largest, hundred].map(|row| row?.evaluations_per_impact) {
        departures.push(most / few / 2.0);
    }
    Ok(departures)
}
