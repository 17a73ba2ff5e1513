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
    Guard { name: "maps_need_seeds", ids: &["protocols.kept_*"], find: need_seeds },
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

/// What the report calls the places of a cell: half height and onset of the mean of all, and where half
/// of the chains are kept.
fn places(cell: &ProtocolCell) -> [(&'static str, Option<Estimate>); 3] {
    [("half", cell.half_height_all), ("onset", cell.onset), ("kept", cell.kept_half)]
}

/// All maps, that of the paper's chain first.
fn maps<'a>(look: Look<'a>) -> impl Iterator<Item = (&'a str, &'a ProtocolMap)> {
    let rest = look.results.protocol.iter().map(|map| ("rest", map));
    rest.chain(look.results.protocols.iter().flat_map(|all| all.named()))
}

/// At a half height the curve through the means of all has half its height, at the onset a twentieth,
/// and that through the shares of the kept a half where half are; and these are the numbers that the report
/// shows.
fn on_curves(look: Look<'_>) -> Option<String> {
    let found = maps(look).find_map(|(name, map)| {
        let gaps = map.parameters.chain.gaps() as f64;
        map.cells.iter().find_map(|cell| {
            let means = map.curve(cell.transient, cell.window)?;
            let kept = map.kept_curve(cell.transient, cell.window)?;
            let levels = [
                (&means, cell.half_height_all, 0.5 * gaps),
                (&means, cell.onset, ONSET * gaps),
                (&kept, cell.kept_half, 0.5),
            ];
            let mut on_curve = levels.into_iter().filter_map(|(points, place, level)| {
                let sigma = place?.value;
                let what = format!(
                    "the curve of {name}, {} and {} at {sigma}",
                    cell.transient, cell.window
                );
                match between(points, sigma) {
                    Some(found) => far(&what, found, level),
                    None => Some(format!("{what} is not there")),
                }
            });
            on_curve.next().or_else(|| all_shown(look, name, cell))
        })
    });
    // The curves of the long end have a guard of their own.
    found.or_else(|| {
        let (map, long) = (look.results.protocol.as_ref()?, look.results.long_protocol.as_ref()?);
        long.beyond(map).find_map(|cell| all_shown(look, "rest", cell))
    })
}

/// Complains if a place of a cell that the report has is another number there.
fn all_shown(look: Look<'_>, name: &str, cell: &ProtocolCell) -> Option<String> {
    places(cell).into_iter().find_map(|(column, place)| {
        let (t, w) = (cell.transient as u64, cell.window as u64);
        let id = format!("protocols.{column}_{name}_t{t}_w{w}");
        look.number(&id).and_then(|_| look.is(&id, place?.value))
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
                let ((_, before), (_, after)) = pair;
                let (before, after) = before.zip(after)?;
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
    let (starts, all) = look.results.starts.as_ref().zip(look.results.protocols.as_ref())?;
    let protocol = starts.parameters.protocol;
    all.named().find_map(|(name, map)| {
        let other = starts.variant(name)?.rise;
        let cell = map.cell(protocol.transient, protocol.window)?;
        let others = [other.half_height_all, other.onset, other.kept_half];
        places(cell).into_iter().zip(others).find_map(|((_, own), other)| {
            let (own, other) = own.zip(other)?;
            unless((own.value - other.value).abs() <= room(&own, &other), || {
                format!("{name}: {} in its map, {} by itself", own.value, other.value)
            })
        })
    })
}

/// No more chains have impacts than have a gap that closes by itself: where half of them do, that has a
/// chance of a half at least, but for errors.
fn need_seeds(look: Look<'_>) -> Option<String> {
    let quantile = claims::level().quantile;
    maps(look).find_map(|(name, map)| {
        let chain = &map.parameters.chain;
        let seeded = |sigma| model::any(model::p_of_start(chain.start, sigma), chain.gaps() as f64);
        map.cells.iter().filter_map(|cell| cell.kept_half).find_map(|own| {
            unless(seeded(own.value + quantile * own.error) >= 0.5, || {
                format!("{name}: half of the chains at {}, where too few have seeds", own.value)
            })
        })
    })
}

/// The heads of the tables are the times of the maps, all of which have as many chains.
fn ends(look: Look<'_>) -> Option<String> {
    let all = look.results.protocols.as_ref()?;
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
            let all = || all.maps.iter().flat_map(|map| &map.cells);
            let least = |of: fn(&ProtocolCell) -> f64| all().map(of).fold(f64::MAX, f64::min);
            let most = |of: fn(&ProtocolCell) -> f64| all().map(of).fold(0.0, f64::max);
            let of = |pick: &dyn Fn(fn(&ProtocolCell) -> f64) -> f64| {
                let (t, w) = (pick(|cell| cell.transient), pick(|cell| cell.window));
                look.number(&format!("protocols.kept_rest_t{t}_w{w}"))
            };
            let late = || look.is("protocols.kept_late", of(&most)?);
            look.is("protocols.kept_soon", of(&least)?).or_else(late)
        })
}
