//! The templates: people's prose, read at run time; [`super::filler`] fills them.

use super::Error;
use crate::input;
use std::collections::BTreeMap;
use std::path::Path;

/// Endings of the files that are templates or data for them (fonts live there too).
const TEXT: [&str; 8] = [".md", ".tex", ".bib", ".toml", ".html", ".css", ".js", ".json"];

/// Frames of the documents, and empty files, for a folder that has none of these names.
const SKIN: [(&str, &str); 7] = [
    ("literals.toml", ""),
    ("published.toml", ""),
    ("references.bib", ""),
    ("report.css", include_str!("../../skin/report.css")),
    ("report.html", include_str!("../../skin/report.html")),
    ("report.js", include_str!("../../skin/report.js")),
    ("report.tex", include_str!("../../skin/report.tex")),
];

/// All template files, by path relative to their folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Templates(BTreeMap<String, String>);

impl Templates {
    /// Templates from texts.
    pub fn of<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let own = |(path, text): (&str, &str)| (path.to_string(), text.to_string());
        Templates(SKIN.into_iter().chain(files).map(own).collect())
    }

    /// Reads all templates of a folder.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let mut templates = Templates::of([]);
        templates.add(folder, "")?;
        Ok(templates)
    }

    fn add(&mut self, folder: &Path, prefix: &str) -> Result<(), Error> {
        let fail = |path: &Path, source| Error::Read { path: path.display().to_string(), source };
        for entry in std::fs::read_dir(folder).map_err(|e| fail(folder, e))? {
            let path = entry.map_err(|e| fail(folder, e))?.path();
            // Locks and copies of editors are hidden.
            let name = path.file_name().and_then(|name| name.to_str());
            let Some(name) = name.filter(|name| !name.starts_with('.')) else { continue };
            if path.is_dir() && !path.is_symlink() {
                self.add(&path, &format!("{prefix}{name}/"))?;
            } else if TEXT.iter().any(|end| name.ends_with(end)) {
                let text = input::regular_text(&path).map_err(|e| fail(&path, e))?;
                self.0.insert(format!("{prefix}{name}"), text);
            }
        }
        Ok(())
    }

    /// The text of one file.
    pub fn text(&self, path: &str) -> Result<&str, Error> {
        let missing = || {
            Error::Template(format!(
                "{path}: no such file in the templates; give the folder of all of them"
            ))
        };
        self.0.get(path).map(String::as_str).ok_or_else(missing)
    }

    /// Paths and texts, sorted.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.iter().map(|(path, text)| (path.as_str(), text.as_str()))
    }
}
