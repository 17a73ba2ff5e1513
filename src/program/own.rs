//! What the lists in a folder say that the program wrote there.

use super::folder;
use crate::digest::sha256;
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
    /// From the lists in a folder; none if it has none. Other people have lists of this name too: one
    /// of a report names its values and its ledger.
    ///
    /// # Errors
    /// What is wrong with the list that only this program writes.
    pub fn read(folder: &Path) -> Result<Option<Own>, String> {
        let local = folder::local(folder)?;
        let list = |name: &str| sums::lines(&folder::text(folder, name).ok()?).ok();
        let has = |list: &Vec<sums::Entry>, path: &str| list.iter().any(|entry| entry.path == path);
        let report =
            list(sums::NAME).filter(|list| has(list, "values.json") && has(list, "ledger.json"));
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
