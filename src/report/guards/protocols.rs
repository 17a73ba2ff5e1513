//! The maps over transients and windows for other starts and ends.

use super::places::between;
use super::protocol::heads;
use super::{Guard, Look, far, model, room, unless};
use crate::claims;
use crate::experiments::protocol::{ProtocolCell, ProtocolMap};
use crate::experiments::rise::ONSET;
use crate::numerics::statistics::Estimate;

pub const GUARDS: &[Guard] = &[
    Guard { name: "maps_on_curves", ids: &["protocols.*"], find: on_curves },
    Guard { name: "maps_fall", ids: &["protocols.*"], find: fall },
    Guard { name: "maps_meet_starts", ids: &["protocols.*"], find: meet_starts },
    Guard { name: "maps_need_seeds", ids: &["protocols.*"], find: need_seeds },
    Guard {
        name: "heads_of_the_maps",
        ids: &[
            "protocols.t*",
            "protocols.w*",
            "protocols_realisations",
            "protocols.kept_soon",
            "protocols.kept_late",
        ],
        find: ends,
    },
];

/// A place of a cell, by the name that the report has for it.
struct Place {
    column: &'static str,
    at: Option<Estimate>,
    /// The share of N that the mean of all has there, or the share of the chains that are kept.
    level: f64,
    of_chains: bool,
}

/// Half height and onset of the mean of all, and where half of the chains are kept.
fn places(cell: &ProtocolCell) -> [Place; 3] {
    [
        Place { column: "half", at: cell.half_height_all, level: 0.5, of_chains: false },
        Place { column: "onset", at: cell.onset, level: ONSET, of_chains: false },
        Place { column: "kept", at: cell.kept_half, level: 0.5, of_chains: true },
    ]
}

/// All maps, that of the paper's chain first.
fn maps<'a>(look: Look<'a>) -> impl Iterator<Item = (&'a str, &'a ProtocolMap)> {
    let rest = look.results.protocol().into_iter().map(|map| ("rest", map));
    rest.chain(look.results.protocols().into_iter().flat_map(|all| all.named()))
}

/// At a half height the curve through the means of all has half its height, at the onset a twentieth,
/// and that through the shares of the kept a half where half are; and these are the numbers that the report
/// shows.
fn on_curves(look: Look<'_>) -> Option<String> {
    let found = maps(look).find_map(|(name, map)| {
        let gaps = map.parameters.chain.gaps() as f64;
        map.cells.iter().find_map(|cell| {
            let (t, w) = (cell.transient, cell.window);
            let Some((means, kept)) = map.curve(t, w).zip(map.kept_curve(t, w)) else {
                return Some(format!("{name}: T = {t}, W = {w} has no curves"));
            };
            let on_curve = |place: Place| {
                let sigma = place.at?.value;
                let what =
                    format!("the curve of {} of {name}, {t} and {w}, at {sigma}", place.column);
                let (points, height) = match place.of_chains {
                    true => (&kept, place.level),
                    false => (&means, place.level * gaps),
                };
                match between(points, sigma) {
                    Some(found) => far(&what, found, height),
                    None => Some(format!("{what} is not there")),
                }
            };
            places(cell).into_iter().find_map(on_curve).or_else(|| all_shown(look, name, cell))
        })
    });
    // The curves of the long end have a guard of their own.
    found.or_else(|| {
        let (map, long) = (look.results.protocol().ok()?, look.results.long_protocol().ok()?);
        long.beyond(map).find_map(|cell| all_shown(look, "rest", cell))
    })
}

/// Complains if a place of a cell that the report has is another number there.
fn all_shown(look: Look<'_>, name: &str, cell: &ProtocolCell) -> Option<String> {
    places(cell).into_iter().find_map(|place| {
        let (t, w) = (cell.transient as u64, cell.window as u64);
        let id = format!("protocols.{}_{name}_t{t}_w{w}", place.column);
        look.number(&id).and_then(|_| look.is(&id, place.at?.value))
    })
}

/// Longer waiting and longer counting move the rise down, but for errors. A twentieth of the height comes
/// before its half, and so do impacts in half of the chains: no chain counts more than all gaps.
fn fall(look: Look<'_>) -> Option<String> {
    maps(look).find_map(|(name, map)| {
        let pairs = map.cells.iter().flat_map(|a| map.cells.iter().map(move |b| (a, b)));
        let falls = pairs.filter(|(a, b)| a.transient <= b.transient && a.window <= b.window);
        let mut rises = falls.filter_map(|(a, b)| {
            places(a).into_iter().zip(places(b)).find_map(|pair| {
                let (before, after) = pair.0.at.zip(pair.1.at)?;
                (after.value > before.value + room(&before, &after)).then_some((a, b))
            })
        });
        let early = map.cells.iter().find(|cell| {
            let late = |low: Option<Estimate>| {
                low.zip(cell.half_height_all).is_some_and(|(low, half)| low.value > half.value)
            };
            late(cell.onset) || late(cell.kept_half)
        });
        rises
            .next()
            .map(|(a, b)| {
                format!("{name}: later at T = {}, W = {} than {b:?}", a.transient, a.window)
            })
            .or_else(|| early.map(|cell| format!("{name}: half height too soon: {cell:?}")))
    })
}

/// In the protocol of the main sweep a map agrees with the ensemble of the same start and end, which
/// drew other random numbers, within the errors of both.
fn meet_starts(look: Look<'_>) -> Option<String> {
    let (starts, all) = look.results.starts().ok().zip(look.results.protocols().ok())?;
    let protocol = starts.parameters.protocol;
    all.named().find_map(|(name, map)| {
        let other = starts.variant(name)?.rise;
        let cell = map.cell(protocol.transient, protocol.window)?;
        let others = [other.half_height_all, other.onset, other.kept_half];
        places(cell).into_iter().zip(others).find_map(|(own, other)| {
            let (own, other) = own.at.zip(other)?;
            unless((own.value - other.value).abs() <= room(&own, &other), || {
                format!("{name}: {} in its map, {} by itself", own.value, other.value)
            })
        })
    })
}

/// No more chains have impacts than have a gap that closes by itself, and no mean of all is a larger share of
/// N than they are of the chains: where it has a height, so large a share has such a gap, but for errors.
fn need_seeds(look: Look<'_>) -> Option<String> {
    let quantile = claims::level().quantile;
    maps(look).find_map(|(name, map)| {
        let chain = &map.parameters.chain;
        let seeded = |sigma| model::any(model::p_of_start(chain.start, sigma), chain.gaps() as f64);
        map.cells.iter().flat_map(places).find_map(|place| {
            let own = place.at?;
            unless(seeded(own.value + quantile * own.error) >= place.level, || {
                format!("{name}: {} at {}, where too few have seeds", place.column, own.value)
            })
        })
    })
}

/// The heads of the tables are the times of the maps, all of which have as many chains.
fn ends(look: Look<'_>) -> Option<String> {
    let all = look.results.protocols().ok()?;
    let times = |pick: fn(&ProtocolCell) -> f64| {
        all.maps.iter().flat_map(|map| map.cells.iter().map(pick)).collect()
    };
    heads(look, "protocols.t", times(|cell| cell.transient))
        .or_else(|| heads(look, "protocols.w", times(|cell| cell.window)))
        .or_else(|| {
            all.maps.iter().find_map(|map| {
                look.is("protocols_realisations", map.parameters.realisations as f64)
            })
        })
        .or_else(|| {
            let (map, long) = (look.results.protocol().ok()?, look.results.long_protocol().ok()?);
            let cells = || map.cells.iter().chain(long.beyond(map));
            let end = |pick: fn(&ProtocolCell) -> f64, further: fn(f64, f64) -> f64| {
                all.maps.iter().flat_map(|map| map.cells.iter().map(pick)).reduce(further)
            };
            let is = |id: &str, further: fn(f64, f64) -> f64| {
                let transient = end(|cell| cell.transient, further)?;
                let window = end(|cell| cell.window, further)?;
                let own =
                    |cell: &&ProtocolCell| cell.transient == transient && cell.window == window;
                look.is(id, cells().find(own)?.kept_half?.value)
            };
            is("protocols.kept_soon", f64::min).or_else(|| is("protocols.kept_late", f64::max))
        })
}
