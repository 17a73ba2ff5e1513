//! Reads the prose, which is templates, at run time.

use crate::input::{self, remedy};
use std::collections::BTreeMap;
use std::path::Path;

/// Endings of the files that are templates or data for them (fonts live there too).
const TEXT: [&str; 8] = [".md", ".tex", ".bib", ".toml", ".html", ".css", ".js", ".json"];

/// Default frames of the documents, and empty files, for a folder that lacks them.
const SKIN: [(&str, &str); 8] = [
    ("data.html", include_str!("../skin/data.html")),
    ("literals.toml", ""),
    ("published.toml", ""),
    ("references.bib", ""),
    ("report.css", STYLE),
    ("report.html", include_str!("../skin/report.html")),
    ("report.js", SCRIPT),
    ("report.tex", include_str!("../skin/report.tex")),
];

/// Joins files of the skin, one for each feature, to one that a page loads.
macro_rules! joined {
    ($folder:literal, $ending:literal, $($name:literal),+) => {
        concat!($(include_str!(concat!("../skin/", $folder, "/", $name, $ending))),+)
    };
}
#[rustfmt::skip]
const STYLE: &str = joined!(
    "style", ".css", "base", "figures", "tables", "labs", "navigation", "verdicts", "cards", "wide", "narrow", "front", "print"
);
#[rustfmt::skip]
const SCRIPT: &str = concat!("\"use strict\";\n{\n", joined!(
    "script", ".js", "start", "outside", "labs", "cards", "groups", "enlarge", "points", "previews", "contents", "search", "cite", "folds", "filters", "end"
), "}\n");

#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("{path}: {source}; {}", remedy(source, "check --templates"))]
    Read { path: String, source: std::io::Error },
    #[error("{0}: no such file in the templates; give the folder that has all of them")]
    Missing(String),
}

/// The prose and all that stands with it, by paths within its folder.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Templates {
    files: BTreeMap<String, String>,
    /// Their folder, as messages show it: `prose/`.
    folder: String,
}

impl Templates {
    pub(crate) fn from_files<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let files = SKIN.into_iter().chain(files);
        let files = files.map(|(path, text)| (path.to_string(), text.to_string())).collect();
        Templates { files, ..Templates::default() }
    }

    pub(crate) fn read(folder: &Path) -> Result<Self, Error> {
        let mut templates = Templates::from_files([]);
        let here = std::env::current_dir().unwrap_or_default();
        templates.folder = format!("{}/", folder.strip_prefix(here).unwrap_or(folder).display());
        templates.add(folder, "")?;
        Ok(templates)
    }

    fn add(&mut self, folder: &Path, prefix: &str) -> Result<(), Error> {
        let fail = |path: &Path, source| Error::Read { path: path.display().to_string(), source };
        for entry in std::fs::read_dir(folder).map_err(|e| fail(folder, e))? {
            let path = entry.map_err(|e| fail(folder, e))?.path();
            // Hidden files are locks and backups of editors.
            let name = path.file_name().and_then(|name| name.to_str());
            let Some(name) = name.filter(|name| !name.starts_with('.')) else { continue };
            if path.is_dir() && !path.is_symlink() {
                self.add(&path, &format!("{prefix}{name}/"))?;
            } else if TEXT.iter().any(|end| name.ends_with(end)) {
                let content = input::read_text(&path).map_err(|e| fail(&path, e))?;
                self.files.insert(format!("{prefix}{name}"), content);
            }
        }
        Ok(())
    }

    /// Returns the text of a file; it is an error if there is none.
    pub fn text(&self, path: &str) -> Result<&str, Error> {
        let missing = || Error::Missing(path.to_string());
        self.files.get(path).map(String::as_str).ok_or_else(missing)
    }

    /// Returns a path as messages show it, from the current folder.
    pub(crate) fn place(&self, path: &str) -> String {
        format!("{}{path}", self.folder)
    }

    /// Returns the paths and texts of all files.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.files.iter().map(|(path, text)| (path.as_str(), text.as_str()))
    }
}
