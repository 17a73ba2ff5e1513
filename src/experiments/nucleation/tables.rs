//! Makes the tables of first impacts, found and expected from the reach of single gaps.

use super::run::{First, Gaps, Nucleation, ensembles};
use crate::experiments::prelude::*;
use crate::params::NucleationParams;
use impact_circuits::nucleation::Chances;

/// Chains of one length at one σ by some time.
struct Chains<'a> {
    masses: usize,
    sigma: f64,
    time: f64,
    part: &'a [First],
    expected: f64,
}

pub fn tables(found: &Nucleation) -> Vec<Table> {
    let (parameters, gaps) = (&found.parameters, &found.expected.gaps);
    let mut chains = Vec::new();
    for (row, ((masses, _, sigma), part)) in ensembles(parameters).zip(&found.rows).enumerate() {
        let at = &gaps[row % gaps.len()];
        for (&time, chances) in parameters.times.iter().zip(&at.within) {
            let expected = chances.at_least_one(masses, parameters.chain.boundary);
            chains.push(Chains { masses, sigma, time, part, expected });
        }
    }
    vec![
        single(gaps),
        shares(parameters, &found.expected.curve),
        times(parameters, gaps),
        chains_table(&chains),
        all(parameters, &chains, found.expected.half),
    ]
}

/// Makes the table of single gaps and neighbours in unlimited time.
fn single(gaps: &[Gaps]) -> Table {
    Table::of("nucleation.gaps", gaps, |_| 0)
        .key("sigma", SIGMA, |row| row.sigma)
        .real("p", "1", 2, "chance of a gap between masses to close by itself", |row| row.ever.p)
        .real("neighbour", "1", 2, "that of a gap between masses if its neighbour does", |row| {
            row.ever.pair / row.ever.p
        })
        .done()
}

/// Makes the table of the share of the chains with an impact by the latest time, at more σ.
fn shares(parameters: &NucleationParams, curve: &[(f64, Chances)]) -> Table {
    let lengths = parameters.lengths.iter().map(|(masses, _)| *masses);
    let rows: Vec<(usize, f64, Chances)> =
        lengths.flat_map(|masses| curve.iter().map(move |row| (masses, row.0, row.1))).collect();
    Table::of("nucleation.shares", &rows, |_| 0)
        .key("masses", "1", |(masses, ..)| *masses as f64)
        .key("sigma", SIGMA, |(_, sigma, _)| *sigma)
        .real("clumps", "1", 3, "expected with clumps", |(masses, _, by_then)| {
            by_then.at_least_one(*masses, parameters.chain.boundary)
        })
        .done()
}

/// Makes the table of the share of closing gaps that a finite time misses.
fn times(parameters: &NucleationParams, gaps: &[Gaps]) -> Table {
    let rows: Vec<(&Gaps, f64, Chances)> = gaps
        .iter()
        .flat_map(|row| parameters.times.iter().zip(&row.within).map(move |at| (row, *at.0, *at.1)))
        .collect();
    Table::of("nucleation.times", &rows, |_| 0)
        .key("sigma", SIGMA, |(row, ..)| row.sigma)
        .key("time", TIME, |(_, time, _)| *time)
        .real("missing", "1", 2, "share of p that is missing by then", |(row, _, within)| {
            1.0 - within.p / row.ever.p
        })
        .done()
}

fn chains_table(rows: &[Chains<'_>]) -> Table {
    Table::of("nucleation.chains", rows, |row| row.part.len())
        .key("masses", "1", |row| row.masses as f64)
        .key("sigma", SIGMA, |row| row.sigma)
        .key("time", TIME, |row| row.time)
        .estimate("found", "1", "share of the chains with an impact by then", |row| {
            share(row.hit(), row.part.len() as u64)
        })
        .real("clumps", "1", 3, "expected with clumps", |row| row.expected)
        .done()
}

fn all(parameters: &NucleationParams, chains: &[Chains<'_>], half: f64) -> Table {
    let shortest = parameters.lengths.iter().map(|(masses, _)| *masses).min().unwrap_or(0);
    let last = parameters.times.last().copied();
    let off = |masses: usize| {
        let rows = chains.iter().filter(|row| row.masses == masses && Some(row.time) == last);
        let off = |row: &Chains<'_>| row.hit() as f64 / row.part.len() as f64 - row.expected;
        rows.map(|row| off(row).abs()).fold(0.0, f64::max)
    };
    Table::of("nucleation.all", &[parameters], |_| 0)
        .real("half", SIGMA, 4, "σ where half of the chains have such a gap", |_| half)
        .count("shortest", "masses of the shortest chains", |_| shortest as u64)
        .real("off", "1", 1, "largest distance of found and expected shares by then", |row| {
            off(row.chain.masses)
        })
        .real("off_shortest", "1", 1, "the same of the shortest chains", |_| off(shortest))
        .done()
}

impl Chains<'_> {
    /// Returns the number of chains with an impact by the time.
    fn hit(&self) -> u64 {
        let by_then = |first: &&First| first.is_some_and(|at| at <= self.time);
        self.part.iter().filter(by_then).count() as u64
    }
}
