//! Lengths and transients: what chance must not break.

use super::{Guard, Look, room, unless};
use crate::experiments::SIZES;
use crate::experiments::starts::half_height;

pub const GUARDS: &[Guard] = &[Guard { name: "sizes_fall", ids: &["sizes.places*"], find: falls }];

/// A longer transient gives impacts more time to spread, at every length: the half height falls with it, but for its error.
fn falls(look: Look<'_>) -> Option<String> {
    let found = look.results.of(&SIZES).ok()?;
    found.iter().flat_map(|early| found.iter().map(move |late| (early, late))).find_map(
        |(early, late)| {
            let (before, after) = half_height(early).zip(half_height(late))?;
            let later = early.ensemble.chain.masses == late.ensemble.chain.masses
                && early.first().protocol.transient < late.first().protocol.transient;
            unless(!later || after.value <= before.value + room(&before, &after), || {
                format!("rise at {} after {}", after.value, before.value)
            })
        },
    )
}
