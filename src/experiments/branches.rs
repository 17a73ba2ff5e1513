//! Whether the threshold depends on the history: chains from rest, and chains from above, where all forces were lowered
//! from well beyond the rise; of several lengths, after several transients.

use super::ensembles::{Ensembles, ensembles};
use super::half_height::HALF_HEIGHT;
use crate::experiments::prelude::*;
use crate::params;
use impact_chain::{Protocol, Start};

/// Chains from rest and from above, of several lengths, after several transients.
pub const BRANCHES: Ensembles = ensembles("branches", "branches", params::branches, tables);

const WIDTH: &str = "from a quarter to three quarters of all gaps";

fn masses(one: &Counted) -> usize {
    one.ensemble.chain.masses
}

/// The chains from rest between walls, with their curves.
pub fn from_rest(found: &[Counted]) -> impl Iterator<Item = (&Counted, &Curve)> {
    let at_rest =
        |one: &&Counted| one.ensemble.heating.is_none() && one.ensemble.chain.start == Start::Rest;
    found.iter().filter(at_rest).flat_map(|one| one.curves.iter().map(move |curve| (one, curve)))
}

/// Both branches after one transient: the ensembles with their curves.
pub struct Both<'a> {
    /// From rest.
    pub rest: (&'a Counted, &'a Curve),
    /// From above.
    pub above: (&'a Counted, &'a Curve),
}

impl Both<'_> {
    /// Transient T.
    pub fn transient(&self) -> f64 {
        self.rest.1.protocol.transient
    }

    /// By how much the half height from rest lies above that from above.
    fn distance(&self) -> Option<Estimate> {
        let half = |curve: &Curve| curve.rise.half_height_all;
        Some(difference(half(self.rest.1)?, half(self.above.1)?))
    }
}

/// Both branches after each transient, of the length that was run from above too.
pub fn both(found: &[Counted]) -> Vec<Both<'_>> {
    let mut both = Vec::new();
    for rest in from_rest(found) {
        let Protocol { transient, window } = rest.1.protocol;
        let hot = |one: &&Counted| one.ensemble.heating.is_some() && masses(one) == masses(rest.0);
        let mut curves = found.iter().filter(hot).map(|one| (one, one.curve(transient, window)));
        if let Some((one, Some(curve))) = curves.find(|one| one.1.is_some()) {
            both.push(Both { rest, above: (one, curve) });
        }
    }
    both
}

/// Share of all gaps with an impact at a σ; none where the runs were shorter.
pub fn share((one, curve): (&Counted, &Curve), sigma: f64) -> Option<Estimate> {
    let row = curve.rows.iter().find(|row| row.sigma == sigma)?;
    let mean = row.mean_all?.estimate()?;
    let gaps = one.ensemble.chain.gaps() as f64 / one.ensemble.pieces as f64;
    Some(with_error(mean.value / gaps, mean.error / gaps))
}

/// All tables.
pub fn tables(found: &Vec<Counted>) -> Vec<Table> {
    let both = both(found);
    vec![half_heights(&both), shares(&both), lengths(found, &both), random(found), all(found)]
}

fn half_heights(both: &[Both<'_>]) -> Table {
    Table::of("branches.half_heights", both, |both| both.rest.0.ensemble.realisations)
        .key("transient", TIME, Both::transient)
        .chosen("masses", "1", "masses of a chain", |both| Some(masses(both.rest.0) as f64))
        .computed_by(origin(Curve::new))
        .estimate("from_rest", SIGMA, HALF_HEIGHT, |both| both.rest.1.rise.half_height_all)
        .estimate("from_above", SIGMA, HALF_HEIGHT, |both| both.above.1.rise.half_height_all)
        .estimate("width_from_rest", SIGMA, WIDTH, |both| both.rest.1.rise.quarters)
        .estimate("width_from_above", SIGMA, WIDTH, |both| both.above.1.rise.quarters)
        .computed_by(origin(Both::distance))
        .estimate("distance", SIGMA, "half height from rest less that from above", Both::distance)
        .done()
}

/// At the σ that were run on both branches.
fn shares(both: &[Both<'_>]) -> Table {
    let mut rows: Vec<(f64, &Both<'_>)> = Vec::new();
    for pair in both {
        let above = &pair.above.0.ensemble.sigmas;
        let common = pair.rest.0.ensemble.sigmas.iter().filter(|sigma| above.contains(sigma));
        rows.extend(common.map(|&sigma| (sigma, pair)));
    }
    const SHARE: &str = "share of all gaps with an impact";
    Table::of("branches.shares", &rows, |row| row.1.rest.0.ensemble.realisations)
        .key("transient", TIME, |row| row.1.transient())
        .key("sigma", SIGMA, |row| row.0)
        .computed_by(origin(share))
        .estimate("from_rest", "1", SHARE, |row| share(row.1.rest, row.0))
        .estimate("from_above", "1", SHARE, |row| share(row.1.above, row.0))
        .done()
}

/// Half heights of chains from rest of lengths at which none was run from above.
fn lengths(found: &[Counted], both: &[Both<'_>]) -> Table {
    let other = |(one, _): &(&Counted, _)| both.iter().all(|both| !std::ptr::eq(both.rest.0, *one));
    let rows: Vec<_> = from_rest(found).filter(other).collect();
    Table::of("branches.lengths", &rows, |row| row.0.ensemble.realisations)
        .key("masses", "1", |row| masses(row.0) as f64)
        .key("transient", TIME, |row| row.1.protocol.transient)
        .key("window", TIME, |row| row.1.protocol.window)
        .computed_by(origin(Curve::new))
        .estimate("half_height", SIGMA, HALF_HEIGHT, |row| row.1.rise.half_height_all)
        .estimate("width", SIGMA, WIDTH, |row| row.1.rise.quarters)
        .done()
}

/// Half heights of chains with random free parts.
fn random(found: &[Counted]) -> Table {
    let random = named(found, "random");
    let curves = random.map_or(&[][..], |one| &one.curves);
    Table::of("branches.random", curves, |_| random.map_or(0, |one| one.ensemble.realisations))
        .key("transient", TIME, |curve| curve.protocol.transient)
        .computed_by(origin(Curve::new))
        .estimate("half_height", SIGMA, HALF_HEIGHT, |curve| curve.rise.half_height_all)
        .done()
}

fn all(found: &[Counted]) -> Table {
    let longest = found.iter().map(masses).max();
    let heated = found.iter().find_map(|one| one.ensemble.heating.map(|heating| (one, heating)));
    Table::of("branches.all", &[()], |()| 0)
        .chosen("longest", "1", "masses of the longest chains", |()| longest.map(|n| n as f64))
        .chosen("masses", "1", "masses of the chains of both branches, the first of them", |()| {
            heated.map(|(one, _)| masses(one) as f64)
        })
        .chosen("stretch", "1", "masses of a stretch that is counted like a chain", |()| {
            heated.map(|(one, _)| (masses(one) / one.ensemble.pieces) as f64)
        })
        .chosen("hot", SIGMA, "σ of the force at first", |()| heated.map(|(_, hot)| hot.sigma))
        .chosen("heating", TIME, "time under that force", |()| heated.map(|(_, hot)| hot.time))
        .done()
}
