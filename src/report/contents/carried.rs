//! Section 22: results that are carried over, and what became of a sample of each.

use super::{Error, from, mark};
use crate::experiments::{self, Results};
use crate::report::values::{Value, origin};
use literate::experiments::deep;
use literate::experiments::deep::{Audit, Carriage};
use serde::Serialize;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    /// What was run, and where it is told.
    what: &'static str,
    cells: Vec<String>,
}

fn id(what: &str, name: &str) -> String {
    format!("carried.{what}_{name}")
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let of = |(name, audit): (&String, &Audit)| {
        let mut values = vec![
            Value::integer(id("units", name), audit.units),
            Value::integer(id("again", name), audit.again),
            Value::integer(id("identical", name), audit.identical),
        ];
        values.extend(audit.distance.into_iter().flat_map(|distance| {
            [
                Value::real(id("distance", name), distance.largest, 2),
                Value::real(id("allowed", name), distance.allowed, 2),
            ]
        }));
        values
    };
    let values = results.audits.iter().flat_map(of).collect();
    Ok(from(values, origin(deep::audit::Audited::<(), (), ()>::get), "audits"))
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |(name, audit): (&String, &Audit)| {
        let cell = |what| mark(id(what, name));
        let outcome = match audit.verdict {
            Carriage::Identical => "identical".into(),
            Carriage::WithinError => {
                format!("within error: {} of {}", cell("distance"), cell("allowed"))
            }
            Carriage::Failed => "**stale**".into(),
        };
        Ok(Line {
            what: experiments::ALL
                .iter()
                .find(|experiment| experiment.name() == name)
                .and_then(|experiment| experiment.carried())
                .ok_or(Error::Missing("a carried result without a title"))?,
            cells: vec![cell("units"), cell("again"), cell("identical"), outcome],
        })
    };
    results.audits.iter().map(line).collect()
}
