//! Long chains and other forces: what was derived of them, and what chance must not break.

use super::{Guard, Look, model, room, unless};
use crate::experiments::chains::{Curve, Ensemble};
use crate::experiments::{CHAINS, SIZES};
use crate::params::ChainCurve;

pub const GUARDS: &[Guard] = &[
    Guard { name: "chains_silent", ids: &["chains.all*"], find: silent },
    Guard { name: "chains_by_expectation", ids: &["chains.frequencies*"], find: expected },
    Guard { name: "sizes_fall", ids: &["sizes.places*"], find: falls },
];

/// A chain with an open gap has impacts in every late window: that is the proposition, for time without
/// end, and a long one that was run. The number of open gaps follows the law of amplitudes.
fn silent(look: Look<'_>) -> Option<String> {
    let found = look.results.of(&CHAINS).ok()?;
    let mut rows = found.curves.iter().flat_map(|curve| &curve.rows);
    let (own, curve) = found.curve("silence")?;
    // Neighbours share a force: twice the error of independent gaps is more than enough.
    let law = |row: &Ensemble| {
        let n = row.runs.len() as f64;
        let inner = model::rayleigh_above(1.0, row.sigma * std::f64::consts::SQRT_2);
        let wall = model::rayleigh_above(1.0, row.sigma);
        let expected = (own.masses as f64 - 1.0) * inner + 2.0 * wall;
        let mean = row.runs.iter().map(|run| f64::from(run.open)).sum::<f64>() / n;
        unless((mean - expected).abs() <= 10.0 * (expected / n).sqrt() + 5.0 / n, || {
            format!("{mean} open gaps a chain, not {expected}, at {}", row.sigma)
        })
    };
    let quiet = |row: &Ensemble| {
        unless(row.silent[0] == 0, || format!("an open gap is silent at {}", row.sigma))
    };
    rows.find_map(quiet).or_else(|| curve.rows.iter().find_map(law))
}

/// With all phases more gaps close than with those that there are, and of these the simulated chains have as many as
/// chance allows: five standard errors, and as much as the clumps of neighbouring gaps are off.
fn expected(look: Look<'_>) -> Option<String> {
    let one = |(_, curve): (&ChainCurve, &Curve)| {
        let more = || {
            let more = curve.kept_expected.iter().find(|row| row[2] > row[1] * (1.0 + 1e-12));
            more.map(|row| format!("a common period lets more gaps close at {}", row[0]))
        };
        let points: Vec<_> = curve.kept_expected.iter().map(|row| (row[0], row[2])).collect();
        let chance = |row: &Ensemble| {
            let expected = between(&points, row.sigma)?;
            let n = row.runs.len() as f64;
            let share = 1.0 - (row.silent[0] + row.silent[1]) as f64 / n;
            let room = 5.0 * (expected * (1.0 - expected) / n).sqrt() + 0.05 + 1.0 / n;
            unless((share - expected).abs() <= room, || {
                format!("{share} of the chains have impacts, not {expected}, at {}", row.sigma)
            })
        };
        curve.rows.iter().find_map(chance).or_else(more)
    };
    look.results.of(&CHAINS).ok()?.all().find_map(one)
}

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

/// Between the points of a curve on both sides of σ, in a straight line.
fn between(points: &[(f64, f64)], sigma: f64) -> Option<f64> {
    let above = points.iter().position(|point| point.0 >= sigma)?;
    let (b, a) = (points[above], points[above.checked_sub(1)?]);
    Some(((b.0 - sigma) * a.1 + (sigma - a.0) * b.1) / (b.0 - a.0))
}
