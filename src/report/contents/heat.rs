//! Section 15: how hot a running chain is.

use super::{Error, chosen, estimate, from, mark};
use crate::experiments::heat::{Heat, Warmth};
use crate::experiments::{Results, heat};
use crate::params::{HeatParams, PRINTED_THRESHOLD};
use crate::report::values::{Value, cell, origin};
use serde::Serialize;

/// The σ of which the text speaks: at the rise, and far above.
const SIGMAS: [f64; 2] = [0.12, 0.3];

/// The restitution of which it speaks, beside the paper's.
const RESTITUTION: f64 = 0.9;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    sigma: String,
    ratio: String,
    count: String,
    probabilities: Vec<String>,
}

fn id(row: &Warmth, column: &str) -> String {
    cell("heat", row.row.sigma, column)
}

/// What the chain's free parts are worth in the relation of p and σ, by column of the table.
const COLUMNS: [&str; 4] = ["p", "rest", "balanced", "measured"];

fn probabilities(row: &Warmth) -> [f64; 4] {
    [row.p, row.p_rest, row.p_balanced, row.p_measured]
}

/// The ids of the probabilities that the text gives.
fn printed(sigma: f64, column: &str) -> Option<&'static str> {
    match (sigma, column) {
        (PRINTED_THRESHOLD, "p") => Some("p_012"),
        (PRINTED_THRESHOLD, "rest") => Some("p_rest_012"),
        (0.15, "p") => Some("p_015"),
        _ => None,
    }
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let heat = results.heat()?;
    let protocol = heat.parameters.protocol;
    let n = heat.parameters.realisations;
    let mut values = vec![
        Value::integer("heat_realisations", n),
        Value::integer("heat_transient", protocol.transient as u64),
        Value::integer("heat_window", protocol.window as u64),
        Value::real("sigma_jump_hot", heat.sigma_jump, 3),
        chosen("heat_other_sigma", HeatParams::SIGMA),
        chosen("heat_other_restitution", RESTITUTION),
    ];
    for row in heat.rising() {
        values.push(chosen(&id(row, "sigma"), row.row.sigma));
        values.push(estimate(id(row, "ratio"), row.ratio, row.ratios.len()));
        values.push(estimate(id(row, "count"), row.count, row.counts.len()));
        let probabilities = COLUMNS.iter().zip(probabilities(row));
        values.extend(probabilities.map(|(name, p)| match printed(row.row.sigma, name) {
            Some(same) => Value::same(id(row, name), same),
            None => Value::real(id(row, name), p, 2),
        }));
    }
    for (letter, sigma) in ["a", "b"].iter().zip(SIGMAS) {
        let row = at(heat, sigma)?;
        let named = |name: &str| format!("heat_{name}_{letter}");
        values.push(chosen(&named("sigma"), sigma));
        values.push(Value::same(named("ratio"), id(row, "ratio")));
        values.push(Value::real(named("friction"), row.expected_at_rate, 3));
    }
    let row = at(heat, SIGMAS[0])?;
    values.push(estimate("heat_hit", row.ratio_of_hit, row.ratios.len()));
    let lowest = heat.rising().next().ok_or(Error::Missing("how hot chains are"))?;
    values.push(chosen("heat_lowest_sigma", lowest.row.sigma));
    values.push(estimate("heat_lowest_hit", lowest.ratio_of_hit, lowest.ratios.len()));
    values.push(Value::same("heat_measured", id(row, "measured")));
    let other = |row: &&Warmth| row.row.restitution == RESTITUTION;
    let other = heat.others().find(other).ok_or(Error::Missing("another restitution"))?;
    values.push(Value::real(
        "heat_expected",
        heat.rising().map(|row| row.expected).fold(0.0, f64::max),
        2,
    ));
    values.push(Value::real("heat_other_expected", other.expected, 2));
    values.push(Value::real("heat_other_friction", other.expected_at_rate, 2));
    let high = at(heat, SIGMAS[1])?;
    values.push(Value::real("heat_rate", high.rate, 2));
    values.push(Value::integer("heat_rows", heat.rows.len()));
    values.push(Value::real("heat_factor", factor(heat, |row| row.expected), 2));
    values.push(Value::real("heat_factor_friction", factor(heat, |row| row.expected_at_rate), 2));
    let [walls, ring] = heat.balance;
    values.push(estimate("heat_balance", walls, n));
    values.push(estimate("heat_balance_ring", ring, n));
    values.push(estimate("heat_other", other.ratio, other.ratios.len()));
    Ok(from(values, origin(heat::warmth::warmth), "heat"))
}

/// The row of a σ that the text speaks of.
fn at(heat: &Heat, sigma: f64) -> Result<&Warmth, Error> {
    let row = heat.rising().find(|row| row.row.sigma == sigma);
    row.ok_or(Error::Missing("how hot chains are at every sigma of the text"))
}

/// By which factor a formula is off in the root mean square, over all ensembles.
fn factor(heat: &Heat, formula: fn(&Warmth) -> f64) -> f64 {
    let of = |row: &Warmth| Some(pxfm::f_log(formula(row) / row.ratio_of_hit?.value));
    let logs: Vec<f64> = heat.rows.iter().filter_map(of).collect();
    let square = logs.iter().map(|log| log * log).sum::<f64>() / logs.len().max(1) as f64;
    pxfm::f_exp(square.sqrt())
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |row: &Warmth| Line {
        sigma: mark(id(row, "sigma")),
        ratio: mark(id(row, "ratio")),
        count: mark(id(row, "count")),
        probabilities: COLUMNS.iter().map(|name| mark(id(row, name))).collect(),
    };
    Ok(results.heat()?.rising().map(line).collect())
}
