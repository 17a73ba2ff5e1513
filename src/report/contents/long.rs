//! Section 11: the long end of the map.

use super::{Error, estimate, from, mark};
use crate::experiments::{Results, protocol};
use crate::report::values::{Value, origin};
use serde::Serialize;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    transient: String,
    /// Half heights of the mean of the kept, one for each window.
    kept: Vec<String>,
    /// The same of the mean of all.
    all: Vec<String>,
}

pub(super) fn cell(mean: &str, transient: f64, window: f64) -> String {
    format!("long.{mean}_t{}_w{}", transient as u64, window as u64)
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let long = results.long_protocol()?;
    let map = &long.map;
    let parameters = &map.parameters;
    let head = |letter: &str, time: f64| {
        Value::integer(format!("long.{letter}{}", time as u64), time as u64)
    };
    let mut values: Vec<Value> = parameters.windows.iter().map(|&w| head("w", w)).collect();
    values.extend(parameters.transients.iter().map(|&t| head("t", t)));
    let n = parameters.realisations;
    for c in &map.cells {
        values.push(estimate(cell("kept", c.transient, c.window), c.half_height, n));
        values.push(estimate(cell("all", c.transient, c.window), c.half_height_all, n));
    }
    let longest = |times: &[f64]| times.last().copied().unwrap_or(0.0);
    let (t, w) = (longest(&parameters.transients), longest(&parameters.windows));
    let last = map.cell(t, w).ok_or(Error::Missing("the longest transient"))?;
    values.extend([
        Value::integer("long_realisations", n),
        Value::integer("long_sigma_count", parameters.sigmas.len()),
        Value::integer("long_until", t as u64),
        Value::integer("long_window", w as u64),
        Value::same("long_kept", cell("kept", t, w)),
        Value::same("long_all", cell("all", t, w)),
        estimate("long_onset", last.onset, n),
    ]);
    Ok(from(values, origin(protocol::join), "long_protocol"))
}

/// The heads of the columns.
pub fn windows(results: &Results) -> Result<Vec<String>, Error> {
    let windows = &results.long_protocol()?.map.parameters.windows;
    Ok(windows.iter().map(|w| mark(format!("long.w{}", *w as u64))).collect())
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let parameters = &results.long_protocol()?.map.parameters;
    let line = |&t: &f64| {
        let cells = |mean| parameters.windows.iter().map(|&w| mark(cell(mean, t, w))).collect();
        Line {
            transient: mark(format!("long.t{}", t as u64)),
            kept: cells("kept"),
            all: cells("all"),
        }
    };
    Ok(parameters.transients.iter().map(line).collect())
}
