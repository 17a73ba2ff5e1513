//! What the templates can name: the values of each section, and the rows of the generated tables.
//!
//! A value is computed here from results and carries the path of the function that computed it, which the
//! compiler gives ([`super::values::origin`]). Groups
//! are `v` (ours), `paper` (numbers that the paper chose), `printed` (numbers in its statements), and
//! one for the cells of each table: `readings`, `compare`, `protocol`, `protocols`, `long`,
//! `orbits`, `chains`, `sizes`, `starts` and `bias`.

mod accuracy;
mod ledger;

use super::claims::printed;
use super::mark::framed;
use super::values::{Origin, Registry, Value};
use crate::claims::{self, Check, Published};
use crate::experiments::Results;
use std::collections::BTreeMap;

/// What can go wrong between results and values.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A result or a printed number is missing.
    #[error(transparent)]
    Claims(#[from] claims::Error),
    /// An experiment was not run.
    #[error(transparent)]
    Experiment(#[from] crate::experiments::Error),
    /// Rows that are not JSON.
    #[error("the rows of a table: {0}")]
    Rows(#[from] serde_json::Error),
    /// A value that the registry refuses.
    #[error(transparent)]
    Report(#[from] super::Error),
    /// Results without the row that a sentence is about.
    #[error("the report speaks of {0}, which the results do not have; run a fuller profile")]
    Missing(&'static str),
}

/// Makes some values of the report from results.
pub type Section = fn(&Results) -> Result<Vec<Value>, Error>;

/// All values but what the paper printed, in the order of the report.
pub const SECTIONS: [Section; 1] = [|results| Ok(ledger::values(results))];

/// All values of the report.
///
/// # Errors
/// If a result is missing, or two values have one id.
pub fn registry(results: &Results, published: &Published) -> Result<Registry, Error> {
    let mut registry = Registry::new();
    registry.extend(printed(published))?;
    for section in SECTIONS {
        registry.extend(section(results)?)?;
    }
    results.tables().values().try_for_each(|table| registry.add_table(table.clone()))?;
    Ok(registry)
}

/// The rows of the generated tables, by the name that templates use; beside them heads and words that depend on the
/// results.
pub fn rows(
    results: &Results,
    claims: &[Check],
) -> Result<BTreeMap<&'static str, serde_json::Value>, Error> {
    Ok(BTreeMap::from([
        ("scorecard", serde_json::to_value(ledger::scorecard(claims))?),
        ("basis_table", serde_json::to_value(ledger::bases(claims))?),
        ("strip", serde_json::to_value(ledger::strip(claims))?),
        ("scene_heads", serde_json::to_value(accuracy::scene_heads(results)?)?),
        ("scene_table", serde_json::to_value(accuracy::scene_table(results)?)?),
    ]))
}

/// The value with this id, as a template writes it.
fn mark(id: impl Into<String>) -> String {
    framed(&id.into(), "")
}

/// With the item that computed them, for all values of one place that do not name their own.
fn from(values: Vec<Value>, item: Origin, experiment: &str) -> Vec<Value> {
    let one = |value: Value| match value.source.is_empty() {
        true => value.source(item.clone(), experiment),
        false => value,
    };
    values.into_iter().map(one).collect()
}
