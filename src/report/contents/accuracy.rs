//! Speed against accuracy: targets, and where methods fail.

use super::{Error, from};
use crate::claims::{self, targets};
use crate::experiments::Results;
use crate::experiments::accuracy::case::Verdict;
use crate::experiments::accuracy::tables::titled;
use crate::report::claims::sentence;
use crate::report::values::{Value, origin};
use serde::Serialize;

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let targets = targets::targets(results)?;
    let met = targets.iter().filter(|t| t.verdict == claims::Verdict::Reproduced).count();
    let both =
        vec![Value::integer("targets_met", met), Value::integer("targets_all", targets.len())];
    Ok(from(both, origin(targets::targets), ""))
}

/// A line of the table of targets.
#[derive(Debug, Serialize)]
pub struct TargetLine {
    what: String,
    bound: String,
    found: String,
    standing: &'static str,
}

/// The table of targets.
pub fn target_table(results: &Results) -> Result<Vec<TargetLine>, Error> {
    let line = |target: &claims::Check| TargetLine {
        what: target.statement.clone(),
        bound: sentence(&target.tolerance),
        found: sentence(&target.ours),
        standing: target.words(),
    };
    Ok(targets::targets(results)?.iter().map(line).collect())
}

/// A line of a table: a name, and a cell for each column.
#[derive(Debug, Serialize)]
pub struct Line {
    name: String,
    cells: Vec<String>,
}

/// Heads of the columns of the table of scenes.
pub fn scene_heads(results: &Results) -> Result<Vec<String>, Error> {
    Ok(results.trials()?.parameters.settings.iter().map(|s| titled(*s)).collect())
}

/// The table of scenes: in how many cases each method is right, and what goes wrong else.
pub fn scene_table(results: &Results) -> Result<Vec<Line>, Error> {
    let lines = results.trials()?.scenes.iter().map(|scene| Line {
        name: scene.what.clone(),
        cells: scene
            .trials
            .iter()
            .map(|trial| match trial.trouble() {
                None => "right".to_string(),
                Some(trouble) if trial.right() == 0 && trial.verdicts.len() == 1 => {
                    trouble.words().to_string()
                }
                Some(trouble) => {
                    let (right, all) = (trial.right(), trial.verdicts.len());
                    format!("{right} of {all}: {}", Verdict::words(trouble))
                }
            })
            .collect(),
    });
    Ok(lines.collect())
}
