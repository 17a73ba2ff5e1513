//! Lengths and transients: what chance must not break.

use super::{Guard, Look, room, unless};
use crate::experiments::SIZES;

pub const GUARDS: &[Guard] = &[Guard { name: "sizes_fall", ids: &["sizes.places*"], find: falls }];

/// A longer transient gives impacts more time to spread, at every length: the half height falls with it, but for its error.
fn falls(look: Look<'_>) -> Option<String> {
    let found = look.results.of(&SIZES).ok()?;
    found.all().flat_map(|early| found.all().map(move |late| (early, late))).find_map(
        |((a, early), (b, late))| {
            let (before, after) = early.half_heights[0].zip(late.half_heights[0])?;
            let later = a.masses == b.masses && a.transients[0] < b.transients[0];
            unless(!later || after.value <= before.value + room(&before, &after), || {
                format!("rise at {} after {}", after.value, before.value)
            })
        },
    )
}
