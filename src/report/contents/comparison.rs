//! Section 8: simulated and theoretical expected numbers side by side.

use super::simulation::mean_kept;
use super::{Error, chosen, from, mark};
use crate::claims::sec8;
use crate::experiments::Results;
use crate::experiments::sweep::SweepRow;
use crate::experiments::theory::CurveRow;
use crate::report::values::{Value, cell};
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
    sigma: String,
    simulated: String,
    theories: Vec<String>,
}

fn id(row: &SweepRow, column: &str) -> String {
    cell("compare", row.sigma, column)
}

fn lines(results: &Results) -> Result<Vec<&SweepRow>, Error> {
    let rows = results.sweep()?.rows.iter();
    Ok(rows.filter(|row| SIGMAS.contains(&row.sigma) && row.kept > 0).collect())
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let curve = &results.theory.curve;
    let mut values = Vec::new();
    for row in lines(results)? {
        values.push(chosen(&id(row, "sigma"), row.sigma));
        values.push(mean_kept(&id(row, "simulated"), row));
        for (name, column) in THEORIES {
            let theory = sec8::at(curve, row.sigma, column);
            let theory = theory.ok_or(Error::Missing("the theory at every simulated sigma"))?;
            values.push(Value::real(id(row, name), theory, 3));
        }
    }
    Ok(from(values, "experiments::theory::run", "sweep"))
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |row: &SweepRow| Line {
        sigma: mark(id(row, "sigma")),
        simulated: mark(id(row, "simulated")),
        theories: THEORIES.iter().map(|(name, _)| mark(id(row, name))).collect(),
    };
    Ok(lines(results)?.into_iter().map(line).collect())
}
