//! How hot a running chain is: what its past does to the count.

use super::mean_all;
use super::protocol::all_as;
use super::{Error, chosen, estimate, from, mark};
use crate::experiments::history::{History, Lowered};
use crate::experiments::{Results, history};
use crate::report::values::{Value, cell, origin};
use serde::Serialize;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    cells: Vec<String>,
}

fn id(row: &Lowered, column: &str) -> String {
    cell("history", row.sigma, column)
}

/// The column of a transient.
fn after(transient: f64) -> String {
    format!("t{}", transient as u64)
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let (history, sweep) = (results.history()?, results.sweep()?);
    let parameters = &history.parameters;
    let n = parameters.realisations;
    let mut values = vec![
        chosen("history_hot", parameters.hot),
        Value::integer("history_heating", parameters.heating as u64),
        Value::integer("history_realisations", n),
        Value::integer("history_window", parameters.window as u64),
    ];
    for (transient, half) in parameters.transients.iter().zip(&history.half_heights) {
        let name = after(*transient);
        values.push(Value::integer(format!("history.{name}"), *transient as u64));
        values.push(estimate(format!("history.half_{name}"), *half, n));
    }
    for (letter, place) in ["a", "b"].into_iter().zip([0, parameters.transients.len() - 1]) {
        let transient = parameters.transients[place];
        values.push(Value::integer(format!("history_transient_{letter}"), transient as u64));
        let own = format!("history.half_{}", after(transient));
        values.push(Value::same(format!("history_half_{letter}"), own));
        // Of the mean of all, as the other: that of the kept knows no bound.
        let rest = format!("history_rest_{letter}");
        values.push(all_as(rest, results.protocol()?, transient, parameters.window));
    }
    for row in &history.rows {
        values.push(chosen(&id(row, "sigma"), row.sigma));
        let rest = sweep.rows.iter().find(|own| own.sigma == row.sigma);
        let rest = rest.map(|own| mean_all(&id(row, "rest"), own));
        values.push(rest.unwrap_or_else(|| Value::text(id(row, "rest"), "none")));
        for (transient, mean) in parameters.transients.iter().zip(&row.means) {
            values.push(estimate(id(row, &after(*transient)), *mean, n));
        }
    }
    let coldest = history.rows.first().ok_or(Error::Missing("chains that were heated"))?;
    values.push(chosen("history_coldest", coldest.sigma));
    values.push(estimate("history_coldest_count", coldest.means.last().copied().flatten(), n));
    Ok(from(values, origin(history::join), "history"))
}

/// The transients, as heads of the table.
pub fn times(results: &Results) -> Result<Vec<String>, Error> {
    let history: &History = results.history()?;
    let head = |transient: &f64| mark(format!("history.{}", after(*transient)));
    Ok(history.parameters.transients.iter().map(head).collect())
}

/// The lines of the table: each σ, and the half heights.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let history = results.history()?;
    let transients = &history.parameters.transients;
    let line = |row: &Lowered| {
        let counts = transients.iter().map(|transient| mark(id(row, &after(*transient))));
        Line {
            cells: [id(row, "sigma"), id(row, "rest")]
                .map(mark)
                .into_iter()
                .chain(counts)
                .collect(),
        }
    };
    let halves =
        transients.iter().map(|transient| mark(format!("history.half_{}", after(*transient))));
    let halves = Line {
        cells: [r"$\sigma_{1/2}$".to_string(), mark("sweep.rise.half_height_all")]
            .into_iter()
            .chain(halves)
            .collect(),
    };
    Ok(history.rows.iter().map(line).chain([halves]).collect())
}
