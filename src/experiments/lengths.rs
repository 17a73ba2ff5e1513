//! Runs chains of several lengths from rest, and with a random start after several transients.

use crate::experiments::prelude::*;

pub const LENGTHS: Ensembles = ensembles("lengths", "lengths", params::lengths, tables);

pub fn from_rest(ensembles: &[Counted]) -> impl Iterator<Item = (&Counted, &Curve)> {
    let at_rest = ensembles.iter().filter(|one| one.ensemble.chain.start == Start::Rest);
    at_rest.flat_map(|one| one.curves.iter().map(move |curve| (one, curve)))
}

pub fn tables(ensembles: &Vec<Counted>) -> Vec<Table> {
    vec![rest(ensembles), random(ensembles), all(ensembles)]
}

fn rest(ensembles: &[Counted]) -> Table {
    let rows: Vec<_> = from_rest(ensembles).collect();
    const WIDTH: &str = "from a quarter to three quarters of all gaps";
    Table::builder("lengths.rest", &rows, |row| row.0.ensemble.realisations)
        .table_computed_by(origin(Curve::new))
        .key("masses", "1", |row| row.0.ensemble.chain.masses as f64)
        .key("transient", TIME, |row| row.1.protocol.transient)
        .key("window", TIME, |row| row.1.protocol.window)
        .estimate("half_height", SIGMA, HALF_HEIGHT, |row| row.1.rise.half_height_all)
        .estimate("width", SIGMA, WIDTH, |row| row.1.rise.quarters)
        .done()
}

fn random(ensembles: &[Counted]) -> Table {
    let random = find_ensemble(ensembles, "random");
    let curves = random.map_or(&[][..], |one| &one.curves);
    Table::builder("lengths.random", curves, |_| random.map_or(0, |one| one.ensemble.realisations))
        .table_computed_by(origin(Curve::new))
        .key("transient", TIME, |curve| curve.protocol.transient)
        .estimate("half_height", SIGMA, HALF_HEIGHT, |curve| curve.rise.half_height_all)
        .done()
}

fn all(ensembles: &[Counted]) -> Table {
    const STRETCH: &str = "masses of a stretch of them that is counted like a chain";
    let longest = ensembles.iter().map(|one| &one.ensemble).max_by_key(|one| one.chain.masses);
    let stretch = longest.map(|one| (one.chain.masses / one.pieces) as f64);
    let longest = longest.map(|one| one.chain.masses as f64);
    Table::builder("lengths.all", &[()], |()| 0)
        .chosen("longest", "1", "masses of the longest chains", |()| longest)
        .chosen("stretch", "1", STRETCH, |()| stretch)
        .done()
}
