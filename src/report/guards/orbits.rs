//! Periodic orbits from circuits: what rounding and chance must not break.

use super::{Guard, Look, far, unless};
use crate::experiments::orbits::Found;

pub const GUARDS: &[Guard] = &[
    Guard { name: "multipliers_shrink_volume", ids: &["orbits.figures*"], find: volume },
    Guard { name: "orbits_of_one_gap", ids: &["orbits.rows*"], find: single },
];

/// An impact takes r² of a volume, whatever the orbit: so do the multipliers in their product, the
/// neutral ones being on the unit circle. The largest is the radius.
fn volume(look: Look<'_>) -> Option<String> {
    let orbits = look.results.orbits().ok()?;
    let r = orbits.parameters.chain.restitution;
    let wrong = |multipliers: &[[f64; 2]], radius: f64, k: usize| {
        let moduli: Vec<f64> = multipliers.iter().map(|[x, y]| (x * x + y * y).sqrt()).collect();
        let (product, expected) =
            (moduli.iter().product::<f64>(), (0..2 * k).fold(1.0, |product, _| product * r));
        let off = (product / expected - 1.0).abs();
        unless(off < DIGITS, || format!("multipliers multiply to {product}, not {expected}"))
            .or_else(|| far("a radius", radius, moduli.iter().copied().fold(0.0, f64::max)))
    };
    let found = |f: &Found| wrong(&f.multipliers, f.radius, orbits.circuits[f.circuit].len());
    let best = || {
        orbits.hunts.iter().find_map(|hunt| {
            let best = hunt.best.as_ref()?;
            wrong(&best.multipliers, best.radius, hunt.circuit.len())
        })
    };
    orbits.rows.iter().flat_map(|row| &row.found).find_map(found).or_else(best)
}

/// What rounding leaves of a product of large and small multipliers.
const DIGITS: f64 = 1e-5;

/// As many gaps have a solution of the equations of one gap as the formula says: four standard errors, twice
/// those of independent gaps, for neighbours share a force.
fn single(look: Look<'_>) -> Option<String> {
    let rows = look.results.table("orbits.rows").ok()?;
    let expected = rows.points(&[], "sigma", "single_expected");
    let found = rows.estimates(&[], "sigma", "single");
    found.into_iter().zip(expected).find_map(|((sigma, own), (_, expected))| {
        let gaps = 1.0 / (own.error * own.error).max(1e-300) * own.value * (1.0 - own.value);
        let room = 8.0 * (expected * (1.0 - expected) / gaps).sqrt() + 1.0 / gaps;
        unless((own.value - expected).abs() < room, || {
            format!("{} of the gaps have a solution at {sigma}, where {expected} should", own.value)
        })
    })
}
