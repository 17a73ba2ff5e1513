//! Makes the tables of first impacts, found and expected from the reach of single gaps.

use super::run::{Gaps, Nucleation};
use crate::experiments::prelude::*;
use impact_circuits::nucleation::Chances;

struct Chains {
    masses: usize,
    sigma: f64,
    time: f64,
    ran: u64,
    /// The active ones of them, with an impact by then.
    active: u64,
    expected: f64,
}

pub fn make(nucleation: &Nucleation) -> Vec<Table> {
    let (parameters, gaps) = (&nucleation.parameters, &nucleation.gaps);
    let mut chains = Vec::new();
    for ((runs, firsts), gaps) in parameters.runs().zip(&nucleation.rows).zip(gaps.iter().cycle()) {
        for (&time, chances) in parameters.times.iter().zip(&gaps.within) {
            let active = firsts.iter().flatten().filter(|first| **first <= time).count() as u64;
            let (masses, sigma, ran) = (runs.chain.masses, runs.sigma, firsts.len() as u64);
            let expected = chances.at_least_one(masses, runs.chain.boundary);
            chains.push(Chains { masses, sigma, time, ran, active, expected });
        }
    }
    let lengths: Vec<usize> = parameters.lengths.iter().map(|(masses, _)| *masses).collect();
    vec![
        single(gaps),
        shares(&lengths, &nucleation.curve),
        times(&parameters.times, gaps),
        chains_table(&chains),
        all(&chains, &lengths, nucleation.half),
    ]
}

fn single(gaps: &[Gaps]) -> Table {
    Table::builder("nucleation.gaps", gaps, |_| 0)
        .key("sigma", SIGMA, |row| row.sigma)
        .real("p", "1", 2, "chance of a gap between masses to close by itself", |row| row.ever.p)
        .real("neighbour", "1", 2, "that if its neighbour does", |row| row.ever.pair / row.ever.p)
        .done()
}

/// Makes the table of the share of chains that are active by the latest time, at more σ.
fn shares(lengths: &[usize], curve: &[(f64, Chances)]) -> Table {
    let expected = |(masses, (sigma, chances)): (usize, &(f64, Chances))| {
        (masses, *sigma, chances.at_least_one(masses, Chain::default().boundary))
    };
    let rows = lengths.iter().flat_map(|masses| curve.iter().map(move |row| (*masses, row)));
    let rows: Vec<(usize, f64, f64)> = rows.map(expected).collect();
    Table::builder("nucleation.shares", &rows, |_| 0)
        .key("masses", "1", |(masses, ..)| *masses as f64)
        .key("sigma", SIGMA, |(_, sigma, _)| *sigma)
        .real("clumps", "1", 3, "expected with clumps", |(.., expected)| *expected)
        .done()
}

/// Makes the table of the share of closing gaps that a finite time misses.
fn times(times: &[f64], gaps: &[Gaps]) -> Table {
    let at_each = |row: &Gaps| {
        let within = times.iter().zip(row.within.clone());
        let (sigma, p) = (row.sigma, row.ever.p);
        within.map(move |(time, within)| (sigma, *time, 1.0 - within.p / p))
    };
    let rows: Vec<(f64, f64, f64)> = gaps.iter().flat_map(at_each).collect();
    Table::builder("nucleation.times", &rows, |_| 0)
        .key("sigma", SIGMA, |(sigma, ..)| *sigma)
        .key("time", TIME, |(_, time, _)| *time)
        .real("missing", "1", 2, "share of p that is missing by then", |(.., missing)| *missing)
        .done()
}

fn chains_table(rows: &[Chains]) -> Table {
    const FOUND: &str = "share of the chains with an impact by then";
    Table::builder("nucleation.chains", rows, |row| row.ran as usize)
        .key("masses", "1", |row| row.masses as f64)
        .key("sigma", SIGMA, |row| row.sigma)
        .key("time", TIME, |row| row.time)
        .estimate("found", "1", FOUND, |row| share(row.active, row.ran))
        .real("clumps", "1", 3, "expected with clumps", |row| row.expected)
        .done()
}

fn all(chains: &[Chains], lengths: &[usize], half: f64) -> Table {
    const OFF: &str = "largest distance of found and expected shares by then";
    let shortest = lengths.iter().copied().min().unwrap_or(0);
    let last = chains.last().map(|row| row.time);
    let off = |masses: usize| {
        let rows = chains.iter().filter(|row| row.masses == masses && Some(row.time) == last);
        let off = |row: &Chains| (row.active as f64 / row.ran as f64 - row.expected).abs();
        rows.map(off).fold(0.0, f64::max)
    };
    Table::builder("nucleation.all", &[()], |()| 0)
        .real("half", SIGMA, 4, "σ where half of the chains have such a gap", |()| half)
        .count("shortest", "masses of the shortest chains", |()| shortest as u64)
        .real("off", "1", 1, OFF, |()| off(Chain::default().masses))
        .real("off_shortest", "1", 1, "the same of the shortest chains", |()| off(shortest))
        .done()
}
