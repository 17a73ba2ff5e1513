//! Section 11: the map over transients and windows for other starts and ends.

use super::protocol::all_as;
use super::{Error, estimate, from, long, mark};
use crate::experiments::protocol::ProtocolCell;
use crate::experiments::{Results, protocol};
use crate::numerics::statistics::Estimate;
use crate::report::values::{Value, origin};
use serde::Serialize;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    what: &'static str,
    transient: String,
    /// One for each window.
    half: Vec<String>,
    onset: Vec<String>,
    kept: Vec<String>,
}

/// Cells of one experiment.
#[derive(Clone, Copy)]
struct Own<'a> {
    cell: &'a ProtocolCell,
    /// The number of chains.
    n: usize,
    experiment: &'static str,
}

/// The cells of the paper's chain, with those of its long end, and of the others.
fn maps(results: &Results) -> Result<Vec<(&str, Vec<Own<'_>>)>, Error> {
    let (map, long) = (results.protocol()?, results.long_protocol()?);
    let of = |experiment, n| move |cell| Own { cell, n, experiment };
    let early = of("protocol", map.parameters.realisations);
    let late = of("long_protocol", long.map.parameters.realisations);
    let rest = map.cells.iter().map(early).chain(long.beyond(map).map(late)).collect();
    let others = results.protocols()?.named().map(|(name, map)| {
        (name, map.cells.iter().map(of("protocols", map.parameters.realisations)).collect())
    });
    Ok([("rest", rest)].into_iter().chain(others).collect())
}

/// Transients and windows of the maps of the others.
fn times(results: &Results) -> Result<(&[f64], &[f64]), Error> {
    let first = results.protocols()?.parameters.maps.first();
    let map = &first.ok_or(Error::Missing("maps of other starts"))?.map;
    Ok((&map.transients, &map.windows))
}

fn id(column: &str, name: &str, transient: f64, window: f64) -> String {
    format!("protocols.{column}_{name}_t{}_w{}", transient as u64, window as u64)
}

fn head(letter: &str, time: f64) -> String {
    format!("protocols.{letter}{}", time as u64)
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let (transients, windows) = times(results)?;
    let heads = [("t", transients), ("w", windows)];
    let mut values: Vec<Value> = heads
        .into_iter()
        .flat_map(|(letter, times)| {
            times.iter().map(move |&time| Value::integer(head(letter, time), time as u64))
        })
        .collect();
    let all = maps(results)?;
    let place = |id: String, own: &Own<'_>, place: Option<Estimate>| {
        estimate(id, place, own.n).source(origin(protocol::join), own.experiment)
    };
    for (name, cells) in &all {
        let shown = |own: &&Own<'_>| {
            transients.contains(&own.cell.transient) && windows.contains(&own.cell.window)
        };
        for own in cells.iter().filter(shown) {
            let cell = own.cell;
            let id = |column: &str| id(column, name, cell.transient, cell.window);
            let (t, w) = (cell.transient, cell.window);
            let last = results.long_protocol()?.map.cells.last();
            values.push(match own.experiment {
                "protocol" => all_as(id("half"), results.protocol()?, t, w),
                "long_protocol" => Value::same(id("half"), long::cell("all", t, w)),
                _ => place(id("half"), own, cell.half_height_all),
            });
            values.push(match last.is_some_and(|last| std::ptr::eq(last, cell)) {
                true => Value::same(id("onset"), "long_onset"),
                false => place(id("onset"), own, cell.onset),
            });
            values.push(place(id("kept"), own, cell.kept_half));
        }
    }
    // From rest, in the first window and in the last.
    let rest = all.first().map_or(&[][..], |(_, cells)| cells);
    let ends = [(transients.first(), windows.first()), (transients.last(), windows.last())];
    for (id, (transient, window)) in ["kept_soon", "kept_late"].into_iter().zip(ends) {
        let (Some(&transient), Some(&window)) = (transient, window) else { continue };
        let is_it = |own: &Own<'_>| own.cell.transient == transient && own.cell.window == window;
        if rest.iter().any(is_it) {
            let same = self::id("kept", "rest", transient, window);
            values.push(Value::same(format!("protocols.{id}"), same));
        }
    }
    let first = results.protocols()?.maps.first().map_or(0, |map| map.parameters.realisations);
    values.push(Value::integer("protocols_realisations", first));
    Ok(from(values, origin(protocol::join), "protocols"))
}

/// The windows, as heads of columns.
pub fn windows(results: &Results) -> Result<Vec<String>, Error> {
    Ok(times(results)?.1.iter().map(|&w| mark(head("w", w))).collect())
}

/// The lines of the tables.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let (transients, windows) = times(results)?;
    let cells = |column: &str, name: &str, transient: f64| {
        windows.iter().map(|&w| mark(id(column, name, transient, w))).collect()
    };
    let line = |name: &str, transient: f64| Line {
        what: match name {
            "rest" => "rest",
            "zero" => "on the forced motion",
            "random" => "random free parts",
            _ => "rest, on a ring",
        },
        transient: mark(head("t", transient)),
        half: cells("half", name, transient),
        onset: cells("onset", name, transient),
        kept: cells("kept", name, transient),
    };
    let all = maps(results)?;
    Ok(all.iter().flat_map(|(name, _)| transients.iter().map(|&t| line(name, t))).collect())
}
