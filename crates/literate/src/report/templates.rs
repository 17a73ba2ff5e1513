//! The templates: people's prose, read at run time; [`super::filler`] fills them. The documents of a paper: each has its
//! prose and its files; numbers, figures, verdicts and labels are shared.

use super::Error;
use crate::input;
use crate::paper::Paper;
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
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Templates {
    files: BTreeMap<String, String>,
    /// What messages write before a path: `prose/`.
    folder: String,
}

impl Templates {
    /// Templates from texts.
    pub fn of<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let own = |(path, text): (&str, &str)| (path.to_string(), text.to_string());
        let files = SKIN.into_iter().chain(files).map(own).collect();
        Templates { files, ..Templates::default() }
    }

    /// Reads all templates of a folder.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let mut templates = Templates::of([]);
        let here = std::env::current_dir().unwrap_or_default();
        templates.folder = format!("{}/", folder.strip_prefix(here).unwrap_or(folder).display());
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
                self.files.insert(format!("{prefix}{name}"), text);
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
        self.files.get(path).map(String::as_str).ok_or_else(missing)
    }

    /// A path as messages show it, from where the program runs.
    pub(crate) fn place(&self, path: &str) -> String {
        format!("{}{path}", self.folder)
    }

    /// Paths and texts, sorted.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.files.iter().map(|(path, text)| (path.as_str(), text.as_str()))
    }
}

/// A document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Document {
    /// Its prose: `PROSE.md` of the templates, or else the files of the folder `PROSE`, in the order of their names.
    pub prose: &'static str,
    /// What the others call it.
    pub name: &'static str,
    /// What the numbers of its sections, tables and listings begin with; nothing in the first.
    pub letter: &'static str,
    /// Its file for hosts.
    pub markdown: &'static str,
    /// Its file for browsers.
    pub page: &'static str,
    /// Its file for LaTeX, without its ending `.tex`, if it is printed.
    pub print: Option<&'static str>,
    /// Whether it shows figures that have their place in another: a front page does.
    pub repeats: bool,
}

impl Document {
    /// A report, alone.
    pub const REPORT: Document = Document {
        prose: "report",
        name: "Report",
        letter: "",
        markdown: "report.md",
        page: "report.html",
        print: Some("report"),
        repeats: false,
    };

    /// Whether authors and date stand below its title: where it is printed, and there are any.
    pub(super) fn is_signed(&self, paper: &Paper) -> bool {
        self.print.is_some() && !paper.byline().is_empty()
    }

    /// Paths of its prose in the templates, in its order; none if there is no such file.
    pub fn files<'a>(&self, templates: &'a Templates) -> Vec<&'a str> {
        let (one, folder) = (format!("{}.md", self.prose), format!("{}/", self.prose));
        let own = |path: &&str| *path == one || path.starts_with(&folder) && path.ends_with(".md");
        templates.iter().map(|(path, _)| path).filter(own).collect()
    }
}
