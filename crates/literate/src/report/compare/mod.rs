//! What changed between two reports: numbers, verdicts, and files.

mod claims;
mod numbers;

pub use claims::ClaimChange;
pub use numbers::{Change, changes, read};

use super::folder::SUMS;
use super::ledger::{self, Ledger};
use super::{Files, Registry};
use serde::Serialize;
use std::collections::BTreeSet;

/// A report, with the parts that are compared as what they mean.
#[derive(Debug)]
pub struct Parts {
    files: Files,
    values: Registry,
    ledger: Ledger,
}

/// What differs, part by part; all empty for the same bytes.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Diff {
    /// Claims judged otherwise or held to another measure, gained and lost.
    pub verdicts: Vec<ClaimChange>,
    /// Values with another number, unit or kind, gained and lost.
    pub numbers: Vec<Change>,
    /// Files that only the later report has.
    pub gained: Vec<String>,
    /// Files that only the earlier report has.
    pub lost: Vec<String>,
    /// Files with other bytes.
    pub differing: Vec<String>,
}

impl Diff {
    /// Whether nothing differs.
    pub fn is_empty(&self) -> bool {
        *self == Diff::default()
    }
}

impl Parts {
    /// Reads values and claims of a report, which errors call `name`.
    pub fn of(name: &str, files: Files) -> Result<Self, String> {
        let fault = |what: String| format!("{name}: {what}");
        let values = read(text(name, &files, "values.json")?).map_err(|e| fault(e.to_string()))?;
        let ledger = ledger::read(text(name, &files, "ledger.json")?);
        let ledger = ledger.map_err(|error| fault(error.to_string()))?;
        Ok(Parts { files, values, ledger })
    }
}

fn text<'a>(name: &str, files: &'a Files, path: &str) -> Result<&'a str, String> {
    let bytes = files.get(path).ok_or_else(|| format!("{name}: {path} is missing"))?;
    std::str::from_utf8(bytes).map_err(|error| format!("{name}: {path}: {error}"))
}

/// What differs.
pub fn diff(before: &Parts, after: &Parts) -> Diff {
    let known = |files: &'_ Files| -> BTreeSet<String> {
        files.keys().filter(|path| *path != SUMS).cloned().collect()
    };
    let (old, new) = (known(&before.files), known(&after.files));
    let differing = |path: &&String| before.files[*path] != after.files[*path];
    Diff {
        verdicts: claims::changes(&before.ledger.claims, &after.ledger.claims),
        numbers: changes(&before.values, &after.values),
        gained: new.difference(&old).cloned().collect(),
        lost: old.difference(&new).cloned().collect(),
        differing: old.intersection(&new).filter(differing).cloned().collect(),
    }
}

#[cfg(test)]
mod tests;
