//! A report on disk, held against its own lists.

use super::output::names;
use super::waiting::is_staging;
use super::{Failure, folder, shown, stdout, work};
use crate::experiments::{Progress, alive};
use crate::params::Profile;
use crate::report::values::Number;
use crate::report::{compare, sums};
use literate::digest::sha256;
use literate::input::is_obeyed;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;

/// What a comparison of all files found.
pub struct Checked {
    /// How many files were compared.
    pub files: usize,
    /// What a file without fault is, after the number of files.
    pub fine: String,
    /// One line for each file with a fault.
    pub faults: Vec<String>,
}

impl Checked {
    /// Tells each fault in a line of standard output, or that there is none.
    pub fn tell(&self, folder: &Path) -> Result<(), Failure> {
        for fault in &self.faults {
            stdout::print(&format!("{}\n", fault.replace(is_obeyed, " ")))?;
        }
        if self.faults.is_empty() {
            let folder = shown(folder);
            stdout::print(&format!("{folder}: {} files{}\n", self.files, self.fine))?;
        }
        Ok(())
    }
}

/// Compares the folder with its list.
///
/// # Errors
/// Exit code 2 if there is no list that can be read.
pub fn listed(root: &Path, progress: &Progress) -> Result<Checked, Failure> {
    let _alive = alive(|| Some("comparing files with their list".into()));
    let place = root.join(sums::NAME);
    let unusable = |what: String| {
        let remedy = format!("{} makes the report anew", folder::anew(root));
        Failure::input(format!("{}: {what}; {remedy}", place.display()))
    };
    let [list, local] = [sums::NAME, sums::LOCAL].map(|name| root.join(name).symlink_metadata());
    let ledger = root.join("ledger.json").symlink_metadata();
    let begun = |name: &String| is_staging(root, name);
    if list.is_err() && names(root).is_ok_and(|names| names.iter().any(begun)) {
        let what = "it is not there: a run that puts the report into place was ended, or goes on";
        return Err(unusable(what.into()));
    }
    if local.is_ok() && list.is_err() && ledger.is_err() {
        let (root, local) = (root.display(), sums::LOCAL);
        return Err(Failure::input(format!(
            "{root}: it holds single files and no report; `sha256sum --check {local}` in it checks them"
        )));
    }
    let text = folder::text(root, sums::NAME)
        .map_err(|error| Failure::io(&error, place.display(), folder::REMEDY))?;
    let entries = sums::read(&text).map_err(|e| unusable(e.to_string()))?;
    let found = folder::walk(root, progress)?;
    let mut known: BTreeMap<&str, &str> = BTreeMap::new();
    // Of what was last written, what is built beside: the rest may be of another revision by now.
    let remedy = format!("move it away; {} writes the report anew", folder::anew(root));
    let local = folder::local(root, &remedy)?.unwrap_or_default();
    let beside = |entry: &&sums::Entry| folder::is_beside(&entry.path);
    for entry in local.iter().filter(beside).chain(&entries) {
        known.insert(&entry.path, &entry.digest);
    }
    let mut faults = Vec::new();
    let mut fault =
        |what: &str, path: &str, more: &str| faults.push(format!("{what:8} {path}{more}"));
    for (path, digest) in &known {
        progress.check()?;
        match folder::read(root, path) {
            Ok(bytes) if sha256(&bytes) == *digest => (),
            Ok(_) => fault("differs", path, ""),
            Err(error) if error.kind() == ErrorKind::NotFound => fault("missing", path, ""),
            Err(error) => {
                Failure::of_the_system(&error, root.join(path).display())?;
                fault("unread", path, &format!(" ({error})"));
            }
        }
    }
    let lists = [sums::NAME, sums::LOCAL];
    let strange =
        |path: &&String| !lists.contains(&path.as_str()) && !known.contains_key(path.as_str());
    for path in found.iter().filter(strange) {
        fault("unlisted", path, "");
    }
    let fine = format!(", all as {} lists them", sums::NAME);
    Ok(Checked { files: known.len(), fine, faults })
}

/// The profile that the report's values name.
///
/// # Errors
/// Exit code 2 if they name none.
pub fn own_profile(root: &Path) -> Result<Profile, Failure> {
    let unknown = |what: &str| {
        let anew = folder::anew(root);
        Failure::input(format!(
            "{}: values.json {what}; restore it, or {anew} writes the report anew",
            root.display()
        ))
    };
    let text = folder::text(root, "values.json").or_else(|error| {
        Failure::of_the_system(&error, root.join("values.json").display())?;
        Err(unknown("cannot be read"))
    })?;
    let values = compare::read(&text).map_err(|_| unknown("is not one of a report"))?;
    match values.get("profile").map(|value| &value.number) {
        Some(Number::Text(name)) => work::profile(name)
            .ok_or_else(|| unknown("names a profile that this program does not have")),
        _ => Err(unknown("names no profile")),
    }
}
