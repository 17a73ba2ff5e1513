//! The maps over transients and windows: what chance must not break.

use super::{Guard, Look, room, unless};
use crate::claims;
use crate::experiments::sweep;
use crate::experiments::{LONG_PROTOCOL, PROTOCOL};
use impact_chain::rise::{Counted, Curve};
use impact_numerics::statistics::Estimate;

pub const GUARDS: &[Guard] = &[
    Guard { name: "maps_meet", ids: &["protocol*", "long_protocol*"], find: meet },
    Guard { name: "maps_fall", ids: &["protocol*", "long_protocol*"], find: fall },
    Guard { name: "maps_need_seeds", ids: &["protocol*", "long_protocol*"], find: need_seeds },
];

/// The half heights of the mean of the kept and of all, the onset, and where half of the chains are kept.
type Places = [Option<Estimate>; 4];

fn places(cell: &Curve) -> Places {
    let rise = &cell.rise;
    [rise.half_height, rise.half_height_all, rise.onset, rise.kept_half]
}

/// All maps, by what they were run with.
fn maps<'a>(look: Look<'a>) -> impl Iterator<Item = (&'a str, &'a Counted)> {
    let rest = look.results.of(&PROTOCOL).into_iter().map(|map| ("rest", &map[0]));
    let long = look.results.of(&LONG_PROTOCOL).into_iter().map(|long| ("long", &long[0]));
    rest.chain(long)
}

/// Samples that drew other random numbers agree within the errors of both: the map with the main sweep and
/// with its long end.
fn meet(look: Look<'_>) -> Option<String> {
    let apart = |what: &str, own: Places, other: Places| {
        own.into_iter().zip(other).find_map(|(own, other)| {
            let (own, other) = own.zip(other)?;
            unless((own.value - other.value).abs() <= room(&own, &other), || {
                format!("{what}: {} in one sample, {} in another", own.value, other.value)
            })
        })
    };
    let sweep = sweep::main(look.results).ok()?;
    let protocol = sweep.first().protocol;
    maps(look).find_map(|(name, map)| {
        let at = map.curve(protocol.transient, protocol.window);
        let swept = at.filter(|_| name == "rest");
        let swept = swept.and_then(|at| apart(name, places(at), places(sweep.first())));
        let rest = look.results.of(&PROTOCOL).ok().map(|map| &map[0]).filter(|_| name == "long")?;
        swept.or_else(|| {
            map.curves.iter().find_map(|own| {
                apart(
                    name,
                    places(own),
                    places(rest.curve(own.protocol.transient, own.protocol.window)?),
                )
            })
        })
    })
}

/// Longer waiting and longer counting move the rise down, but for errors.
fn fall(look: Look<'_>) -> Option<String> {
    maps(look).find_map(|(name, map)| {
        let pairs = map.curves.iter().flat_map(|a| map.curves.iter().map(move |b| (a, b)));
        let mut falls = pairs.filter(|(a, b)| {
            a.protocol.transient <= b.protocol.transient && a.protocol.window <= b.protocol.window
        });
        falls.find_map(|(a, b)| {
            places(a).into_iter().zip(places(b)).find_map(|(before, after)| {
                let (before, after) = before.zip(after)?;
                unless(after.value <= before.value + room(&before, &after), || {
                    format!("{name}: {} after {} at later times", after.value, before.value)
                })
            })
        })
    })
}

/// From rest no more chains have impacts than have a gap that closes by itself, however long one waits: the
/// mean of all is half of N no sooner than half of the chains have such a gap, and a twentieth of it no
/// sooner than a twentieth of them.
fn need_seeds(look: Look<'_>) -> Option<String> {
    let of = |column: &str| look.results.number(&format!("theory.relation.{column}")).ok();
    let (half, onset) = (of("sigma_kept_half")?, of("sigma_kept_onset")?);
    let quantile = claims::level().quantile;
    maps(look).flat_map(|(_, map)| &map.curves).find_map(|cell| {
        let bounds = [
            (cell.rise.half_height_all, half),
            (cell.rise.kept_half, half),
            (cell.rise.onset, onset),
        ];
        bounds.into_iter().find_map(|(own, bound)| {
            let own = own?;
            unless(own.value >= bound - quantile * own.error, || {
                format!("rise at {}, where too few have seeds below {bound}", own.value)
            })
        })
    })
}
