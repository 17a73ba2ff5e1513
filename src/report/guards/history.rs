//! What the past of a chain does to the count.

use super::{Guard, Look, unless};

pub const GUARDS: &[Guard] =
    &[Guard { name: "no_seed_without_a_past", ids: &["history.*"], find: more_than_rest }];

/// Who was heated has at least as many impacts as who starts from rest, but for chance: five standard
/// errors of both.
fn more_than_rest(look: Look<'_>) -> Option<String> {
    let rest = look.results.table("history.from_rest").ok()?;
    let lowered = look.results.table("history.lowered").ok()?;
    let first = *lowered.values("transient").first()?;
    let heated = lowered.estimates(&[("transient", first)], "sigma", "mean_count");
    rest.estimates(&[], "sigma", "mean_count").into_iter().find_map(|(sigma, rest)| {
        let (_, own) = heated.iter().find(|(other, _)| *other == sigma)?;
        let room = 5.0 * (rest.error * rest.error + own.error * own.error).sqrt();
        unless(own.value >= rest.value - room, || {
            format!("{} after heating, {} from rest, at {sigma}", own.value, rest.value)
        })
    })
}
