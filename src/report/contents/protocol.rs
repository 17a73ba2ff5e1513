//! Section 11: the map over transients and windows.

use super::{Error, estimate, from, mark};
use crate::experiments::protocol::{ProtocolCell, ProtocolMap};
use crate::experiments::{Results, protocol};
use crate::report::values::{Value, origin};
use serde::Serialize;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    transient: String,
    cells: Vec<String>,
}

fn cell(transient: f64, window: f64) -> String {
    format!("protocol.t{}_w{}", transient as u64, window as u64)
}

/// The half height of the mean of all in a cell.
fn all(transient: f64, window: f64) -> String {
    format!("{}_all", cell(transient, window))
}

/// The same by the name that another section has for it.
pub(super) fn all_as(id: String, map: &ProtocolMap, transient: f64, window: f64) -> Value {
    match map.cell(transient, window) {
        Some(_) => Value::same(id, all(transient, window)),
        None => Value::text(id, "none"),
    }
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let map = results.protocol()?;
    let parameters = &map.parameters;
    let n = parameters.realisations;
    let mut values: Vec<Value> = Vec::new();
    for &w in &parameters.windows {
        values.push(Value::integer(format!("protocol.w{}", w as u64), w as u64));
    }
    for &t in &parameters.transients {
        values.push(Value::integer(format!("protocol.t{}", t as u64), t as u64));
    }
    let cells = map.cells.iter().map(|c| estimate(cell(c.transient, c.window), c.half_height, n));
    values.extend(cells);
    let of_all = |c: &ProtocolCell| estimate(all(c.transient, c.window), c.half_height_all, n);
    values.extend(map.cells.iter().map(of_all).map(Value::data_only));
    let ends = |list: &[f64]| [list.first().copied(), list.last().copied()];
    let extreme = |id: &str, better: fn(f64, f64) -> bool| match extreme(map, better) {
        Some(own) => Value::same(id, cell(own.transient, own.window)),
        None => Value::text(id, "none"),
    };
    let time = |id: &str, x: Option<f64>| Value::integer(id, x.unwrap_or(0.0) as u64);
    let [t_low, t_high] = ends(&parameters.transients);
    let [w_low, w_high] = ends(&parameters.windows);
    values.extend([
        // The largest threshold first: it falls with both times.
        extreme("protocol_low", |a, b| a > b),
        extreme("protocol_high", |a, b| a < b),
        time("protocol_transient_low", t_low),
        time("protocol_transient_high", t_high),
        time("protocol_window_low", w_low),
        time("protocol_window_high", w_high),
        Value::integer("protocol_realisations", n),
        Value::integer("protocol_sigma_count", parameters.sigmas.len()),
        Value::integer(
            "protocols_printed",
            map.cells.iter().filter(|c| c.prints_as_published).count(),
        ),
        Value::integer("protocols_total", map.cells.len()),
    ]);
    Ok(from(values, origin(protocol::join), "protocol"))
}

fn extreme(map: &ProtocolMap, better: fn(f64, f64) -> bool) -> Option<&ProtocolCell> {
    let halves = map.cells.iter().filter_map(|c| Some((c.half_height?.value, c)));
    halves.reduce(|best, own| if better(own.0, best.0) { own } else { best }).map(|own| own.1)
}

/// The protocols that print as the paper does: each transient with its windows.
pub fn printed(results: &Results) -> Result<Vec<Line>, Error> {
    let map = results.protocol()?;
    let line = |&t: &f64| {
        let own = map.cells.iter().filter(|c| c.transient == t && c.prints_as_published);
        let cells = own.map(|c| mark(format!("protocol.w{}", c.window as u64))).collect();
        Line { transient: mark(format!("protocol.t{}", t as u64)), cells }
    };
    let lines = map.parameters.transients.iter().map(line);
    Ok(lines.filter(|line| !line.cells.is_empty()).collect())
}

/// The heads of the columns.
pub fn windows(results: &Results) -> Result<Vec<String>, Error> {
    let windows = &results.protocol()?.parameters.windows;
    Ok(windows.iter().map(|w| mark(format!("protocol.w{}", *w as u64))).collect())
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let parameters = &results.protocol()?.parameters;
    let line = |&t: &f64| Line {
        transient: mark(format!("protocol.t{}", t as u64)),
        cells: parameters.windows.iter().map(|&w| mark(cell(t, w))).collect(),
    };
    Ok(parameters.transients.iter().map(line).collect())
}
