//! What changed between two reports: numbers, verdicts, prose, and files.

mod claims;
mod numbers;
mod prose;
mod sentences;

pub use claims::ClaimChange;
pub use numbers::{Change, changes, read};
pub use prose::{Piece, ProseChange, SentenceChange};

use super::ledger::{self, Ledger};
use super::{Document, Files, Registry, sums};
use serde::Serialize;
use std::collections::BTreeSet;

/// A report, with the parts that are compared as what they mean.
#[derive(Debug)]
pub struct Parts<'a> {
    name: &'a str,
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
    /// Documents with other text.
    pub prose: Vec<ProseChange>,
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

impl<'a> Parts<'a> {
    /// Reads values and claims of a report, which errors call `name`.
    pub fn of(name: &'a str, files: Files) -> Result<Self, String> {
        let fault = |what: String| format!("{name}: {what}");
        let values = read(text(name, &files, "values.json")?).map_err(|e| fault(e.to_string()))?;
        let ledger = ledger::read(text(name, &files, "ledger.json")?);
        let ledger = ledger.map_err(|error| fault(error.to_string()))?;
        Ok(Parts { name, files, values, ledger })
    }

    /// Leaves what one document shows.
    pub fn only(&mut self, document: &str) -> Result<(), String> {
        self.ledger
            .only(document, &mut self.values)
            .map_err(|error| format!("{}: {error}", self.name))?;
        let shown = &self.ledger.documents[document];
        self.files.retain(|path, _| shown.files.contains(path));
        Ok(())
    }
}

fn text<'a>(name: &str, files: &'a Files, path: &str) -> Result<&'a str, String> {
    let bytes = files.get(path).ok_or_else(|| format!("{name}: {path} is missing"))?;
    std::str::from_utf8(bytes).map_err(|error| format!("{name}: {path}: {error}"))
}

/// What differs. The prose of these documents is read where its bytes differ.
pub fn diff(before: &Parts<'_>, after: &Parts<'_>, documents: &[Document]) -> Result<Diff, String> {
    let known = |files: &'_ Files| -> BTreeSet<String> {
        files.keys().filter(|path| *path != sums::NAME).cloned().collect()
    };
    let (old, new) = (known(&before.files), known(&after.files));
    let mut out = Diff {
        verdicts: claims::changes(&before.ledger.claims, &after.ledger.claims),
        numbers: changes(&before.values, &after.values),
        gained: new.difference(&old).cloned().collect(),
        lost: old.difference(&new).cloned().collect(),
        ..Diff::default()
    };
    let differing = |path: &&String| before.files[*path] != after.files[*path];
    let differing: Vec<&String> = old.intersection(&new).filter(differing).collect();
    for document in documents.iter().filter(|d| differing.iter().any(|path| *path == d.markdown)) {
        let [old, new] = [before, after].map(|of| text(of.name, &of.files, document.markdown));
        let change = ProseChange::between(document.name, old?, new?);
        out.prose.push(change.map_err(|what| format!("{}: {what}", document.markdown))?);
    }
    out.differing = differing.into_iter().cloned().collect();
    Ok(out)
}

#[cfg(test)]
mod tests;
