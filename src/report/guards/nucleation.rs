//! Chains with a gap that closes by itself: what chance must not break.

use super::{Guard, Look, unless};
use crate::experiments::NUCLEATION;

pub const GUARDS: &[Guard] =
    &[Guard { name: "first_impacts_as_expected", ids: &["nucleation.chains"], find: as_expected }];

/// What the formula leaves out, times n: a clump keeps others out of the gaps beside it, which moves the share
/// by some gaps of n times λ²e^{−λ}/2.
const LEFT_OUT: f64 = 1.5;

/// As many chains have an impact as are expected to, but for what the formula leaves out and chance: five standard errors,
/// and five chains where hardly any is expected.
fn as_expected(look: Look<'_>) -> Option<String> {
    let chains = look.results.table("nucleation.chains").ok()?;
    let parameters = &look.results.of(&NUCLEATION).ok()?.parameters;
    parameters.lengths.iter().find_map(|(masses, n)| {
        let (keys, n) = ([("masses", *masses as f64)], *n as f64);
        chains.points(&keys, "clumps", "found").into_iter().find_map(|(p, found)| {
            let room = LEFT_OUT / *masses as f64 + 5.0 * (p * (1.0 - p) / n).sqrt() + 5.0 / n;
            unless((found - p).abs() <= room, || {
                format!("{found} of the chains, {p} expected at {masses} masses")
            })
        })
    })
}
