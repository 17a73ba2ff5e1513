//! Where methods fail.

use super::Error;
use crate::experiments::accuracy::case::Verdict;
use crate::experiments::accuracy::tables::titled;
use crate::experiments::accuracy::trials::{Trial, right, trouble};
use crate::experiments::{Results, TRIALS};
use serde::Serialize;

/// A line of a table: a name, and a cell for each column.
#[derive(Debug, Serialize)]
pub struct Line {
    name: String,
    cells: Vec<String>,
    /// How a reader of the method's output learns of a failure.
    told: &'static str,
}

/// Heads of the columns of the table of scenes.
pub fn scene_heads(results: &Results) -> Result<Vec<String>, Error> {
    Ok(results.of(&TRIALS)?.parameters.settings.iter().map(|s| titled(*s)).collect())
}

/// Whether failures in a scene end with an error or with a wrong result that looks like a right one. No method here
/// warns of a result that it gives.
fn told(trials: &[Trial]) -> &'static str {
    let any = |of: fn(Verdict) -> bool| trials.iter().flatten().any(|verdict| of(*verdict));
    match (any(|v| v == Verdict::GaveUp), any(|v| !matches!(v, Verdict::Right | Verdict::GaveUp))) {
        (false, false) => "–",
        (true, false) => "refused",
        (false, true) => "silent",
        (true, true) => "silent or refused",
    }
}

/// The table of scenes: in how many cases each method is right, and what goes wrong else.
pub fn scene_table(results: &Results) -> Result<Vec<Line>, Error> {
    let cell = |trial: &Trial| match (trouble(trial), right(trial), trial.len()) {
        (None, ..) => "right".to_string(),
        (Some(trouble), 0, 1) => trouble.words().to_string(),
        (Some(trouble), right, all) => {
            format!("{right} of {all} right, else {}", trouble.words())
        }
    };
    let line = |(what, trials): &(String, Vec<Trial>)| Line {
        name: what.clone(),
        cells: trials.iter().map(cell).collect(),
        told: told(trials),
    };
    Ok(results.of(&TRIALS)?.scenes.iter().map(line).collect())
}
