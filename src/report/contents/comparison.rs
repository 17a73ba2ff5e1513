//! Section 8: simulated and theoretical expected numbers side by side.

use super::{Error, from, mark};
use crate::experiments::sweep::{Sweep, SweepRow};
use crate::experiments::theory::CurveRow;
use crate::experiments::theory::beside::{BETWEEN, at};
use crate::experiments::{Results, theory};
use crate::report::values::{Value, cell, origin};
use serde::Serialize;

/// The σ of the lines, as far as the sweep has them.
const SIGMAS: [f64; 8] = [0.1, 0.11, 0.12, 0.13, 0.14, 0.15, 0.2, 0.3];

/// The columns from the theory: name and what it is.
type Column = (&'static str, fn(&CurveRow) -> f64);
const THEORIES: [Column; 3] =
    [("simple", |r| r.simple), ("higher", |r| r.higher), ("rest", |r| r.simple_rest)];

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    row: String,
    theories: Vec<String>,
}

fn id(row: &SweepRow, column: &str) -> String {
    cell("compare", row.sigma, column)
}

pub(super) fn lines(sweep: &Sweep) -> Vec<&SweepRow> {
    sweep.rows.iter().filter(|row| SIGMAS.contains(&row.sigma) && row.kept > 0).collect()
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let curve = &results.theory.curve;
    let mut values = Vec::new();
    for row in lines(results.sweep()?) {
        for (name, column) in THEORIES {
            let theory = at(curve, row.sigma, column);
            let theory = theory.ok_or(Error::Missing("the theory at every simulated sigma"))?;
            let id = id(row, name);
            values.push(match (row.sigma == BETWEEN, name) {
                (true, "simple") => Value::same(id, "sweep.beside_theory.between"),
                _ => Value::real(id, theory, 3),
            });
        }
    }
    Ok(from(values, origin(theory::curves::curve), "theory"))
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |row: &SweepRow| Line {
        row: format!("sigma={}", row.sigma),
        theories: THEORIES.iter().map(|(name, _)| mark(id(row, name))).collect(),
    };
    Ok(lines(results.sweep()?).into_iter().map(line).collect())
}
