//! Section 12: are impacts independent?

use super::{Error, chosen, count, estimate, from, mark};
use crate::experiments::independence::{Dependence, Distinct, Independence};
use crate::experiments::{Results, independence};
use crate::numerics::statistics::Estimate;
use crate::params::IndependenceParams;
use crate::report::values::{Value, line, origin};
use serde::Serialize;

/// The ensembles of which the text speaks, as (n, σ): the chain at the rise and far above, and one
/// of three masses.
const TEXT: [(&str, usize, f64); 3] = [("a", 100, 0.12), ("b", 100, 0.3), ("c", 3, 0.3)];

/// The columns of the table.
const COLUMNS: [&str; 8] =
    ["masses", "sigma", "effective", "dependence", "same", "short", "length", "different"];

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    cells: Vec<String>,
}

fn id(row: &Dependence, column: &str) -> String {
    let own = (row.row.masses, row.row.sigma);
    match TEXT.iter().find(|(_, masses, sigma)| (*masses, *sigma) == own) {
        Some((letter, ..)) => format!("independence.{letter}_{column}"),
        None => {
            format!("independence.n{}_{}_{column}", own.0, line(own.1))
        }
    }
}

/// Different gaps among as many successive impacts as there are gaps.
fn as_many(row: &Dependence) -> Option<&Distinct> {
    row.distinct.iter().find(|own| own.impacts == row.gaps)
}

/// A number times one that is exact.
fn times(own: Option<Estimate>, factor: f64) -> Option<Estimate> {
    own.map(|own| Estimate {
        value: own.value * factor,
        error: own.error * factor,
        interval: own.interval.map(|end| end * factor),
    })
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let found = results.independence()?;
    let parameters = &found.parameters;
    let mut values = vec![
        Value::integer("independence_realisations", parameters.realisations),
        Value::integer("independence_transient", parameters.protocol.transient as u64),
        Value::integer("independence_window", parameters.protocol.window as u64),
        Value::integer("independence_short", IndependenceParams::SHORT),
        Value::integer("orders_vertices", found.orders.vertices),
        Value::integer("orders_circuits", found.orders.circuits),
        Value::integer("orders_classes", found.orders.classes),
        Value::real("mean_without_orders", found.orders.mean, 2),
    ];
    for row in &found.rows {
        let n = row.hits.len();
        let cells = [
            ("effective", row.effective),
            ("dependence", times(row.dependence, 100.0)),
            ("same", times(row.same, 100.0)),
            ("short", row.short),
            ("length", row.length),
            ("different", as_many(row).and_then(|own| own.mean)),
        ];
        values.push(Value::integer(id(row, "masses"), row.row.masses));
        values.push(chosen(&id(row, "sigma"), row.row.sigma));
        values.extend(cells.map(|(name, own)| estimate(id(row, name), own, n)));
    }
    for (letter, masses, sigma) in TEXT {
        told(&mut values, letter, at(found, masses, sigma)?)?;
    }
    Ok(from(values, origin(independence::joining::join), "independence"))
}

/// What the text says of a row beside the cells of the table.
fn told(values: &mut Vec<Value>, letter: &str, row: &Dependence) -> Result<(), Error> {
    let n = row.hits.len();
    let named = |name: &str| format!("independence_{name}_{letter}");
    let different = as_many(row).ok_or(Error::Missing("as many impacts as gaps"))?;
    values.push(count(&named("impacts"), row.hits.iter().flatten().sum()));
    if letter != "c" {
        values.push(estimate(named("step"), row.step, n));
        values.push(count(&named("loops"), row.circuits.first().copied().unwrap_or(0)));
        values.push(estimate(named("different_frequencies"), different.frequencies, n));
    }
    if letter == "b" {
        let near = |distance: usize| row.near.get(distance).copied().flatten();
        values.extend([
            Value::integer("independence_gaps", row.gaps),
            Value::integer("independence_far_from", IndependenceParams::FAR),
            estimate(named("entropy"), row.entropy, n),
            estimate(named("information"), row.information, n),
            estimate(named("shuffled"), row.shuffled, n),
            estimate(named("near"), near(2), n),
            Value::real(named("far"), far(row), 2),
            estimate(named("same_independent"), times(row.same_independent, 100.0), n),
            estimate(named("short_matrix"), row.short_markov, n),
            estimate(named("length_matrix"), row.length_markov, n),
            Value::real("independence_length", row.length_uniform, 2),
            estimate(named("passing"), row.passing_share, n),
            Value::real("independence_passing", row.passing_independent, 2),
            estimate(named("collisions"), row.collisions, n),
            estimate(named("different_matrix"), different.markov, n),
            Value::real("independence_different", different.uniform, 3),
        ]);
    }
    Ok(())
}

/// The largest departure from independence among far successions.
fn far(row: &Dependence) -> f64 {
    let far = row.near.iter().skip(IndependenceParams::FAR).flatten();
    far.map(|own| (own.value - 1.0).abs()).fold(0.0, f64::max)
}

/// A row of which the text speaks.
fn at(found: &Independence, masses: usize, sigma: f64) -> Result<&Dependence, Error> {
    let is = |row: &&Dependence| row.row.masses == masses && row.row.sigma == sigma;
    found.rows.iter().find(is).ok_or(Error::Missing("the impacts of every chain of the text"))
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |row: &Dependence| Line {
        cells: COLUMNS.iter().map(|column| mark(id(row, column))).collect(),
    };
    Ok(results.independence()?.rows.iter().map(line).collect())
}
