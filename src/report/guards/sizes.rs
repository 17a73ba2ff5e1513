//! Half heights by length and transient.

use super::chains::{crossing, share};
use super::{Guard, Look, far, room, unless};
use crate::experiments::chains::Curve;
use crate::params::ChainCurve;

pub const GUARDS: &[Guard] = &[
    Guard { name: "sizes_on_curves", ids: &["sizes.t*"], find: places },
    Guard { name: "sizes_fall", ids: &["sizes.t*"], find: falls },
    Guard { name: "sizes_as_run", ids: &["sizes.n*", "sizes.t*"], find: as_run },
];

/// Half heights follow from the counts, and leads from half heights.
fn places(look: Look<'_>) -> Option<String> {
    let found = look.results.sizes().ok()?;
    let half = |(own, curve): (&ChainCurve, &Curve)| {
        let of = |row| (share(found, own, row, 0), row);
        let points: Vec<(f64, f64)> =
            curve.rows.iter().map(of).map(|(share, row)| (row.sigma, share)).collect();
        crossing(&points, 0.5)
    };
    let longest = found.all().map(|(own, _)| own.masses).max()?;
    found.all().find_map(|(own, curve)| {
        let place = half((own, curve))?;
        let id = format!("sizes.t{}_n{}", own.transients[0], own.masses);
        let mut all = found.all();
        let last = all.find(|(a, _)| (a.masses, &a.transients) == (longest, &own.transients))?;
        let lead = || look.is(&format!("{id}_lead"), place - half(last)?);
        far("a half height", curve.half_heights[0]?.value, place)
            .or_else(|| look.is(&id, place))
            .or_else(|| lead().filter(|_| own.masses < longest))
    })
}

/// A longer transient gives impacts more time to spread, at every length: the half height falls with it, but for its error.
fn falls(look: Look<'_>) -> Option<String> {
    let found = look.results.sizes().ok()?;
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

/// The table has what was run, with the window of the main sweep.
fn as_run(look: Look<'_>) -> Option<String> {
    let found = look.results.sizes().ok()?;
    let window = look.results.sweep().ok()?.parameters.protocol.window;
    let head = |(own, curve): (&ChainCurve, &Curve)| {
        let ran = |row: &crate::experiments::chains::Ensemble| row.runs.len() + row.failed as usize;
        let all = curve.rows.iter().all(|row| ran(row) == own.realisations);
        look.is(&format!("sizes.n{}", own.masses), own.masses as f64)
            .or_else(|| look.is(&format!("sizes.t{}", own.transients[0]), own.transients[0]))
            .or_else(|| unless(all, || format!("other numbers of runs of {}", own.name)))
    };
    found
        .all()
        .find_map(head)
        .or_else(|| unless(window == found.parameters.window, || "another window".into()))
}
