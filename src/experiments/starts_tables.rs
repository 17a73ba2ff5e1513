//! Tables of other starts, ends, restitutions and frequencies.

use super::Results;
use super::starts::{Starts, Variant};
use super::{rise, sweep};
use crate::experiments::STARTS;
use crate::params::COMPARABLE_REJECTED;
use impact_numerics::estimates::difference;
use impact_numerics::statistics::Estimate;
use literate::table::Table;
use literate::value::origin;

/// All tables.
pub fn tables(starts: &Starts) -> Vec<Table> {
    let realisations = starts.parameters.realisations;
    let half = |variant: &Variant| variant.rise.half_height_all;
    let rest = starts.variant("rest").and_then(half);
    let variants = Table::of("starts.variants", &starts.variants, |_| realisations)
        .text_key("chain", |variant| variant.name.clone())
        .chosen("restitution", "1", "", |variant| Some(variant.chain.restitution))
        .chosen("forcing_frequency", "omega", "", |variant| Some(variant.chain.forcing_frequency))
        .computed_by(origin(rise::find))
        .estimate(
            "half_height",
            "d omega^2",
            "σ where the mean of all passes half of all gaps",
            half,
        )
        .estimate("difference", "d omega^2", "half height less that from rest", |variant| {
            Some(difference(half(variant)?, rest?))
        })
        .done();
    let last = starts.variant("random").and_then(|random| random.rows.last());
    let all = Table::of("starts.all", &[last], |_| last.map_or(0, |row| row.realisations))
        .count("realisations", "chains at each σ", |_| realisations as u64)
        .chosen(
            "most_rejected",
            "1",
            "share of overlapping starts up to which a row is used",
            |_| Some(COMPARABLE_REJECTED),
        )
        .chosen("rejected_at", "d omega^2", "the last σ of random starts", |last| {
            last.map(|row| row.sigma)
        })
        .computed_by(origin(sweep::reduce))
        .estimate("rejected", "1", "share of the random starts there that overlap", |last| {
            last.and_then(|row| {
                impact_numerics::estimates::share(row.rejected as u64, row.realisations as u64)
            })
        })
        .done();
    vec![variants, all]
}

/// What of the distance to the theory the start explains.
pub fn beside_theory(results: &Results, all: &[Table]) -> Option<Vec<Table>> {
    let starts = results.of(&STARTS).ok()?;
    let half = |name: &str| starts.variant(name).and_then(|own| own.rise.half_height_all);
    let relation = all.iter().find(|table| table.name() == "theory.relation")?;
    let theory = relation.number(&[], "sigma_half").ok()?;
    let table = Table::of("starts.beside_theory", &[()], |()| 0)
        .computed_by(origin(share_of_start))
        .real(
            "share",
            "1",
            2,
            "of the distance from rest to the theory, with random free parts",
            |()| {
                let both: Option<(Estimate, Estimate)> = half("rest").zip(half("random"));
                both.map_or(f64::NAN, |(rest, random)| {
                    share_of_start(rest.value, random.value, theory)
                })
            },
        )
        .done();
    Some(vec![table])
}

/// How much of the distance between theory and simulation the start explains: half heights from
/// rest, from random free parts, and of the theory.
pub fn share_of_start(rest: f64, random: f64, theory: f64) -> f64 {
    (random - rest) / (theory - rest)
}
