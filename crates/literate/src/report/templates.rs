//! The templates: people's prose, read at run time; [`super::filler`] fills them.

use super::Error;
use crate::input;
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};

/// Endings of the files that are templates or data for them (fonts live there too).
const TEXT: [&str; 9] = [".md", ".tex", ".typ", ".bib", ".toml", ".html", ".css", ".js", ".json"];

/// What stands around the text of the documents, where a folder has none of its own.
const SKIN: [(&str, &str); 4] = [
    ("report.css", include_str!("../../skin/report.css")),
    ("report.html", include_str!("../../skin/report.html")),
    ("report.js", include_str!("../../skin/report.js")),
    ("report.tex", include_str!("../../skin/report.tex")),
];

/// Files and folders that may stand in the folder: somebody might give the root.
const ENTRIES: usize = 10_000;

/// Bytes of all of them at most: ours have a third of a million, and each of them takes a hundred times as much while a
/// report is made.
const BYTES: usize = 4 << 20;

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
        let mut walk = Walk::default();
        walk.folder(folder, "")?;
        Ok(Templates::of(walk.files.iter().map(|(path, text)| (path.as_str(), text.as_str()))))
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

/// A folder being read.
#[derive(Default)]
struct Walk {
    files: BTreeMap<String, String>,
    bytes: usize,
    /// Files and folders met so far.
    entries: usize,
    /// Folders so far: symbolic links may lead to one of them again, without end.
    folders: BTreeSet<PathBuf>,
}

impl Walk {
    fn folder(&mut self, folder: &Path, prefix: &str) -> Result<(), Error> {
        let fail = |path: &Path, source| Error::Read { path: path.display().to_string(), source };
        let refuse = |path: &Path, what: &str| {
            Err(fail(path, io::Error::new(io::ErrorKind::InvalidInput, what)))
        };
        if !self.folders.insert(folder.canonicalize().map_err(|e| fail(folder, e))?) {
            return refuse(folder, "it leads to a folder that was read before");
        }
        for entry in std::fs::read_dir(folder).map_err(|e| fail(folder, e))? {
            let path = entry.map_err(|e| fail(folder, e))?.path();
            self.entries += 1;
            if self.entries > ENTRIES {
                let what = format!(
                    "there are more than {ENTRIES} files; give the folder of templates alone"
                );
                return refuse(folder, &what);
            }
            // Locks and copies of editors are hidden.
            let name = path.file_name().and_then(|name| name.to_str());
            let Some(name) = name.filter(|name| !name.starts_with('.')) else { continue };
            let relative = format!("{prefix}{name}");
            if path.is_dir() {
                self.folder(&path, &format!("{relative}/"))?;
            } else if TEXT.iter().any(|end| name.ends_with(end)) {
                let text = input::regular_text(&path).map_err(|e| fail(&path, e))?;
                if text.starts_with('\u{feff}') {
                    let what = "it begins with a byte-order mark; save it as UTF-8 without";
                    return Err(Error::Template(format!("{}: {what}", path.display())));
                }
                self.bytes += text.len();
                if self.bytes > BYTES {
                    let what = format!("the templates are longer than {} MiB", BYTES >> 20);
                    return refuse(&path, &what);
                }
                self.files.insert(relative, text);
            }
        }
        Ok(())
    }
}
