//! Section 12, second half: what one gap sets off, and the mean count that follows.

use super::fronts::moment_id;
use super::mean_all;
use super::protocol::all_as;
use super::{Error, chosen, difference, estimate, from, mark, share};
use crate::experiments::seeds::{Prediction, Seeds, Spread};
use crate::experiments::sweep::Sweep;
use crate::experiments::{Results, seeds};
use crate::report::values::{Value, cell, origin};
use serde::Serialize;

/// The σ of which the text speaks: at the rise.
pub(super) const SIGMA: f64 = 0.12;

/// One line of a table.
#[derive(Debug, Serialize)]
pub struct Line {
    cells: Vec<String>,
}

impl Line {
    /// From its cells.
    pub(super) fn new<const N: usize>(cells: [String; N]) -> Self {
        Line { cells: cells.to_vec() }
    }
}

const SPREADS: [&str; 5] = ["sigma", "spread", "active", "exponent", "radius"];

const HALVES: [&str; 3] = ["transient", "predicted", "found"];

fn spread_id(row: &Spread, column: &str) -> String {
    cell("spread", row.sigma, column)
}

fn half_id(own: &Prediction, column: &str) -> String {
    format!("growth.t{}_{column}", own.transient as u64)
}

/// The rows of the table: those at whole hundredths.
pub(super) fn tabled(seeds: &Seeds) -> impl Iterator<Item = &Spread> {
    seeds.rows.iter().filter(|row| in_table(row))
}

fn in_table(row: &Spread) -> bool {
    (100.0 * row.sigma).round() / 100.0 == row.sigma
}

/// For each σ that both have, by how much the predicted mean is above the simulated one.
fn compared<'a>(
    seeds: &'a Seeds,
    own: &'a Prediction,
    sweep: &'a Sweep,
) -> impl Iterator<Item = (f64, f64)> + 'a {
    seeds.rows.iter().zip(&own.means).filter_map(|(row, mean)| {
        let ran = sweep.rows.iter().find(|other| other.sigma == row.sigma)?;
        Some((row.sigma, mean.value - ran.mean_all?))
    })
}

/// The exponent at one end of the range, which the table has where it has that end.
fn exponent(id: &str, row: &Spread) -> Value {
    match in_table(row) {
        true => Value::same(id, spread_id(row, "exponent")),
        false => Value::real(id, row.exponent, 2),
    }
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let (seeds, sweep) = (results.seeds()?, results.sweep()?);
    let parameters = &seeds.parameters;
    let n = parameters.realisations;
    let first = seeds.rows.first().ok_or(Error::Missing("seeds"))?;
    let last = seeds.rows.last().ok_or(Error::Missing("seeds"))?;
    let least = seeds.rows.iter().min_by(|a, b| a.survival.total_cmp(&b.survival));
    let least = least.ok_or(Error::Missing("seeds"))?;
    let lived = (least.survival * least.seeds as f64).round() as usize;
    let mut values = vec![
        Value::integer("seeds_each", n),
        Value::integer("seeds_sigma_count", seeds.rows.len()),
        chosen("seeds_sigma_low", first.sigma),
        chosen("seeds_sigma_high", last.sigma),
        Value::integer("seeds_until", (parameters.bin * parameters.bins as f64) as u64),
        exponent("seeds_exponent_low", first),
        exponent("seeds_exponent_high", last),
    ];
    values.push(match least.course.last() {
        Some(own) if least.sigma == SIGMA => Value::same("seeds_survival", moment_id(own, "alive")),
        _ => share("seeds_survival", lived, least.seeds as usize),
    });
    for row in tabled(seeds) {
        values.push(chosen(&spread_id(row, "sigma"), row.sigma));
        values.push(estimate(spread_id(row, "spread"), row.spread, row.spreads.len()));
        values.push(Value::real(spread_id(row, "exponent"), row.exponent, 2));
        let last = row.course.last();
        values.extend(match last.filter(|_| row.sigma == SIGMA) {
            Some(own) => ["active", "radius"]
                .map(|column| Value::same(spread_id(row, column), moment_id(own, column))),
            None => [
                estimate(
                    spread_id(row, "active"),
                    last.and_then(|own| own.active),
                    row.spreads.len(),
                ),
                Value::real(spread_id(row, "radius"), row.radius, 2),
            ],
        });
    }
    for own in &seeds.predictions {
        values.push(Value::integer(half_id(own, "transient"), own.transient as u64));
        values.push(estimate(half_id(own, "predicted"), own.half_height, n));
        let found = half_id(own, "found");
        values.push(all_as(found, results.protocol()?, own.transient, own.window));
    }
    values.extend(comparison(seeds, sweep, n)?);
    Ok(from(values, origin(seeds::growth::predictions), "seeds"))
}

/// With the protocol of the main sweep.
fn comparison(seeds: &Seeds, sweep: &Sweep, n: usize) -> Result<Vec<Value>, Error> {
    let protocol = sweep.parameters.protocol;
    let same =
        |own: &&Prediction| (own.transient, own.window) == (protocol.transient, protocol.window);
    let own = seeds.predictions.iter().find(same);
    let own = own.ok_or(Error::Missing("a prediction for the protocol of the report"))?;
    let at_rise = seeds.rows.iter().zip(&own.means).find(|(row, _)| row.sigma == SIGMA);
    let (_, mean) = at_rise.ok_or(Error::Missing("seeds at the rise"))?;
    let ran = sweep.rows.iter().find(|row| row.sigma == SIGMA);
    let ran = ran.ok_or(Error::Missing("a row of the main sweep"))?;
    let worst = compared(seeds, own, sweep).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let worst = worst.ok_or(Error::Missing("seeds at a sigma of the main sweep"))?;
    Ok(vec![
        chosen("growth_sigma", SIGMA),
        estimate("growth_mean", Some(*mean), n),
        mean_all("growth_mean_found", ran),
        Value::same("growth_half", half_id(own, "predicted")),
        estimate("growth_half_found", sweep.rise.half_height_all, sweep.parameters.realisations),
        difference("growth_early", sweep.rise.half_height_all, own.half_height, n),
        Value::real("growth_worst", worst.1.abs(), 2),
        chosen("growth_worst_sigma", worst.0),
    ])
}

/// The lines of the table of spreading.
pub fn spreads(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |row: &Spread| Line::new(SPREADS.map(|name| mark(spread_id(row, name))));
    Ok(tabled(results.seeds()?).map(line).collect())
}

/// The lines of the table of half heights.
pub fn halves(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |own: &Prediction| Line::new(HALVES.map(|name| mark(half_id(own, name))));
    Ok(results.seeds()?.predictions.iter().map(line).collect())
}
