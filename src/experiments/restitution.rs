//! What restitution does to a chain: where it rises.

use super::starts::{HALF_HEIGHT, half_height};
use crate::experiments::prelude::*;

/// All tables.
pub fn tables(found: &Vec<Counted>) -> Vec<Table> {
    let restitution = |own: &Counted| own.ensemble.chain.restitution;
    let table = Table::of("restitution.curves", found, |own| own.ensemble.realisations)
        .key("r", "1", restitution)
        .computed_by(origin(Curve::new))
        .estimate("half_height", SIGMA, HALF_HEIGHT, half_height)
        .done();
    vec![table]
}
