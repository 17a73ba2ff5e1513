//! The map over transients and windows.

use super::{Guard, Look, far, unless};
use crate::claims;
use crate::experiments::protocol::ProtocolCell;

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "ends_of_the_map",
        ids: &["protocol_low", "protocol_high", "protocols_total", "protocol_*"],
        find: ends,
    },
    Guard { name: "protocols_printed", ids: &["protocols_printed"], find: printed },
    Guard { name: "kept_before_all", ids: &["protocol.*"], find: kept_before_all },
    Guard { name: "map_meets_sweep", ids: &["protocol.*"], find: meets_sweep },
];

/// The cells are those of all transients and windows that were asked for; every half height lies
/// between the two extremes, and each extreme is one of them. The heads of the table are the times
/// of its cells.
fn ends(look: Look<'_>) -> Option<String> {
    let map = look.results.protocol().ok()?;
    let parameters = &map.parameters;
    let mut asked =
        parameters.transients.iter().flat_map(|&t| parameters.windows.iter().map(move |&w| (t, w)));
    let same = map.cells.iter().all(|cell| asked.next() == Some((cell.transient, cell.window)));
    let uneven =
        unless(same && asked.next().is_none(), || "the map has other cells than asked for".into());
    let mut halves: Vec<f64> =
        map.cells.iter().filter_map(|cell| Some(cell.half_height?.value)).collect();
    halves.sort_by(f64::total_cmp);
    let (lowest, highest) = (halves.first().copied(), halves.last().copied());
    let ordered = |list: &[f64]| list.windows(2).all(|w| w[0] < w[1]);
    let columns = parameters.transients.len() * parameters.windows.len();
    let times = |pick: fn(&ProtocolCell) -> f64| map.cells.iter().map(pick).collect();
    uneven
        .or_else(|| heads(look, "protocol.t", times(|cell| cell.transient)))
        .or_else(|| heads(look, "protocol.w", times(|cell| cell.window)))
        .or_else(|| look.is("protocol_low", highest?))
        .or_else(|| look.is("protocol_high", lowest?))
        .or_else(|| look.is("protocols_total", columns as f64))
        .or_else(|| look.is("protocol_sigma_count", parameters.sigmas.len() as f64))
        .or_else(|| {
            let rising = ordered(&parameters.transients) && ordered(&parameters.windows);
            unless(rising, || "times of the protocols are not in order".into())
        })
        .or_else(|| {
            named(
                look,
                &parameters.transients,
                ["protocol_transient_low", "protocol_transient_high"],
            )
        })
        .or_else(|| {
            named(look, &parameters.windows, ["protocol_window_low", "protocol_window_high"])
        })
}

/// Complains unless the values whose ids begin so are the times of the cells.
pub(super) fn heads(look: Look<'_>, start: &str, mut times: Vec<f64>) -> Option<String> {
    let own = |id: &str| id.strip_prefix(start).is_some_and(|rest| !rest.contains('_'));
    let heads = look.values.iter().filter(|value| own(&value.id));
    let mut heads: Vec<f64> = heads.filter_map(|value| look.number(&value.id)).collect();
    for list in [&mut heads, &mut times] {
        list.sort_by(f64::total_cmp);
        list.dedup();
    }
    unless(heads == times, || format!("the heads {heads:?} of the map are not its {times:?}"))
}

fn named(look: Look<'_>, times: &[f64], ids: [&str; 2]) -> Option<String> {
    let least = times.iter().copied().fold(f64::INFINITY, f64::min);
    let most = times.iter().copied().fold(0.0, f64::max);
    look.are([(ids[0], least), (ids[1], most)])
}

/// Protocols that print as the paper does are those whose half height, written with the decimals that
/// the paper printed, is what the paper printed.
fn printed(look: Look<'_>) -> Option<String> {
    let map = look.results.protocol().ok()?;
    let statement = look.published.statement("sec2_half_height").ok()?;
    let places = usize::from(statement.decimals);
    let text = |x: f64| format!("{x:.places$}");
    let number = text(statement.number().ok()?);
    let halves = map.cells.iter().filter_map(|cell| cell.half_height);
    look.is("protocols_printed", halves.filter(|half| text(half.value) == number).count() as f64)
}

/// The mean over the kept is nowhere below that over all, for what is left out counts nothing: so it
/// passes one half no later.
fn kept_before_all(look: Look<'_>) -> Option<String> {
    look.results.protocol().ok()?.cells.iter().find_map(|cell| {
        let (kept, all) = cell.half_height.zip(cell.half_height_all)?;
        unless(kept.value <= all.value, || {
            format!("kept chains pass one half at {}, all at {}", kept.value, all.value)
        })
    })
}

/// The cell with the protocol of the main sweep has drawn other random numbers, and agrees with it
/// within the errors of both.
fn meets_sweep(look: Look<'_>) -> Option<String> {
    let (map, sweep) = look.results.protocol().ok().zip(look.results.sweep().ok())?;
    let own = sweep.parameters.protocol;
    let (cell, main) =
        map.cell(own.transient, own.window)?.half_height.zip(sweep.rise.half_height)?;
    let error = (cell.error * cell.error + main.error * main.error).sqrt();
    let apart = (cell.value - main.value).abs();
    match apart <= claims::level().quantile * error {
        true => None,
        false => far("the half height of the map", cell.value, main.value),
    }
}
