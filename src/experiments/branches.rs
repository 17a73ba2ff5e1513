//! Whether the threshold forgets its history: chains from rest, and chains from above, where all forces were lowered from
//! well beyond the rise; of several lengths, after several transients.

use super::starts::HALF_HEIGHT;
use crate::experiments::prelude::*;
use impact_chain::{Boundary, Protocol, Start};

const WIDTH: &str = "from a quarter to three quarters of all gaps";

/// Masses of the chain of an ensemble.
fn masses(own: &Counted) -> usize {
    own.ensemble.chain.masses
}

/// The chains from rest between walls, with their curves.
pub fn from_rest(found: &[Counted]) -> impl Iterator<Item = (&Counted, &Curve)> {
    let chain = |own: &Counted| (own.ensemble.chain.start, own.ensemble.chain.boundary);
    let usual = move |own: &&Counted| {
        own.ensemble.heating.is_none() && chain(own) == (Start::Rest, Boundary::Walls)
    };
    found.iter().filter(usual).flat_map(|own| own.curves.iter().map(move |curve| (own, curve)))
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

/// Of the length that was run from above too.
pub fn both(found: &[Counted]) -> Vec<Both<'_>> {
    let mut both = Vec::new();
    for rest in from_rest(found) {
        let Protocol { transient, window } = rest.1.protocol;
        let hot = |own: &&Counted| own.ensemble.heating.is_some() && masses(own) == masses(rest.0);
        let mut curves = found.iter().filter(hot).map(|own| (own, own.curve(transient, window)));
        if let Some((own, Some(curve))) = curves.find(|own| own.1.is_some()) {
            both.push(Both { rest, above: (own, curve) });
        }
    }
    both
}

/// Share of all gaps with an impact at a σ; none where it was not run so long.
pub fn share((own, curve): (&Counted, &Curve), sigma: f64) -> Option<Estimate> {
    let row = curve.rows.iter().find(|row| row.sigma == sigma)?;
    let mean = row.mean_all?.estimate()?;
    let gaps = own.ensemble.chain.gaps() as f64 / own.ensemble.pieces as f64;
    Some(with_error(mean.value / gaps, mean.error / gaps))
}

/// All tables.
pub fn tables(found: &Vec<Counted>) -> Vec<Table> {
    let both = both(found);
    vec![
        half_heights(&both),
        shares(&both),
        lengths(found, &both),
        starts(found),
        all(found, &both),
    ]
}

fn half_heights(both: &[Both<'_>]) -> Table {
    Table::of("branches.half_heights", both, |own| own.rest.0.ensemble.realisations)
        .key("transient", TIME, Both::transient)
        .chosen("masses", "1", "masses of a chain", |own| Some(masses(own.rest.0) as f64))
        .computed_by(origin(Curve::new))
        .estimate("from_rest", SIGMA, HALF_HEIGHT, |own| own.rest.1.rise.half_height_all)
        .estimate("from_above", SIGMA, HALF_HEIGHT, |own| own.above.1.rise.half_height_all)
        .estimate("width_from_rest", SIGMA, WIDTH, |own| own.rest.1.rise.quarters)
        .estimate("width_from_above", SIGMA, WIDTH, |own| own.above.1.rise.quarters)
        .computed_by(origin(Both::distance))
        .estimate("distance", SIGMA, "half height from rest less that from above", Both::distance)
        .done()
}

/// At the σ that were run on both branches.
fn shares(both: &[Both<'_>]) -> Table {
    let mut rows: Vec<(f64, &Both<'_>)> = Vec::new();
    for own in both {
        let above = &own.above.0.ensemble.sigmas;
        let common = own.rest.0.ensemble.sigmas.iter().filter(|sigma| above.contains(sigma));
        rows.extend(common.map(|&sigma| (sigma, own)));
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
    let other = |(own, _): &(&Counted, _)| both.iter().all(|both| !std::ptr::eq(both.rest.0, *own));
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

fn starts(found: &[Counted]) -> Table {
    let other = |own: &&Counted| ["random", "ring"].contains(&own.ensemble.name.as_str());
    let mut rows: Vec<(&Counted, &Curve)> = Vec::new();
    for own in found.iter().filter(other) {
        rows.extend(own.curves.iter().map(|curve| (own, curve)));
    }
    Table::of("branches.starts", &rows, |row| row.0.ensemble.realisations)
        .text_key("chain", |row| row.0.ensemble.name.clone())
        .key("transient", TIME, |row| row.1.protocol.transient)
        .computed_by(origin(Curve::new))
        .estimate("half_height", SIGMA, HALF_HEIGHT, |row| row.1.rise.half_height_all)
        .done()
}

fn all(found: &[Counted], both: &[Both<'_>]) -> Table {
    let longest = found.iter().map(masses).max();
    let heated = found.iter().find_map(|own| own.ensemble.heating.map(|heating| (own, heating)));
    Table::of("branches.all", &[()], |()| 0)
        .chosen("longest", "1", "masses of the longest chains", |()| longest.map(|n| n as f64))
        .chosen("masses", "1", "masses of the chains of both branches, the first of them", |()| {
            heated.map(|(own, _)| masses(own) as f64)
        })
        .chosen("stretch", "1", "masses of a stretch that is counted like a chain", |()| {
            heated.map(|(own, _)| (masses(own) / own.ensemble.pieces) as f64)
        })
        .chosen("hot", SIGMA, "σ of the force at first", |()| heated.map(|(_, own)| own.sigma))
        .chosen("heating", TIME, "time under that force", |()| heated.map(|(_, own)| own.time))
        .computed_by(origin(exponent))
        .estimate("exponent", "1", "of T in the distance, from the first to the last", |()| {
            exponent(ends(both)?)
        })
        .computed_by(origin(logarithmic))
        .estimate("logarithmic", SIGMA, "the last distance, if it fell like 1/ln T", |()| {
            logarithmic(ends(both)?)
        })
        .done()
}

/// A transient and the distance after it.
type End = (f64, Estimate);

/// The first transient and the last, each with its distance.
fn ends(both: &[Both<'_>]) -> Option<[End; 2]> {
    let end = |own: Option<&Both<'_>>| Some((own?.transient(), own?.distance()?));
    Some([end(both.first())?, end(both.last())?])
}

/// The exponent a of a distance that falls like T^−a from the first transient to the last.
fn exponent([(early, first), (late, last)]: [End; 2]) -> Option<Estimate> {
    let logarithm = pxfm::f_log(late / early);
    let [a, b] = [first, last].map(|own| own.error / own.value);
    let exponent = pxfm::f_log(first.value / last.value) / logarithm;
    let error = (a * a + b * b).sqrt() / logarithm;
    exponent.is_finite().then(|| with_error(exponent, error))
}

/// What would be left of the first distance after the last transient, if it fell like 1/ln T.
fn logarithmic([(early, first), (late, _)]: [End; 2]) -> Option<Estimate> {
    let factor = pxfm::f_log(early) / pxfm::f_log(late);
    Some(with_error(factor * first.value, factor * first.error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_of_a_distance_by_hand() {
        let ends = [(1e2, with_error(0.04, 0.003)), (1e4, with_error(0.01, 0.001))];
        let found = exponent(ends).unwrap();
        // ln 4/ln 100 = log 2, and √(0.075² + 0.1²)/ln 100.
        assert!((found.value - std::f64::consts::LOG10_2).abs() < 1e-14, "{found:?}");
        assert!((found.error - 0.125 / (2.0 * std::f64::consts::LN_10)).abs() < 1e-14, "{found:?}");
        let left = logarithmic(ends).unwrap();
        assert!((left.value - 0.02).abs() < 1e-15 && (left.error - 0.0015).abs() < 1e-15);
    }
}
