//! What the lists in a folder say that the program wrote there.

use super::folder;
use crate::digest::sha256;
use crate::input::one_line;
use crate::report::{Files, sums};
use std::collections::BTreeMap;
use std::path::Path;

/// What the program knows that it wrote into a folder.
#[derive(Debug, Default)]
pub struct Own {
    /// Digests by path, of one list or of both.
    pub digests: BTreeMap<String, Vec<String>>,
    /// Paths that the list of a report has.
    pub report: Vec<String>,
    /// The list of what was last written.
    local: Vec<sums::Entry>,
}

impl Own {
    /// From the lists in a folder; none if it has none.
    ///
    /// # Errors
    /// What is wrong with a list, and what to do.
    pub fn read(folder: &Path) -> Result<Option<Own>, String> {
        let local = folder::local(folder)?;
        let report = report(folder)?;
        if report.is_none() && local.is_none() {
            return Ok(None);
        }
        let mut own = Own::default();
        for entry in report.iter().chain(&local).flatten() {
            own.digests.entry(entry.path.clone()).or_default().push(entry.digest.clone());
        }
        own.report = report.iter().flatten().map(|entry| entry.path.clone()).collect();
        own.local = local.unwrap_or_default();
        Ok(Some(own))
    }

    /// Whether it wrote these bytes under this path. A list of a report says nothing that is not made
    /// again.
    pub fn wrote(&self, path: &str, bytes: &[u8]) -> bool {
        if path == sums::NAME {
            return !self.report.is_empty();
        }
        self.digests.get(path).is_some_and(|digests| digests.contains(&sha256(bytes)))
    }

    /// The list of what was last written, with `files`, and without what is not there any more. `both`: with the
    /// digests of what these replace.
    pub fn local(&self, files: &Files, stands: impl Fn(&str) -> bool, both: bool) -> String {
        let stays = |path: &str| stands(path) && (both || !files.contains_key(path));
        let kept = self.local.iter().filter(|entry| stays(&entry.path));
        let kept = kept.map(|entry| (entry.path.as_str(), entry.digest.clone()));
        let new = files.iter().filter(|(path, _)| *path != sums::NAME);
        let new = new.map(|(path, bytes)| (path.as_str(), sha256(bytes)));
        let mut lines: Vec<(&str, String)> = kept.chain(new).collect();
        // The old digest of a path before the new one.
        lines.sort_by_key(|(path, _)| *path);
        lines.into_iter().map(|(path, digest)| format!("{digest}  {path}\n")).collect()
    }
}

/// Whether the list in a folder is that of a report.
pub fn lists_report(folder: &Path) -> bool {
    list(folder).is_some()
}

/// The list of the report in a folder as text, if there is one. Other people have lists of this name too: that of a
/// report names its values and its ledger.
fn list(folder: &Path) -> Option<String> {
    let text = folder::text(folder, sums::NAME).ok()?;
    let has = |path: &str| text.lines().any(|line| line.ends_with(&format!("  {path}")));
    (has("values.json") && has("ledger.json")).then_some(text)
}

/// The list of the report in a folder, if there is one. What it names is replaced and removed, so it may name nothing
/// else than a report has, whoever wrote it.
fn report(folder: &Path) -> Result<Option<Vec<sums::Entry>>, String> {
    let Some(text) = list(folder) else { return Ok(None) };
    let fault = |what: String| format!("{}: {what}", folder.join(sums::NAME).display());
    let list = sums::lines(&text).map_err(|error| fault(error.to_string()))?;
    match list.iter().find(|entry| !sums::is_of_report(&entry.path)) {
        None => Ok(Some(list)),
        Some(strange) => {
            let path = one_line(&strange.path, 200);
            Err(fault(format!("{path:?} is no file of a report; take its line out")))
        }
    }
}
