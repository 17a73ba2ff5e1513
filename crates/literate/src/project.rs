//! Finds the files of a project that the program reads when it runs: prose, printed numbers, data.
//!
//! The project is the first folder from the current one upwards that has its source, or else the
//! folder that the environment variable `LITERATE_PROJECT` names. A program that travels alone has
//! a copy inside.

use crate::input::{self, sha256};
use crate::source::Sources;
use std::collections::BTreeMap;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// The source of a program, and the folder in which it is developed.
#[derive(Debug)]
pub struct Project {
    /// The source as it was compiled.
    pub sources: Sources,
    /// Paths and texts of what it reads when it runs; empty unless it travels alone.
    pub copy: &'static [(&'static str, &'static str)],
    /// Code that changes no result, by the beginning or end of its path, with the reason. All other
    /// code of the program counts for each result, unless it is an experiment's own.
    pub apart: &'static [(&'static str, &'static str)],
    /// Code that counts for each result although it lies in a folder that is apart.
    pub shared: &'static [&'static str],
}

pub(crate) fn is_in(path: &str, place: &str) -> bool {
    let place = place.strip_prefix("./").unwrap_or(place);
    let place = place.strip_suffix('/').unwrap_or(place);
    path.strip_prefix(place).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

impl Project {
    /// Makes a project in which all code counts for each result.
    pub fn new(sources: Sources) -> Self {
        Project { sources, copy: &[], apart: &[], shared: &[] }
    }

    /// Returns whether a file counts for an experiment with some code of its own, of all that is
    /// `owned`. What is apart counts only for one that lists it by its whole path.
    pub fn counts(&self, path: &str, own: &[&str], owned: &[&str]) -> bool {
        let among = |places: &[&str]| places.iter().any(|place| is_in(path, place));
        let is_apart = |(place, _): &(&str, _)| path.ends_with(place) || is_in(path, place);
        if [own, self.shared].iter().any(|places| places.contains(&path)) {
            return true;
        }
        let is_owned = among(owned) && !among(own);
        !self.apart.iter().any(is_apart) && (!is_owned || among(self.shared))
    }

    /// Computes the hashes of files and folders that an experiment reads when it runs.
    pub(crate) fn hashes(&self, reads: &[&str]) -> io::Result<BTreeMap<String, String>> {
        let mut hashes = BTreeMap::new();
        for place in reads {
            match self.copied(place) {
                Some(text) if self.find(place).is_none() => {
                    hashes.insert(place.to_string(), sha256(text));
                }
                _ => hashes.extend(input::hash_files(&self.folder(), place)?),
            }
        }
        Ok(hashes)
    }

    pub(crate) fn copied(&self, path: &str) -> Option<&'static str> {
        self.copy.iter().find(|(known, _)| *known == path).map(|(_, text)| *text)
    }

    /// Checks that files that an experiment lists are there, or says what to do.
    pub(crate) fn check_listed(&self, files: &[&str]) -> Result<(), (String, &'static str)> {
        let is_source = |place: &str| self.sources.files.iter().any(|(path, _)| is_in(path, place));
        let is_there = |place: &str| {
            is_source(place) || self.copied(place).is_some() || self.folder().join(place).exists()
        };
        let Some(absent) = files.iter().find(|place| !is_there(place)) else { return Ok(()) };
        let remedy = match self.top() {
            Some(_) => "correct the path",
            None => "run this in the project, or name its folder in LITERATE_PROJECT",
        };
        Err((format!("it lists {absent}, which is not there"), remedy))
    }

    /// Returns the path to a file or folder of the project, or `None` if only the copy has it.
    pub fn find(&self, path: &str) -> Option<PathBuf> {
        Some(self.path_to_top()?.join(path)).filter(|place| place.exists())
    }

    /// Returns the path to the top of the project, by the current folder or the environment.
    fn path_to_top(&self) -> Option<PathBuf> {
        self.path_up().or_else(|| std::env::var_os("LITERATE_PROJECT").map(PathBuf::from))
    }

    /// Returns the path up to the top of the project, or `None` if it is not above.
    fn path_up(&self) -> Option<PathBuf> {
        let (path, _) = self.sources.files.iter().find(|(path, _)| path.contains('/'))?;
        let here = std::env::current_dir().ok()?;
        let above = here.ancestors().position(|folder| folder.join(path).is_file())?;
        Some("../".repeat(above).into())
    }

    /// Returns where a file is written: below the top of the project, or else the current folder.
    pub(crate) fn place(&self, path: &str) -> PathBuf {
        self.path_up().unwrap_or_default().join(path)
    }

    /// Returns the top of the project, or `None` if the program runs without a checkout.
    pub(crate) fn top(&self) -> Option<PathBuf> {
        std::env::current_dir().ok()?.join(self.path_to_top()?).canonicalize().ok()
    }

    pub(crate) fn folder(&self) -> PathBuf {
        self.top().unwrap_or_else(|| ".".into())
    }

    /// Returns a file of the source that has changed since the build, or `None` if none has.
    pub(crate) fn changed(&self) -> Option<&'static str> {
        let top = self.top()?;
        let differs = |path: &str, text: &str| {
            std::fs::read_to_string(top.join(path)).is_ok_and(|now| now != text)
        };
        let file = self.sources.files.iter().find(|(path, text)| differs(path, text));
        file.map(|(path, _)| *path)
    }

    /// Returns whether a file or folder of the project exists; without a checkout all do.
    pub(crate) fn exists(&self, path: &str) -> bool {
        self.top().is_none_or(|top| top.join(path).exists())
    }

    /// Returns the path from a folder, which may be absent, up to the top of the project, as `../`,
    /// or `None` if it lies elsewhere.
    pub(crate) fn way_up(&self, folder: &Path) -> Option<String> {
        let folder = std::path::absolute(folder).ok()?;
        let real =
            |above: &Path| Some(above.canonicalize().ok()?.join(folder.strip_prefix(above).ok()?));
        let folder = folder.ancestors().find_map(real)?;
        let below = folder.strip_prefix(self.top()?).ok()?.components().count();
        Some(if below == 0 { "./".into() } else { "../".repeat(below) })
    }

    /// Reads a file by its path from the top of the project.
    pub fn text(&self, path: &str) -> io::Result<String> {
        let missing = "it is not there; run this in the project";
        match (self.find(path), self.copied(path)) {
            (Some(place), _) => input::read_text(&place),
            (None, Some(text)) => Ok(text.into()),
            _ => Err(io::Error::new(ErrorKind::NotFound, missing)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::toy;

    #[test]
    fn what_is_listed_is_there_and_data_counts_as_bytes() {
        let project = Project::new(toy());
        assert_eq!(project.check_listed(&["src/flight.rs", "Cargo.toml"]), Ok(()));
        assert!(project.check_listed(&["src/fligth.rs"]).unwrap_err().0.contains("src/fligth.rs"));
        let hashes = project.hashes(&["fonts/OFL.txt"]).unwrap();
        assert_eq!(hashes["fonts/OFL.txt"], sha256(std::fs::read("fonts/OFL.txt").unwrap()));
        // What cannot be read is an error, and not a hash.
        let folder = tempfile::tempdir().unwrap();
        std::os::unix::fs::symlink("nowhere", folder.path().join("dangling")).unwrap();
        let place: &'static str = folder.path().display().to_string().leak();
        let error = project.hashes(&[place]).unwrap_err().to_string();
        assert!(error.contains("dangling: "), "{error}");
        let error = project.text("templates/no_such.md").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::NotFound);
    }

    #[test]
    fn a_file_that_was_edited_after_the_build_is_named() {
        let changed = |files| Project::new(Sources { files, ..toy() }).changed();
        assert_eq!(changed(&[("src/project.rs", include_str!("project.rs"))]), None);
        assert_eq!(changed(&[("src/project.rs", "before")]), Some("src/project.rs"));
    }
}
