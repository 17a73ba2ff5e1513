//! What the lists in a folder say that the program wrote there.

use super::{Failure, folder};
use crate::report::{Document, Files, LAB, PROGRAM, ledger, sums};
use literate::digest::sha256;
use literate::input::{is_absent, one_line};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// What the program knows that it wrote into a folder.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Own {
    /// Digests by path, of one list or of both.
    pub digests: BTreeMap<String, Vec<String>>,
    /// Paths that the list of a report has.
    pub report: Vec<String>,
    /// The list of what was last written.
    local: Vec<sums::Entry>,
    /// Whether there is such a list, and none that can be used.
    pub unusable: bool,
}

impl Own {
    /// From the lists in a folder; none if it has none. Forced, it does without one that cannot be used.
    ///
    /// # Errors
    /// What is wrong with a list, and what to do.
    pub fn read(folder: &Path, force: bool) -> Result<Option<Own>, Failure> {
        let usable = |list: Result<_, Failure>| match list {
            Err(failure) if force && failure.code == 2 => Ok(None),
            list => list,
        };
        let local = local(folder);
        let mut own = Own { unusable: local.is_err(), ..Own::default() };
        let (local, report) = (usable(local)?, usable(report(folder))?);
        if report.is_none() && local.is_none() && !own.unusable {
            return Ok(None);
        }
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

/// The list of what was last written into a folder, if there is one. What it names is replaced, and it is written anew,
/// so it may name nothing else than this program writes into folders.
///
/// # Errors
/// What is wrong with it, and what to do.
fn local(folder: &Path) -> Result<Option<Vec<sums::Entry>>, Failure> {
    let remedy = "move it away, or write over it with --force";
    let list = folder::local(folder, remedy)?;
    let written = |path: &str| {
        let beside = || folder::is_beside(path) && (path.contains('/') || is_document(path));
        sums::is_of_report(path) || path == LAB || beside()
    };
    let lines = list.iter().flatten().enumerate();
    match lines.into_iter().find(|(_, entry)| !written(&entry.path)) {
        None => Ok(list),
        Some((i, entry)) => {
            let (place, path) = (folder.join(sums::LOCAL), one_line(&entry.path, 200));
            let what = format!("line {}: {path:?} is no file of this program", i + 1);
            Err(Failure::input(format!("{}: {what}; {remedy}", place.display())))
        }
    }
}

/// Is it a file of one of our documents?
fn is_document(path: &str) -> bool {
    PROGRAM.documents.iter().flat_map(Document::paths).any(|own| own == path)
}

/// Is it a report, or what is left of one?
///
/// # Errors
/// The system does not let anybody see.
pub fn holds_report(folder: &Path) -> io::Result<bool> {
    Ok(list(folder)?.is_some() || has_ledger(folder)?)
}

/// A file as text; none if it is not there, or cannot be a list of ours.
///
/// # Errors
/// The system does not let it be read.
fn text(folder: &Path, path: &str) -> io::Result<Option<String>> {
    match folder::text(folder, path) {
        Err(error) if error.raw_os_error().is_some() && !is_absent(&error) && folder.is_dir() => {
            Err(error)
        }
        text => Ok(text.ok()),
    }
}

/// Other people have files of this name too.
fn has_ledger(folder: &Path) -> io::Result<bool> {
    Ok(text(folder, "ledger.json")?.is_some_and(|text| ledger::is_one(&text)))
}

/// The list of the report in a folder as text, if there is one. Other people have lists of this name too: that of a
/// report names its values and its ledger.
fn list(folder: &Path) -> io::Result<Option<String>> {
    let has = |text: &str, path| text.lines().any(|line| line.ends_with(&format!("  {path}")));
    let names = |text: &String| has(text, "values.json") && has(text, "ledger.json");
    Ok(text(folder, sums::NAME)?.filter(names))
}

/// The list of the report in a folder, if there is one beside its ledger. What it names is replaced and removed, so it
/// may name nothing else than a report has, whoever wrote it.
fn report(folder: &Path) -> Result<Option<Vec<sums::Entry>>, Failure> {
    let [place, ledger] = [sums::NAME, "ledger.json"].map(|name| folder.join(name));
    let remedy = "see that it can be read, or write over the report with --force";
    let unread = |place: &Path, error| Failure::io(&error, place.display(), remedy);
    let list = list(folder).map_err(|error| unread(&place, error))?;
    // A ledger that was lost takes nothing from the list; one that is none makes it a list of other files.
    let beside = self::text(folder, "ledger.json").map_err(|error| unread(&ledger, error))?;
    let ours = beside.is_none_or(|text| ledger::is_one(&text));
    let Some(text) = list.filter(|_| ours) else { return Ok(None) };
    let fault = |what: String| Failure::input(format!("{}: {what}", place.display()));
    let malformed =
        |error| fault(format!("{error}; mend it, or write over the report with --force"));
    let list = sums::lines(&text).map_err(malformed)?;
    match list.iter().find(|entry| !sums::is_of_report(&entry.path)) {
        None => Ok(Some(list)),
        Some(strange) => {
            let path = one_line(&strange.path, 200);
            let remedy = "take its line out, or write over the report with --force";
            Err(fault(format!("{path:?} is no file of a report; {remedy}")))
        }
    }
}
