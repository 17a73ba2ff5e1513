//! How hot a running chain is: what chance must not break.

use super::model;
use super::{Guard, Look, far, unless};

pub const GUARDS: &[Guard] = &[
    Guard { name: "energy_kept_in_books", ids: &["heat.*"], find: balance },
    Guard { name: "p_of_hot_chains", ids: &["heat.*"], find: p },
    Guard { name: "closed_heat_near_runs", ids: &["heat.rising"], find: closed },
];

/// What the free parts of a chain gain in the window is what impacts gave them.
fn balance(look: Look<'_>) -> Option<String> {
    let books = |name: &'static str, key: &str| {
        let table = look.results.table(name).ok()?;
        table.points(&[], key, "imbalance").into_iter().find_map(|(at, off)| {
            unless(off.abs() <= super::ROUNDING, || {
                format!("energy is off by {off} of what impacts took at {key} = {at} of {name}")
            })
        })
    };
    let tables = [("heat.rising", "sigma"), ("heat.others", "r"), ("heat.ring", "sigma")];
    tables.into_iter().find_map(|(name, key)| books(name, key))
}

/// Probabilities by integrals: those of the table, and p with the balanced variance at the jump.
fn p(look: Look<'_>) -> Option<String> {
    let table = look.results.table("heat.rising").ok()?;
    let one = |sigma: f64| {
        let of = |column| table.number(&[("sigma", sigma)], column).ok();
        far("p of a hot chain", of("p_balanced")?, model::p_heated(sigma, of("balanced")?))
    };
    let jump = || {
        let all = look.results.table("heat.all").ok()?;
        let ratio = *table.values("balanced").first()?;
        let p = model::p_heated(all.number(&[], "sigma_jump").ok()?, ratio);
        far("p at the hot jump", p, look.results.theory.scalars_walls.p_jump)
    };
    table.values("sigma").into_iter().find_map(one).or_else(jump)
}

/// How far the closed theory may be from the variance that is found, relative to it, at the paper's restitution.
const ASSUMED: f64 = 0.08;

/// The closed theory finds the variance of the free parts, but for what it assumes and chance: five standard errors.
fn closed(look: Look<'_>) -> Option<String> {
    let table = look.results.table("heat.rising").ok()?;
    ["closed_over_hit", "closed_over_all"].into_iter().find_map(|column| {
        table.estimates(&[], "sigma", column).into_iter().find_map(|(sigma, own)| {
            unless((own.value - 1.0).abs() <= ASSUMED + 5.0 * own.error, || {
                format!("the variance is {} of what is found, {column} at {sigma}", own.value)
            })
        })
    })
}
