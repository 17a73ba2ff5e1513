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
        .estimate("mean_count", "1", "different gaps with an impact, mean of all", |(_, row)| {
            row.mean_all?.estimate()
        })
        .estimate(
            "impacts",
            "omega",
            "impacts per unit of time, of chains with any",
            |(own, row)| {
                let (impacts, time) = (row.impacts?, own.first().protocol.window);
                Some(with_error(impacts.value / time, impacts.error? / time))
            },
        )
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
    let all = Table::of("restitution.all", &[()], |()| found[0].ensemble.realisations)
        .count("realisations", "chains at each r and σ", |()| {
            found[0].ensemble.realisations as u64
        })
        .count("sigmas", "values of σ", |()| found[0].ensemble.sigmas.len() as u64)
        .estimate("shift", SIGMA, "half height at the last r less that at the first", |()| {
            Some(difference(half_height(found.last()?)?, half_height(found.first()?)?))
        })
        .chosen("touched_to", "1", "the largest r with a contact phase", |()| {
            rows.iter().rfind(|(_, row)| row.phases > 0).map(|(own, _)| restitution(own))
        })
        .done();
    vec![rise, curves, all]
}
