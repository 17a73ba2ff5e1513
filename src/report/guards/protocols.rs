//! The maps over transients and windows for other starts and ends.

use super::places::between;
use super::protocol::heads;
use super::{Guard, Look, far, room, unless};
use crate::experiments::protocol::{ProtocolCell, ProtocolMap};

pub const GUARDS: &[Guard] = &[
    Guard { name: "maps_on_curves", ids: &["protocols.*"], find: on_curves },
    Guard { name: "maps_fall", ids: &["protocols.*"], find: fall },
    Guard { name: "maps_meet_starts", ids: &["protocols.*"], find: meet_starts },
    Guard {
        name: "heads_of_the_maps",
        ids: &["protocols.t*", "protocols.w*", "protocols_realisations"],
        find: ends,
    },
];

/// All maps, that of the paper's chain first.
fn maps<'a>(look: Look<'a>) -> impl Iterator<Item = (&'a str, &'a ProtocolMap)> {
    let rest = look.results.protocol.iter().map(|map| ("rest", map));
    rest.chain(look.results.protocols.iter().flat_map(|all| all.named()))
}

/// At a half height the curve through the means of all has half its height, at the onset a twentieth;
/// and these are the numbers that the report shows.
fn on_curves(look: Look<'_>) -> Option<String> {
    let found = maps(look).find_map(|(name, map)| {
        let gaps = map.parameters.chain.gaps() as f64;
        map.cells.iter().find_map(|cell| {
            let points = map.curve(cell.transient, cell.window)?;
            let places = [("half", cell.half_height_all, 0.5), ("onset", cell.onset, 0.05)];
            places.into_iter().find_map(|(column, place, height)| {
                let sigma = place?.value;
                let id = id(column, name, cell);
                let what = format!("the curve of {id} at {sigma}");
                match between(&points, sigma) {
                    Some(found) => far(&what, found, height * gaps),
                    None => Some(format!("{what} is not there")),
                }
                .or_else(|| shown(look, &id, sigma))
            })
        })
    });
    // The curves of the long end have a guard of their own.
    found.or_else(|| {
        let (map, long) = (look.results.protocol.as_ref()?, look.results.long_protocol.as_ref()?);
        long.beyond(map).find_map(|cell| {
            let half = shown(look, &id("half", "rest", cell), cell.half_height_all?.value);
            half.or_else(|| shown(look, &id("onset", "rest", cell), cell.onset?.value))
        })
    })
}

fn id(column: &str, name: &str, cell: &ProtocolCell) -> String {
    let (t, w) = (cell.transient as u64, cell.window as u64);
    format!("protocols.{column}_{name}_t{t}_w{w}")
}

/// Complains if a value that the report has is another number.
fn shown(look: Look<'_>, id: &str, number: f64) -> Option<String> {
    look.number(id).and_then(|_| look.is(id, number))
}

/// Longer waiting and longer counting move the rise down, but for errors; and a twentieth of the
/// height comes before its half.
fn fall(look: Look<'_>) -> Option<String> {
    maps(look).find_map(|(name, map)| {
        let pairs = map.cells.iter().flat_map(|a| map.cells.iter().map(move |b| (a, b)));
        let falls = pairs.filter(|(a, b)| a.transient <= b.transient && a.window <= b.window);
        let places = |cell: &ProtocolCell| [cell.half_height_all, cell.onset];
        let mut rises = falls.filter_map(|(a, b)| {
            places(a).into_iter().zip(places(b)).find_map(|pair| {
                let (before, after) = pair.0.zip(pair.1)?;
                (after.value > before.value + room(&before, &after)).then_some((a, b))
            })
        });
        let early = map.cells.iter().find(|cell| {
            cell.onset.zip(cell.half_height_all).is_some_and(|(low, half)| low.value > half.value)
        });
        rises
            .next()
            .map(|(a, b)| {
                format!("{name}: later at T = {}, W = {} than {b:?}", a.transient, a.window)
            })
            .or_else(|| early.map(|cell| format!("{name}: half height before onset: {cell:?}")))
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
        let pairs = [(cell.half_height_all, other.half_height_all), (cell.onset, other.onset)];
        pairs.into_iter().find_map(|(own, other)| {
            let (own, other) = own.zip(other)?;
            unless((own.value - other.value).abs() <= room(&own, &other), || {
                format!("{name}: {} in its map, {} by itself", own.value, other.value)
            })
        })
    })
}

/// The heads of the table are the times of the maps, all of which have as many chains.
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
}
