//! Folders that are no place for what a verb writes: reports, prose, links to nowhere.

use super::output::FOLDERS;
pub use super::own::holds_report;
use super::sources::prose;
use super::{Failure, folder};
use std::path::{Path, PathBuf};

/// Files by which a folder of prose is known.
pub(super) const PROSE: [&str; 3] = ["published.toml", "literals.toml", "references.bib"];

/// Is it, without links and dots, below a report, which has no other files?
pub(super) fn lies_in_report(there: &Path) -> bool {
    // What nobody may see higher up is somebody else's.
    there.ancestors().skip(1).any(|above| holds_report(above).unwrap_or(false))
}

/// Of the prose, whatever lies in its folder or below is read: that of `templates`, and that of the checkout.
///
/// # Errors
/// Exit code 2 for a folder in which what is written would be taken for prose.
pub fn refuse_prose(option: &str, folder: &Path, templates: Option<&Path>) -> Result<(), Failure> {
    let there = folder::resolved(folder);
    let given = templates.map(PathBuf::from);
    let prose: Vec<PathBuf> =
        given.into_iter().chain(prose()).map(|prose| folder::resolved(&prose)).collect();
    // That of another checkout, or of one that is not seen from here.
    let among = |above: &Path| PROSE.iter().all(|file| above.join(file).is_file());
    if prose.iter().any(|prose| there.starts_with(prose)) || there.ancestors().any(among) {
        let here = folder::resolved(Path::new("."));
        if folder.is_relative() && here.ancestors().any(among) {
            let what = "the working folder is that of the templates, or lies in it; change to the checkout";
            return Err(Failure::input(what));
        }
        let what = "is the folder of the templates, or lies in it; give another folder";
        return Err(Failure::input(format!("{option}: {} {what}", folder.display())));
    }
    let written = FOLDERS.map(|below| there.join(below));
    if prose.iter().any(|prose| written.iter().any(|below| prose.starts_with(below))) {
        let what = "has the templates where figures and data go; give another folder";
        return Err(Failure::input(format!("{option}: {} {what}", folder.display())));
    }
    Ok(())
}

/// Refuses a link that leads nowhere, below which nothing can be made.
pub(super) fn refuse_dangling(option: &str, folder: &Path) -> Result<(), Failure> {
    if folder.is_symlink() && folder.metadata().is_err() {
        let what = "a symbolic link that leads to no folder; remove it, or give another";
        return Err(Failure::input(format!("{option}: {}: {what}", folder.display())));
    }
    Ok(())
}

/// A report and its folders have no other files; nor has the prose.
///
/// # Errors
/// Exit code 2 for a folder in which nothing else may be written.
pub fn refuse_report(option: &str, folder: &Path, templates: Option<&Path>) -> Result<(), Failure> {
    refuse_dangling(option, folder)?;
    refuse_prose(option, folder, templates)?;
    let there = folder::resolved(folder);
    let holds = holds_report(&there).map_err(|error| {
        let what = format!("{option}: {}: its lists", folder.display());
        Failure::io(&error, what, "see that they can be read, or give another folder")
    })?;
    if holds || lies_in_report(&there) {
        let folder = folder.display();
        return Err(Failure::input(format!(
            "{option}: {folder} holds a report, or lies in one; give another folder"
        )));
    }
    Ok(())
}
