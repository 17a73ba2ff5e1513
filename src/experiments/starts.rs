//! Finds half heights of chains with another start, another Ω, or a ring in place of walls.

use crate::experiments::prelude::*;

pub const STARTS: Ensembles = ensembles("starts", "variants", params::starts, tables);

pub fn tables(variants: &Vec<Counted>) -> Vec<Table> {
    let rest = find_ensemble(variants, "rest").and_then(half_height_all);
    let less = |one: &Counted| Some(difference(half_height_all(one)?, rest?));
    let half_height = |one: &Counted| one.first_curve().rise.half_height;
    let table = Table::builder("starts.variants", variants, |one| one.ensemble.realisations)
        .text_key("chain", |one| one.ensemble.name.clone())
        .count("realisations", "chains at each σ", |one| one.ensemble.realisations as u64)
        .chosen("forcing_frequency", "omega", "", |one| Some(one.ensemble.chain.forcing_frequency))
        .estimate("half_height", SIGMA, HALF_HEIGHT, half_height_all)
        .estimate("half_height_of_active", SIGMA, OF_ACTIVE, half_height)
        .estimate("difference", SIGMA, "half height less that from rest", less)
        .computed_by(origin(Curve::new), &["half_height", "half_height_of_active", "difference"])
        .done();
    vec![table]
}

/// Makes the table of the part of the distance to the theory that the start explains: for chains
/// with an impact, which the theory counts and the paper plots, and for all.
pub fn against_theory(results: &Results, computed: &[Table]) -> Option<Vec<Table>> {
    let starts = results.of(&STARTS).ok()?;
    let relation = computed.iter().find(|table| table.name() == "theory.relation")?;
    let theory = relation.number(&[], "sigma_half").ok()?;
    let share = |place: fn(&Counted) -> Option<Estimate>| {
        let [rest, random] = ["rest", "random"].map(|name| place(find_ensemble(starts, name)?));
        Some(share_of_start(rest?, random?, theory))
    };
    const SHARE: &str = "of the distance from rest to the theory, with random free parts";
    let chains = find_ensemble(starts, "rest")?.ensemble.realisations;
    let table = Table::builder("starts.against_theory", &[()], |()| chains)
        .table_computed_by(origin(share_of_start))
        .estimate("share", "1", SHARE, |()| share(|one| one.first_curve().rise.half_height))
        .estimate("share_of_all", "1", "the same by the mean of all", |()| share(half_height_all));
    Some(vec![table.done()])
}

/// Returns the part that the start explains of the distance between theory and simulation.
pub fn share_of_start(rest: Estimate, random: Estimate, theory: f64) -> Estimate {
    let (moved, distance) = (difference(random, rest), theory - rest.value);
    with_error(moved.value / distance, moved.error / distance)
}
