//! What restitution does to a chain: where it rises, and how often masses come in contact.

use super::starts::half_height;
use crate::experiments::prelude::*;
use impact_chain::rise::RisePoint;

/// All tables.
pub fn tables(found: &Vec<Counted>) -> Vec<Table> {
    let restitution = |own: &Counted| own.ensemble.chain.restitution;
    let mut rows: Vec<(&Counted, &RisePoint)> = Vec::new();
    for own in found {
        rows.extend(own.first().rows.iter().map(|row| (own, row)));
    }
    let rise = Table::of("restitution.rise", &rows, |(_, row)| row.ran)
        .key("r", "1", |(own, _)| restitution(own))
        .key("sigma", SIGMA, |(_, row)| row.sigma)
        .computed_by(origin(RisePoint::new))
        .estimate("phases_per_impact", "1", "contact phases over impacts", |(_, row)| {
            row.phases_per_impact
        })
        .count("phases", "contact phases", |(_, row)| row.phases)
        .done();
    let curves = Table::of("restitution.curves", found, |own| own.ensemble.realisations)
        .key("r", "1", restitution)
        .computed_by(origin(Curve::new))
        .estimate(
            "half_height",
            SIGMA,
            "σ where the mean count of all chains passes half of all gaps",
            half_height,
        )
        .done();
    vec![rise, curves]
}
