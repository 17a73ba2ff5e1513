//! The long map that is carried over.

use super::places::between;
use super::protocol::heads;
use super::{Guard, Look, far, model, room, unless};
use crate::claims;
use crate::experiments::long::LongRow;
use crate::experiments::protocol::ProtocolCell;
use crate::experiments::rise::ONSET;
use crate::numerics::statistics::Estimate;
use std::cmp::Ordering;

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "long_half_heights",
        ids: &[
            "long.kept_*",
            "long.all_*",
            "long_kept",
            "long_all",
            "long_onset",
            "long_realisations",
            "long_sigma_count",
            "protocols.*",
        ],
        find: half_heights,
    },
    Guard { name: "long_map_meets_map", ids: &["long.kept_*", "long.all_*"], find: meets_map },
    Guard { name: "long_map_falls", ids: &["long.kept_*", "long.all_*"], find: falls },
    Guard {
        name: "long_map_needs_seeds",
        ids: &["long.all_*", "long_all", "long_onset"],
        find: needs_seeds,
    },
    Guard {
        name: "long_map_ends",
        ids: &[
            "long_kept",
            "long_all",
            "long_onset",
            "long_until",
            "long_window",
            "long.t*",
            "long.w*",
        ],
        find: ends,
    },
];

/// The places of a cell: the half heights of the mean of the kept and of that of all, the onset, and where
/// half of the chains are kept.
fn places(cell: &ProtocolCell) -> [Option<Estimate>; 4] {
    [cell.half_height, cell.half_height_all, cell.onset, cell.kept_half]
}

/// Where both maps have a cell, their places of the rise agree within the errors of both: they drew
/// other random numbers.
fn meets_map(look: Look<'_>) -> Option<String> {
    let long = &look.results.long_protocol().ok()?.map;
    let map = look.results.protocol().ok()?;
    long.cells.iter().find_map(|cell| {
        let other = map.cell(cell.transient, cell.window)?;
        places(cell).into_iter().zip(places(other)).find_map(|pair| {
            let (own, other) = pair.0.zip(pair.1)?;
            unless((own.value - other.value).abs() <= room(&own, &other), || {
                format!("rise at {} in the long map, at {} in the map", own.value, other.value)
            })
        })
    })
}

/// A longer transient gives impacts more time to spread, and a longer window counts no fewer gaps:
/// the half height falls with both, but for its error.
fn falls(look: Look<'_>) -> Option<String> {
    let map = &look.results.long_protocol().ok()?.map;
    map.cells.iter().flat_map(|early| map.cells.iter().map(move |late| (early, late))).find_map(
        |(early, late)| {
            let later = early.transient <= late.transient && early.window <= late.window;
            places(early).into_iter().zip(places(late)).find_map(|pair| {
                let (before, after) = pair.0.zip(pair.1)?;
                unless(!later || after.value <= before.value + room(&before, &after), || {
                    format!("rise at {} after {}", after.value, before.value)
                })
            })
        },
    )
}

/// At a half height the curve through the means has half its height, at an onset a twentieth. Means
/// are sums of whole counts over the number of realisations, and the mean of the kept is the same sum
/// over fewer. There is a row for each sigma.
fn half_heights(look: Look<'_>) -> Option<String> {
    let long = look.results.long_protocol().ok()?;
    let (map, gaps) = (&long.map, long.map.parameters.chain.gaps() as f64);
    let n = map.parameters.realisations as f64;
    map.cells.iter().enumerate().find_map(|(index, cell)| {
        let share = |row: &LongRow| Some((row.sigma, *row.kept.get(index)? as f64 / n));
        let shares: Vec<(f64, f64)> = long.rows.iter().filter_map(share).collect();
        let curve = |of: fn(usize, f64) -> f64| -> Vec<(f64, f64)> {
            let mean = |row: &LongRow| {
                let sum = row.means.get(index).copied().flatten()? * n;
                Some((row.sigma, sum / of(*row.kept.get(index)?, n)))
            };
            long.rows.iter().filter_map(mean).filter(|point| point.1.is_finite()).collect()
        };
        let whole = |point: &(f64, f64)| {
            let sum = point.1 * n;
            far("a sum of counts in the long map", sum, sum.round())
        };
        let at = |place: Option<Estimate>, points: &[(f64, f64)], height: f64| {
            let sigma = place?.value;
            match between(points, sigma) {
                Some(found) => far(&format!("the long curve at {sigma}"), found, height),
                None => Some(format!("{sigma} lies outside the long curve")),
            }
        };
        let all = curve(|_, n| n);
        all.iter()
            .find_map(whole)
            .or_else(|| look.is("long_sigma_count", long.rows.len() as f64))
            .or_else(|| at(cell.half_height, &curve(|kept, _| kept as f64), 0.5 * gaps))
            .or_else(|| at(cell.half_height_all, &all, 0.5 * gaps))
            .or_else(|| at(cell.onset, &all, ONSET * gaps))
            .or_else(|| at(cell.kept_half, &shares, 0.5))
    })
}

/// A chain has no impacts unless a gap closes by itself, however long the transient: the share of the
/// chains that have some is nowhere larger than that of those in which one does, but for its error.
/// The mean over all is at most N times that share: it is half of N no sooner than the share is a half,
/// and has its onset no sooner than the share is a twentieth.
fn needs_seeds(look: Look<'_>) -> Option<String> {
    let long = look.results.long_protocol().ok()?;
    let (parameters, quantile) = (&long.map.parameters, claims::level().quantile);
    let n = parameters.realisations as f64;
    let seeded = |sigma: f64| model::any(model::p_rest(sigma), parameters.chain.gaps() as f64);
    let shares = long.rows.iter().find_map(|row| {
        let seeds = seeded(row.sigma);
        let most = n * seeds + quantile * (n * seeds * (1.0 - seeds)).sqrt();
        let kept = row.kept.iter().copied().max()?;
        unless(kept as f64 <= most, || {
            format!("{kept} chains with impacts at {}, where {most} can have seeds", row.sigma)
        })
    });
    let half = look.number("theory.relation.sigma_kept_half")?;
    let onset = look.number("theory.relation.sigma_kept_onset")?;
    let sooner = |place: Option<Estimate>, bound: f64| {
        let own = place?;
        unless(own.value >= bound - quantile * own.error, || {
            format!("rise at {}, where too few have seeds below {bound}", own.value)
        })
    };
    let rises = || {
        long.map.cells.iter().find_map(|cell| {
            sooner(cell.half_height_all, half)
                .or_else(|| sooner(cell.kept_half, half))
                .or_else(|| sooner(cell.onset, onset))
        })
    };
    shares.or_else(rises)
}

/// The heads of the table are the times of its cells, and the text gives the last of them.
fn ends(look: Look<'_>) -> Option<String> {
    let map = &look.results.long_protocol().ok()?.map;
    let late = |a: &&ProtocolCell, b: &&ProtocolCell| {
        (a.transient, a.window).partial_cmp(&(b.transient, b.window)).unwrap_or(Ordering::Equal)
    };
    let last = map.cells.iter().max_by(late)?;
    let times = |pick: fn(&ProtocolCell) -> f64| map.cells.iter().map(pick).collect();
    heads(look, "long.t", times(|cell| cell.transient))
        .or_else(|| heads(look, "long.w", times(|cell| cell.window)))
        .or_else(|| look.are([("long_until", last.transient), ("long_window", last.window)]))
        .or_else(|| look.is("long_kept", last.half_height?.value))
        .or_else(|| look.is("long_all", last.half_height_all?.value))
        .or_else(|| look.is("long_onset", last.onset?.value))
}
