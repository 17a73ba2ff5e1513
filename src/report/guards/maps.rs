//! Half heights after several transients: what chance must not break.

use super::{Guard, Look, room, unless};
use crate::claims;
use crate::experiments::rise::Curve;
use crate::experiments::{BRANCHES, PROTOCOL, branches, sweep};
use impact_numerics::estimates::difference;
use impact_numerics::statistics::Estimate;

pub const GUARDS: &[Guard] = &[
    Guard { name: "map_meets_sweep", ids: &["protocol*"], find: meet },
    Guard { name: "map_falls", ids: &["protocol*"], find: fall },
    Guard { name: "maps_need_seeds", ids: &["protocol*", "branches.lengths*"], find: need_seeds },
    Guard {
        name: "branches_approach",
        ids: &["branches.lengths*", "branches.half_heights*"],
        find: approach,
    },
    Guard { name: "above_stays_above", ids: &["branches.shares*"], find: above },
];

/// The half heights of the mean of the kept and of all, the onset, and where half of the chains are kept.
type Places = [Option<Estimate>; 4];

fn places(cell: &Curve) -> Places {
    let rise = &cell.rise;
    [rise.half_height, rise.half_height_all, rise.onset, rise.kept_half]
}

/// Samples that drew other random numbers agree within the errors of both: the map with the main sweep.
fn meet(look: Look<'_>) -> Option<String> {
    let sweep = sweep::main(look.results).ok()?.first();
    let map = &look.results.of(&PROTOCOL).ok()?[0];
    let own = map.curve(sweep.protocol.transient, sweep.protocol.window)?;
    places(own).into_iter().zip(places(sweep)).find_map(|(own, other)| {
        let (own, other) = own.zip(other)?;
        unless((own.value - other.value).abs() <= room(&own, &other), || {
            format!("{} in one sample, {} in another", own.value, other.value)
        })
    })
}

/// Longer waiting and longer counting move the rise down, but for errors.
fn fall(look: Look<'_>) -> Option<String> {
    let map = &look.results.of(&PROTOCOL).ok()?[0];
    let pairs = map.curves.iter().flat_map(|a| map.curves.iter().map(move |b| (a, b)));
    let mut falls = pairs.filter(|(a, b)| {
        a.protocol.transient <= b.protocol.transient && a.protocol.window <= b.protocol.window
    });
    falls.find_map(|(a, b)| {
        places(a).into_iter().zip(places(b)).find_map(|(before, after)| {
            let (before, after) = before.zip(after)?;
            unless(after.value <= before.value + room(&before, &after), || {
                format!("{} after {} at later times", after.value, before.value)
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
    let (map, found) = (&look.results.of(&PROTOCOL).ok()?[0], look.results.of(&BRANCHES).ok()?);
    let masses = map.ensemble.chain.masses;
    let long = branches::from_rest(found).filter(|(own, _)| own.ensemble.chain.masses == masses);
    map.curves.iter().chain(long.map(|(_, curve)| curve)).find_map(|cell| {
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

/// With time half height falls at every length from rest, and rises from above, but for errors.
fn approach(look: Look<'_>) -> Option<String> {
    let table = |name| look.results.table(name).ok();
    let (lengths, both) = (table("branches.lengths")?, table("branches.half_heights")?);
    let window = ("window", *lengths.values("window").first()?);
    let falling = lengths.values("masses").into_iter().map(|masses| {
        let keys = [("masses", masses), window];
        (1.0, lengths.estimates(&keys, "transient", "half_height"))
    });
    let one = |sign, column| (sign, both.estimates(&[], "transient", column));
    falling.chain([one(1.0, "from_rest"), one(-1.0, "from_above")]).find_map(|(sign, places)| {
        places.windows(2).find_map(|pair| {
            let [(early, before), (late, after)] = [pair[0], pair[1]];
            unless(
                late <= early || sign * (after.value - before.value) <= room(&before, &after),
                || format!("half height {} at {early}, {} at {late}", before.value, after.value),
            )
        })
    })
}

/// Chains from above have at least as many gaps with an impact as chains from rest under the same forces, but for chance:
/// five standard errors of both.
fn above(look: Look<'_>) -> Option<String> {
    let shares = look.results.table("branches.shares").ok()?;
    shares.values("transient").into_iter().find_map(|transient| {
        let of = |column| shares.estimates(&[("transient", transient)], "sigma", column);
        let above = of("from_above");
        of("from_rest").into_iter().find_map(|(sigma, rest)| {
            let (_, own) = above.iter().find(|(other, _)| *other == sigma)?;
            let less = difference(rest, *own);
            unless(less.value <= 5.0 * less.error, || {
                format!(
                    "{} from above, {} from rest, at {sigma} and {transient}",
                    own.value, rest.value
                )
            })
        })
    })
}
