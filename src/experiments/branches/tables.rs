//! Makes the tables of half heights and shares on both branches.

use super::pairs::{Branch, FROM_ABOVE, FROM_REST, Pair, Quantity, distance, exponent, interval};
use super::run::Chains;
use crate::experiments::prelude::*;

pub fn tables(found: &Vec<Chains>) -> Vec<Table> {
    let pairs = Pair::all(found);
    let lengths: Vec<&[Pair]> = pairs.chunk_by(|a, b| a.masses == b.masses).collect();
    vec![
        half_heights(&lengths),
        laws(&lengths),
        compared_lengths(&lengths),
        late(&lengths),
        fixed(&lengths),
        shares(&pairs),
        all(found, &pairs),
    ]
}

/// Makes the table of half heights after each transient, and the change since the one before it.
fn half_heights(lengths: &[&[Pair]]) -> Table {
    const DISTANCE: &str = "half height from rest less that from above";
    const LATER: &str = "the same less that after the transient before";
    let mut rows: Vec<(&Pair, Option<&Pair>)> = Vec::new();
    for pairs in lengths {
        rows.extend(pairs.iter().zip([None].into_iter().chain(pairs.iter().map(Some))));
    }
    Table::of("branches.half_heights", &rows, |(pair, _)| pair.chains())
        .key("masses", "1", |(pair, _)| pair.masses as f64)
        .key("transient", TIME, |(pair, _)| pair.transient)
        .computed_by(origin(Branch::half_height))
        .estimate("from_rest", SIGMA, HALF_HEIGHT, |(pair, _)| pair.estimate(FROM_REST))
        .estimate("from_above", SIGMA, HALF_HEIGHT, |(pair, _)| pair.estimate(FROM_ABOVE))
        .computed_by(origin(distance))
        .estimate("distance", SIGMA, DISTANCE, |(pair, _)| pair.estimate(distance))
        .estimate("change_of_distance", SIGMA, LATER, |row| row.0.estimate_less(row.1?, distance))
        .done()
}

fn last_three(pairs: &[Pair]) -> &[Pair] {
    &pairs[pairs.len().saturating_sub(3)..]
}

fn laws(lengths: &[&[Pair]]) -> Table {
    const LAW: &str = "d ln(distance)/d ln T by least squares over the last three transients";
    const EARLY: &str = "the same over the first two transients";
    let late = |pairs: &[Pair], without| exponent(last_three(pairs), without);
    let early = |pairs: &[Pair], without| exponent(&pairs[..pairs.len().min(2)], without);
    let law = |pairs: &[Pair]| pairs[0].estimate(|_, without| late(pairs, without));
    let ends = |pairs: &[Pair]| interval(law(pairs), pairs[0].chains());
    Table::of("branches.laws", lengths, |pairs| pairs[0].chains())
        .key("masses", "1", |pairs| pairs[0].masses as f64)
        .chosen("until", TIME, "the second transient", |pairs| Some(pairs.get(1)?.transient))
        .chosen("since", TIME, "the third last one", |pairs| Some(last_three(pairs)[0].transient))
        .computed_by(origin(exponent))
        .estimate("exponent", "1", LAW, |pairs| law(pairs))
        .real("exponent_from", "1", 2, "lower end of its interval", |pairs| Some(ends(pairs)?[0]))
        .real("exponent_to", "1", 2, "upper end of its interval", |pairs| Some(ends(pairs)?[1]))
        .estimate("early", "1", EARLY, |all| all[0].estimate(|_, without| early(all, without)))
        .estimate("change", "1", "the exponent less the early one", |all| {
            all[0].estimate(|_, without| Some(late(all, without)? - early(all, without)?))
        })
        .done()
}

/// Makes the table of the shorter chains less the longer ones, which begin with the same forces.
fn compared_lengths(lengths: &[&[Pair]]) -> Table {
    const LESS: &str = "that of the shorter chains less that of the longer ones";
    let mut rows: Vec<(&Pair, &Pair)> = Vec::new();
    if let [short, long] = lengths {
        rows.extend(short.iter().zip(*long));
    }
    Table::of("branches.lengths", &rows, |(short, long)| short.chains().min(long.chains()))
        .key("transient", TIME, |(short, _)| short.transient)
        .computed_by(origin(Branch::half_height))
        .estimate("from_rest", SIGMA, LESS, |(short, long)| short.estimate_less(long, FROM_REST))
        .estimate("from_above", SIGMA, LESS, |(short, long)| short.estimate_less(long, FROM_ABOVE))
        .estimate("distance", SIGMA, LESS, |(short, long)| short.estimate_less(long, distance))
        .done()
}

/// Makes the table of changes of half heights from the third last transient to the last.
fn late(lengths: &[&[Pair]]) -> Table {
    const SINCE: &str = "half height at last less that at the earlier time";
    let change = |pairs: &[Pair], quantity: Quantity| {
        pairs.last()?.estimate_less(&last_three(pairs)[0], quantity)
    };
    Table::of("branches.late", lengths, |pairs| pairs[0].chains())
        .key("masses", "1", |pairs| pairs[0].masses as f64)
        .chosen("since", TIME, "the earlier time", |pairs| Some(last_three(pairs)[0].transient))
        .computed_by(origin(Branch::half_height))
        .estimate("from_rest", SIGMA, SINCE, |pairs| change(pairs, FROM_REST))
        .estimate("from_above", SIGMA, SINCE, |pairs| change(pairs, FROM_ABOVE))
        .done()
}

fn excess(pair: &Pair, sigma: f64) -> Option<Estimate> {
    pair.estimate(|pair, without| {
        Some(pair.above.share(sigma, without)? - pair.rest.share(sigma, without)?)
    })
}

/// Makes the table of shares at the largest σ that both branches have after every transient.
fn fixed(lengths: &[&[Pair]]) -> Table {
    const ABOVE: &str = "share from above at last less that at the first time";
    const LATE: &str = "the same since the third last time";
    const EXCESS: &str = "share from above less that from rest, at first";
    let mut rows: Vec<(&[Pair], f64)> = Vec::new();
    for pairs in lengths {
        let everywhere = |sigma: &&f64| {
            pairs.iter().all(|at| at.rest.sigmas.contains(sigma) && at.above.sigmas.contains(sigma))
        };
        let largest = pairs[0].rest.sigmas.iter().rev().find(everywhere);
        rows.extend(largest.map(|sigma| (*pairs, *sigma)));
    }
    let fall = |(pairs, sigma): &(&[Pair], f64), since: &Pair| {
        pairs.last()?.estimate_less(since, |pair, without| pair.above.share(*sigma, without))
    };
    Table::of("branches.fixed", &rows, |(pairs, _)| pairs[0].chains())
        .key("masses", "1", |(pairs, _)| pairs[0].masses as f64)
        .chosen("sigma", SIGMA, "standard deviation σ", |(_, sigma)| Some(*sigma))
        .computed_by(origin(Branch::share))
        .estimate("fall", "1", ABOVE, |row| fall(row, &row.0[0]))
        .estimate("late_fall", "1", LATE, |row| fall(row, &last_three(row.0)[0]))
        .computed_by(origin(excess))
        .estimate("excess", "1", EXCESS, |row| excess(&row.0[0], row.1))
        .estimate("late_excess", "1", "the same at last", |row| excess(row.0.last()?, row.1))
        .done()
}

fn shares(pairs: &[Pair]) -> Table {
    const SHARE: &str = "share of all gaps with an impact";
    const EXCESS: &str = "share from above less that from rest";
    let share = |pair: &Pair, branch: fn(&Pair) -> &Branch, sigma: f64| {
        pair.estimate(|pair, without| branch(pair).share(sigma, without))
    };
    let mut rows: Vec<(&Pair, f64)> = Vec::new();
    for pair in pairs {
        let mut sigmas = [&pair.rest.sigmas[..], &pair.above.sigmas].concat();
        sigmas.sort_by(f64::total_cmp);
        sigmas.dedup();
        rows.extend(sigmas.into_iter().map(|sigma| (pair, sigma)));
    }
    Table::of("branches.shares", &rows, |(pair, _)| pair.chains())
        .key("masses", "1", |(pair, _)| pair.masses as f64)
        .key("transient", TIME, |(pair, _)| pair.transient)
        .key("sigma", SIGMA, |(_, sigma)| *sigma)
        .computed_by(origin(Branch::share))
        .estimate("from_rest", "1", SHARE, |row| share(row.0, |pair| &pair.rest, row.1))
        .estimate("from_above", "1", SHARE, |row| share(row.0, |pair| &pair.above, row.1))
        .computed_by(origin(excess))
        .estimate("excess", "1", EXCESS, |row| excess(row.0, row.1))
        .done()
}

fn all(found: &[Chains], pairs: &[Pair]) -> Table {
    let heated = found.iter().find_map(|one| one.ensemble.heating);
    let above = found.iter().filter(|one| one.ensemble.heating.is_some());
    let counts = above.flat_map(|one| one.counts.iter().flatten().flatten());
    let silent = counts.filter(|count| **count == Some(0)).count();
    let chains = pairs.iter().map(Pair::chains).min().unwrap_or(0);
    Table::of("branches.all", &[()], |()| 0)
        .count("chains", "chains of each length on each branch", |()| chains as u64)
        .chosen("hot", SIGMA, "σ of the force at first", |()| heated.map(|hot| hot.sigma))
        .chosen("heating", TIME, "time under that force", |()| heated.map(|hot| hot.time))
        .count("silent", "windows from above without an impact", |()| silent as u64)
        .done()
}
