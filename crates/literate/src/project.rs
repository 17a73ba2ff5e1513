//! Finds the files of a project: its source, on which saved results depend, and what the program
//! reads when it runs (prose, printed numbers, data).
//!
//! The project is the first folder from the current one upwards that has its source, or else the
//! folder that the environment variable `LITERATE_PROJECT` names. A program that travels alone has
//! a copy inside.

use crate::input::{self, sha256};
use crate::source::Sources;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

#[derive(Debug)]
pub struct Project {
    pub sources: Sources,
    /// Paths and texts of what it reads when it runs; empty unless it travels alone.
    pub copy: &'static [(&'static str, &'static str)],
    /// Folders and files on which every result depends, besides those that its experiment lists.
    pub shared: &'static [&'static str],
    /// Files that change no result, by the beginning or end of their paths, with the reason. They
    /// count only for an experiment that lists them by their whole path.
    pub left_out: &'static [(&'static str, &'static str)],
}

fn is_in(path: &str, place: &str) -> bool {
    let place = place.trim_start_matches("./").trim_end_matches('/');
    path.strip_prefix(place).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

impl Project {
    pub fn new(sources: Sources) -> Self {
        Project { sources, copy: &[], shared: &["Cargo.lock"], left_out: &[] }
    }

    /// Returns path and hash of every file on which a result depends: of what all results share,
    /// and of these files and folders, source or data; of the whole source if none is given.
    pub fn code(&self, files: &[&str]) -> BTreeMap<String, String> {
        let mut found = BTreeMap::new();
        for (path, text) in self.sources.files.iter().filter(|(path, _)| self.counts(path, files)) {
            // The first 64 bits are enough.
            found.insert(path.to_string(), sha256(text)[..16].to_string());
        }
        for place in files.iter().filter(|place| !self.is_source(place)) {
            match (input::hashes(&self.folder(), place), self.copied(place)) {
                (Ok(hashes), _) => found.extend(hashes),
                (Err(_), Some(text)) => found.extend([(place.to_string(), sha256(text))]),
                (Err(error), None) => found.extend([(place.to_string(), error.to_string())]),
            }
        }
        found
    }

    fn is_left_out(&self, path: &str) -> bool {
        self.left_out.iter().any(|(place, _)| path.ends_with(place) || is_in(path, place))
    }

    /// Returns whether a result depends on a file of the source, if its experiment lists these.
    fn counts(&self, path: &str, files: &[&str]) -> bool {
        let places: Vec<&str> = self.shared.iter().chain(files).copied().collect();
        let is_listed = files.is_empty() || places.iter().any(|place| is_in(path, place));
        places.contains(&path) || is_listed && !self.is_left_out(path)
    }

    fn is_source(&self, place: &str) -> bool {
        self.sources.files.iter().any(|(path, _)| is_in(path, place))
    }

    fn copied(&self, path: &str) -> Option<&'static str> {
        self.copy.iter().find(|(known, _)| *known == path).map(|(_, text)| *text)
    }

    /// Checks that files that an experiment lists are there, or says what to do.
    pub fn check_listed(&self, files: &[&str]) -> Result<(), (String, &'static str)> {
        let is_there = |place: &str| {
            let copied = self.copied(place).is_some();
            copied || self.is_source(place) || self.folder().join(place).exists()
        };
        let Some(lost) = files.iter().find(|place| !is_there(place)) else { return Ok(()) };
        let remedy = match self.top() {
            Some(_) => "correct the path",
            None => "run this in the project, or name its folder in LITERATE_PROJECT",
        };
        Err((format!("`code` lists {lost}, which is not there"), remedy))
    }

    /// Checks that files that an experiment lists, or those that all share, name no module that
    /// would change a result unnoticed, or says what to do.
    pub fn check_named(&self, files: &[&str]) -> Result<(), (String, &'static str)> {
        let remedy = "list that file too, or give the reason why it changes no result in \
                      `project.left_out`";
        let is_listed = |path: &str| files.iter().any(|place| is_in(path, place));
        for (path, text) in self.sources.files {
            if is_listed(path) && self.counts(path, files) {
                for named in self.sources.named_in(path, text) {
                    if !self.counts(named, files) && !self.is_left_out(named) {
                        let problem = format!("{path} names {named}, which is not listed");
                        return Err((problem, remedy));
                    }
                }
            }
        }
        Ok(())
    }

    /// Finds a file or folder of the project; none if only the copy inside has it.
    pub fn find(&self, path: &str) -> Option<PathBuf> {
        Some(self.path_to_top()?.join(path)).filter(|found| found.exists())
    }

    /// Returns the path to the top of the project, by the current folder or the environment.
    fn path_to_top(&self) -> Option<PathBuf> {
        self.path_up().or_else(|| std::env::var_os("LITERATE_PROJECT").map(PathBuf::from))
    }

    /// Returns the way from the current folder up to the top of the project, if it lies in it.
    fn path_up(&self) -> Option<PathBuf> {
        let (path, _) = self.sources.files.iter().find(|(path, _)| path.contains('/'))?;
        let here = std::env::current_dir().ok()?;
        let above = here.ancestors().position(|folder| folder.join(path).is_file())?;
        Some("../".repeat(above).into())
    }

    /// Returns where a file of the project is written: from outside, below the current folder.
    pub fn place(&self, path: &str) -> PathBuf {
        self.path_up().unwrap_or_default().join(path)
    }

    fn top(&self) -> Option<PathBuf> {
        std::env::current_dir().ok()?.join(self.path_to_top()?).canonicalize().ok()
    }

    pub fn folder(&self) -> PathBuf {
        self.top().unwrap_or_else(|| ".".into())
    }

    /// Returns the first file of the source that has changed since the program was built.
    pub fn changed(&self) -> Option<&'static str> {
        let top = self.top()?;
        let differs = |path: &str, text: &str| {
            std::fs::read_to_string(top.join(path)).is_ok_and(|now| now != text)
        };
        let file = self.sources.files.iter().find(|(path, text)| differs(path, text));
        file.map(|(path, _)| *path)
    }

    /// Returns whether a file or folder of the project exists; without a checkout all do.
    pub fn exists(&self, path: &str) -> bool {
        self.top().is_none_or(|top| top.join(path).exists())
    }

    /// Returns the way from a folder, which may be absent, up to the top: `../`; none from outside.
    pub fn way_up(&self, folder: &Path) -> Option<String> {
        let folder = std::path::absolute(folder).ok()?;
        let real =
            |above: &Path| Some(above.canonicalize().ok()?.join(folder.strip_prefix(above).ok()?));
        let folder = folder.ancestors().find_map(real)?;
        let below = folder.strip_prefix(self.top()?).ok()?.components().count();
        Some(if below == 0 { "./".into() } else { "../".repeat(below) })
    }

    /// Reads a file by its path from the top of the project.
    pub fn text(&self, path: &str) -> io::Result<Cow<'static, str>> {
        if let Some(found) = self.find(path) {
            return input::regular_text(&found).map(Cow::Owned);
        }
        let missing =
            || io::Error::new(io::ErrorKind::NotFound, "it is not there; run this in the project");
        self.copied(path).map(Cow::Borrowed).ok_or_else(missing)
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
            ("src/a.rs", "use crate::b::c;"),
            ("src/b/c.rs", "use super::tables;"),
            ("src/b/tables.rs", "use crate::a;"),
        ];
        let sources = Sources { files, crates: &[("", "src")], ..toy() };
        let mut project = Project::new(sources);
        let paths = |project: &Project, files: &[&str]| {
            project.code(files).into_keys().collect::<Vec<String>>().join(" ")
        };
        assert_eq!(paths(&project, &[]).split(' ').count(), 4, "all of it");
        assert_eq!(project.check_named(&[]), Ok(()));
        let problem = |project: &Project, files: &[&str]| project.check_named(files).unwrap_err().0;
        let lost = problem(&project, &["src/b/c.rs"]);
        assert_eq!(lost, "src/b/c.rs names src/b/tables.rs, which is not listed");
        project.left_out = &[("/tables.rs", "made of results")];
        assert_eq!(paths(&project, &["src/b"]), "Cargo.lock src/b/c.rs");
        assert_eq!(project.check_named(&["src/b"]), Ok(()));
        assert_eq!(paths(&project, &["src/b/tables.rs"]), "Cargo.lock src/b/tables.rs");
        assert_eq!(paths(&project, &["src/a.rs"]), "Cargo.lock src/a.rs");
        let lost = problem(&project, &["src/a.rs"]);
        assert_eq!(lost, "src/a.rs names src/b/c.rs, which is not listed");
        assert_eq!(project.check_named(&["./src/a.rs", "src/b/"]), Ok(()));
        let error = project.text("templates/no_such.md").unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
    }

    #[test]
    fn what_is_listed_is_there_and_data_counts_as_bytes() {
        let project = Project::new(toy());
        assert_eq!(project.check_listed(&["src/flight.rs", "Cargo.toml"]), Ok(()));
        assert!(project.check_listed(&["src/fligth.rs"]).unwrap_err().0.contains("src/fligth.rs"));
        let code = project.code(&["fonts/OFL.txt"]);
        assert_eq!(code["fonts/OFL.txt"], sha256(std::fs::read("fonts/OFL.txt").unwrap()));
    }

    #[test]
    fn a_file_that_was_edited_after_the_build_is_named() {
        let changed = |files| Project::new(Sources { files, ..toy() }).changed();
        assert_eq!(changed(&[("src/project.rs", include_str!("project.rs"))]), None);
        assert_eq!(changed(&[("src/project.rs", "before")]), Some("src/project.rs"));
    }
}
