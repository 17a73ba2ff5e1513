//! Makes the tables of half heights and shares on both branches.

use super::fits::{LAWS, Law};
use super::pairs::{Branch, Chains, FROM_ABOVE, FROM_REST, Pair, distance};
use crate::experiments::prelude::*;

pub fn make(chains: &Vec<Chains>) -> Vec<Table> {
    let pairs = Pair::collect(chains);
    let lengths: Vec<&[Pair]> = pairs.chunk_by(|a, b| a.masses == b.masses).collect();
    vec![
        half_heights(&lengths),
        fits(&lengths),
        compared_lengths(&lengths),
        shares(&pairs),
        all(chains, &pairs),
    ]
}

/// Makes the table of half heights after each transient, with changes since the one before it and
/// until the last.
fn half_heights(lengths: &[&[Pair]]) -> Table {
    const DISTANCE: &str = "half height from rest less that from above";
    const LATER: &str = "the same less that after the transient before";
    const LAST: &str = "half height after the last transient less this one";
    const LOW: &str = "largest σ below the half height";
    const HIGH: &str = "smallest σ above the half height";
    const COARSER: &str = "change of the half height if the σ nearest to it is left out";
    let mut rows: Vec<(&Pair, Option<&Pair>, &Pair)> = Vec::new();
    for pairs in lengths {
        let before = [None].into_iter().chain(pairs.iter().map(Some));
        rows.extend(
            pairs.iter().zip(before).map(|(pair, last)| (pair, last, &pairs[pairs.len() - 1])),
        );
    }
    Table::builder("branches.half_heights", &rows, |row| row.0.chains())
        .table_computed_by(origin(Branch::half_height))
        .key("masses", "1", |row| row.0.masses as f64)
        .key("transient", TIME, |row| row.0.transient)
        .estimate("from_rest", SIGMA, HALF_HEIGHT, |row| row.0.estimate(FROM_REST))
        .estimate("from_above", SIGMA, HALF_HEIGHT, |row| row.0.estimate(FROM_ABOVE))
        .estimate("rest_until_last", SIGMA, LAST, |row| row.2.estimate_less(row.0, FROM_REST))
        .estimate("above_until_last", SIGMA, LAST, |row| row.2.estimate_less(row.0, FROM_ABOVE))
        .chosen("rest_low", SIGMA, LOW, |row| Some(row.0.rest.neighbours()?[0]))
        .chosen("rest_high", SIGMA, HIGH, |row| Some(row.0.rest.neighbours()?[1]))
        .chosen("above_low", SIGMA, LOW, |row| Some(row.0.above.neighbours()?[0]))
        .chosen("above_high", SIGMA, HIGH, |row| Some(row.0.above.neighbours()?[1]))
        .estimate("rest_coarser", SIGMA, COARSER, |row| {
            row.0.estimate(&|pair, without| pair.rest.coarser(without))
        })
        .estimate("above_coarser", SIGMA, COARSER, |row| {
            row.0.estimate(&|pair, without| pair.above.coarser(without))
        })
        .computed_by(origin(Branch::coarser), &["rest_coarser", "above_coarser"])
        .estimate("distance", SIGMA, DISTANCE, |row| row.0.estimate(&distance))
        .estimate("change_of_distance", SIGMA, LATER, |row| row.0.estimate_less(row.1?, &distance))
        .computed_by(origin(distance), &["distance", "change_of_distance"])
        .done()
}

fn fits(lengths: &[&[Pair]]) -> Table {
    const AMPLITUDE: &str = "fitted distance at the first transient less the limit";
    const MISFIT: &str = "sum of squares of distances less fitted ones, each over its error";
    let laws = Vec::from_iter(lengths.iter().flat_map(|pairs| LAWS.map(|law| (*pairs, law))));
    let estimate = |(pairs, law): &(&[Pair], Law), of| law.estimate(pairs, of);
    Table::builder("branches.fits", &laws, |row| row.0[0].chains())
        .table_computed_by(origin(Law::estimate))
        .key("masses", "1", |row| row.0[0].masses as f64)
        .text_key("law", |row| row.1.name.into())
        .estimate("limit", SIGMA, "distance after unlimited time", |row| {
            estimate(row, |fit| fit.limit).filter(|_| row.1.limited)
        })
        .estimate("amplitude", SIGMA, AMPLITUDE, |row| estimate(row, |fit| fit.amplitude))
        .estimate("exponent", "1", "exponent b", |row| estimate(row, |fit| fit.exponent))
        .real("misfit", "1", 2, MISFIT, |row| Some(estimate(row, |fit| fit.misfit)?.value))
        .done()
}

/// Makes the table of half heights of the shorter chains less those of the longer ones, which begin
/// with the same forces.
fn compared_lengths(lengths: &[&[Pair]]) -> Table {
    const LESS: &str = "that of the shorter chains less that of the longer ones";
    let mut rows: Vec<(&Pair, &Pair)> = Vec::new();
    if let [short, long] = lengths {
        rows.extend(short.iter().zip(*long));
    }
    Table::builder("branches.lengths", &rows, |(short, long)| short.chains().min(long.chains()))
        .table_computed_by(origin(Branch::half_height))
        .key("transient", TIME, |(short, _)| short.transient)
        .estimate("from_rest", SIGMA, LESS, |(short, long)| short.estimate_less(long, FROM_REST))
        .estimate("from_above", SIGMA, LESS, |(short, long)| short.estimate_less(long, FROM_ABOVE))
        .estimate("distance", SIGMA, LESS, |(short, long)| short.estimate_less(long, &distance))
        .done()
}

fn excess(pair: &Pair, sigma: f64) -> Option<Estimate> {
    pair.estimate(&|pair, without| {
        Some(pair.above.share(sigma, without)? - pair.rest.share(sigma, without)?)
    })
}

fn shares(pairs: &[Pair]) -> Table {
    const SHARE: &str = "share of all gaps with an impact";
    let share = |pair: &Pair, branch: fn(&Pair) -> &Branch, sigma: f64| {
        pair.estimate(&|pair, without| branch(pair).share(sigma, without))
    };
    let mut rows: Vec<(&Pair, f64)> = Vec::new();
    for pair in pairs {
        let mut sigmas = [&pair.rest.sigmas[..], &pair.above.sigmas].concat();
        sigmas.sort_by(f64::total_cmp);
        sigmas.dedup();
        rows.extend(sigmas.into_iter().map(|sigma| (pair, sigma)));
    }
    Table::builder("branches.shares", &rows, |(pair, _)| pair.chains())
        .table_computed_by(origin(Branch::share))
        .key("masses", "1", |(pair, _)| pair.masses as f64)
        .key("transient", TIME, |(pair, _)| pair.transient)
        .key("sigma", SIGMA, |(_, sigma)| *sigma)
        .estimate("from_rest", "1", SHARE, |row| share(row.0, |pair| &pair.rest, row.1))
        .estimate("from_above", "1", SHARE, |row| share(row.0, |pair| &pair.above, row.1))
        .estimate("excess", "1", "share from above less that from rest", |row| excess(row.0, row.1))
        .computed_by(origin(excess), &["excess"])
        .done()
}

fn all(ensembles: &[Chains], pairs: &[Pair]) -> Table {
    let heated = ensembles.iter().find_map(|one| one.ensemble.heating);
    let above = ensembles.iter().filter(|one| one.ensemble.heating.is_some());
    let counts = above.flat_map(|one| one.counts.iter().flatten().flatten());
    let silent = counts.filter(|count| **count == Some(0)).count();
    let chains = pairs.iter().map(Pair::chains).min().unwrap_or(0);
    Table::builder("branches.all", &[()], |()| 0)
        .count("chains", "chains of each length on each branch", |()| chains as u64)
        .chosen("hot", SIGMA, "σ of the force at first", |()| heated.map(|hot| hot.sigma))
        .chosen("heating", TIME, "time under that force", |()| heated.map(|hot| hot.time))
        .count("silent", "windows from above without an impact", |()| silent as u64)
        .done()
}
