//! The documents of a paper: each has prose of its own and its own files; numbers, figures, verdicts and labels
//! are shared.

use super::{Error, Templates};
use crate::paper::Paper;

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

    /// Holds the files of its folder, if it has one, to the names `NN-name.md`, without a gap or a number twice.
    pub(crate) fn numbered(&self, templates: &Templates) -> Result<(), Error> {
        let number = |path: &str| path.rsplit('/').next()?.split_once('-')?.0.parse::<usize>().ok();
        let files: Vec<_> =
            self.files(templates).into_iter().filter(|path| path.contains('/')).collect();
        let first = files.first().and_then(|path| number(path)).unwrap_or(0);
        match files.iter().zip(first..).find(|(path, at)| number(path) != Some(*at)) {
            Some((path, at)) => Err(Error::Template(format!(
                "{path}: {at:02}-name.md is expected here: one is missing or twice"
            ))),
            None => Ok(()),
        }
    }
}
