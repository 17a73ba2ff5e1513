//! Finds half heights of chains of several restitutions r.

use crate::experiments::prelude::*;

pub const RESTITUTION: Ensembles =
    ensembles("restitution", "restitution", params::restitution, tables);

pub fn tables(ensembles: &Vec<Counted>) -> Vec<Table> {
    let table = Table::builder("restitution.curves", ensembles, |one| one.ensemble.realisations)
        .table_computed_by(origin(Curve::new))
        .key("r", "1", |one| one.ensemble.chain.restitution)
        .estimate("half_height", SIGMA, HALF_HEIGHT, half_height_all);
    vec![table.done()]
}
