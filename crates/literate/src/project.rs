//! The files of a project: its source, by which saved results are known, and what the program reads
//! when it runs: prose, printed numbers, data.
//!
//! What is read is looked for below the current folder, then in the folders above the program
//! itself, one of which is the checkout in which it was built. A program that is to travel alone
//! has a copy inside instead.

use crate::input::{self, sha256};
use crate::source::Sources;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

#[derive(Debug)]
pub struct Project {
    /// Its source.
    pub sources: Sources,
    /// A copy of what it reads when it runs: path from the top of the project, and text; empty
    /// unless it travels alone.
    pub copy: &'static [(&'static str, &'static str)],
    /// Folders and files on which every result depends; those of an experiment come to them.
    pub shared: &'static [&'static str],
    /// Ends of paths that change no result.
    pub left_out: &'static [&'static str],
}

impl Project {
    /// A project with this source, of which each result depends on all.
    pub fn new(sources: Sources) -> Self {
        Project { sources, copy: &[], shared: &["Cargo.lock"], left_out: &[] }
    }

    /// Path and hash of every file on which a result depends: those that all share, and those in
    /// these files and folders; all if none is named.
    pub fn code(&self, files: &[&str]) -> BTreeMap<String, String> {
        let is_in = |path: &str, place: &str| {
            let rest = path.strip_prefix(place);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        let counts = |path: &str| {
            let named = self.shared.iter().chain(files).any(|place| is_in(path, place));
            (files.is_empty() || named) && !self.left_out.iter().any(|end| path.ends_with(end))
        };
        let all = self.sources.files.iter().filter(|(path, _)| counts(path));
        // The first 64 bits are enough.
        all.map(|(path, text)| (path.to_string(), sha256(text)[..16].to_string())).collect()
    }

    /// Where a file or folder lies, by its path from the top of the project; none if only the copy
    /// inside has it.
    pub fn find(&self, path: &str) -> Option<PathBuf> {
        let here = Path::new(path);
        if here.exists() {
            return Some(here.into());
        }
        if !self.copy.is_empty() {
            return None;
        }
        let program = std::env::current_exe().ok()?;
        program.ancestors().skip(1).map(|above| above.join(path)).find(|path| path.exists())
    }

    /// The top of the checkout, if there is one.
    fn top(&self) -> Option<PathBuf> {
        let (path, _) = self.sources.files.iter().find(|(path, _)| path.contains('/'))?;
        let found = self.find(path)?.canonicalize().ok()?;
        found.ancestors().nth(path.split('/').count()).map(Path::to_path_buf)
    }

    /// The folder in which commands run: the top of the checkout, or the current one.
    pub fn folder(&self) -> PathBuf {
        self.top().unwrap_or_else(|| ".".into())
    }

    /// The first file of the source that is not what it was when the program was built.
    pub fn changed(&self) -> Option<&'static str> {
        let top = self.top()?;
        let differs = |path: &str, text: &str| {
            std::fs::read_to_string(top.join(path)).is_ok_and(|now| now != text)
        };
        let file = self.sources.files.iter().find(|(path, text)| differs(path, text));
        file.map(|(path, _)| *path)
    }

    /// Whether a file or folder of the project is there. Without a checkout it counts as there.
    pub fn exists(&self, path: &str) -> bool {
        self.top().is_none_or(|top| top.join(path).exists())
    }

    /// The way from a folder, which may not be there yet, up to the checkout, as `../`; none if it
    /// lies outside.
    pub fn way_up(&self, folder: &Path) -> Option<String> {
        let folder = std::path::absolute(folder).ok()?;
        let real =
            |above: &Path| Some(above.canonicalize().ok()?.join(folder.strip_prefix(above).ok()?));
        let folder = folder.ancestors().find_map(real)?;
        let below = folder.strip_prefix(self.top()?).ok()?.components().count();
        Some(if below == 0 { "./".into() } else { "../".repeat(below) })
    }

    /// The text of a file, by its path from the top of the project.
    ///
    /// # Errors
    /// As [`input::regular_text`]; [`io::ErrorKind::NotFound`] with what to do if there is no such
    /// file.
    pub fn text(&self, path: &str) -> io::Result<Cow<'static, str>> {
        if let Some(found) = self.find(path) {
            return input::regular_text(&found).map(Cow::Owned);
        }
        let copy = self.copy.iter().find(|(known, _)| *known == path);
        let missing =
            || io::Error::new(io::ErrorKind::NotFound, "it is not there; run this in the project");
        copy.map(|(_, text)| Cow::Borrowed(*text)).ok_or_else(missing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::toy;

    #[test]
    fn a_result_depends_on_what_is_shared_and_what_is_named() {
        let files = &[
            ("Cargo.lock", "0"),
            ("src/a.rs", "1"),
            ("src/b/c.rs", "2"),
            ("src/b/tables.rs", "3"),
        ];
        let mut project = Project::new(Sources { files, ..toy() });
        let paths = |project: &Project, own: &[&str]| {
            project.code(own).into_keys().collect::<Vec<String>>().join(" ")
        };
        assert_eq!(paths(&project, &[]).split(' ').count(), 4, "all of it");
        (project.shared, project.left_out) = (&["Cargo.lock"], &["/tables.rs"]);
        assert_eq!(paths(&project, &["src/b"]), "Cargo.lock src/b/c.rs");
        assert_eq!(paths(&project, &["src/a.rs"]), "Cargo.lock src/a.rs");
        let error = project.text("templates/no_such.md").unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
    }

    #[test]
    fn a_file_that_was_edited_after_the_build_is_named() {
        let changed = |files| Project::new(Sources { files, ..toy() }).changed();
        assert_eq!(changed(&[("src/project.rs", include_str!("project.rs"))]), None);
        assert_eq!(changed(&[("src/project.rs", "before")]), Some("src/project.rs"));
    }
}
