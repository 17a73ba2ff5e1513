//! Tests the report that the program made, and what it is made of.

mod damage;
mod documents;
mod figures;
mod html;
mod imports;
mod legibility;
mod picture;
mod prose;
mod structure;

use impact_paper::claims::Published;
use impact_paper::experiments::{ALL, AnyExperiment, Progress, Results, Session, Store};
use impact_paper::params::Profile;
use literate::figures::Figure;
use literate::{Paper, Templates};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::LazyLock;

struct Quick {
    paper: Paper,
    templates: Templates,
    published: Published,
    figures: Vec<Figure>,
    results: Results,
}

/// A session with the results that the program saved, in this folder.
fn session<'a>(paper: &'a Paper, saved: &Path) -> Session<'a> {
    crate::put(saved, &crate::QUICK.results);
    let (store, quiet) = (Store::open(saved), Progress::silent());
    paper.session(None, Profile::Quick, store, quiet).unwrap()
}

impl Quick {
    /// Results once more, to be changed.
    fn results_again(&self, needs: &[&'static dyn AnyExperiment]) -> Results {
        let saved = tempfile::tempdir().unwrap();
        self.paper.results(needs, &session(&self.paper, saved.path())).unwrap()
    }

    /// A file of the report.
    fn file_text(&self, name: &str) -> &'static str {
        std::str::from_utf8(&crate::QUICK.below[name]).unwrap()
    }

    /// The prose of all documents before it is filled.
    fn all_prose(&self) -> String {
        let documents = self.paper.edition.documents.iter();
        let paths = documents.flat_map(|document| document.files(&self.templates));
        paths.map(|path| self.templates.text(path).unwrap().to_owned() + "\n\n").collect()
    }
}

/// Follows the links of files in a report that is written into a folder of target/, and where no
/// checkout is; so many at least lead within a file, and from one to another. `read` returns the
/// links and places of a text.
fn links_land(names: Vec<&str>, read: fn(&str) -> [Vec<String>; 2], least: usize, across: usize) {
    let made = &crate::QUICK;
    for (report, top) in [(&made.below, "../../"), (&made.report, "none")] {
        let file_text = |name: &str| std::str::from_utf8(&report[name]).unwrap();
        let files: BTreeMap<&str, _> =
            names.iter().map(|name| (*name, read(file_text(name)))).collect();
        let (mut inside, mut outside, mut up) = (0, 0, 0);
        for (name, [links, places]) in &files {
            let distinct: BTreeSet<_> = places.iter().collect();
            assert_eq!(distinct.len(), places.len(), "{name}: a place stands twice");
            for link in links.iter().filter(|link| !link.contains("://")) {
                let (file, id) = link.split_once('#').unwrap_or((link, ""));
                if let Some(path) = file.strip_prefix(top).filter(|path| !path.starts_with('.')) {
                    up += 1;
                    assert!(Path::new(path).exists(), "{name}: no {link}");
                    continue;
                }
                let to = if file.is_empty() { name } else { file };
                assert!(report.contains_key(to) || to == "data", "{name}: no {link}");
                if !id.is_empty() {
                    inside += usize::from(to == *name);
                    outside += usize::from(to != *name);
                    assert!(files[to][1].iter().any(|place| place == id), "{name}: no {link}");
                }
            }
        }
        assert!(inside > least && outside > across, "{inside} {outside}");
        assert!((up > 30) == (top != "none"), "{up} links to files of the project");
    }
}

static QUICK: LazyLock<Quick> = LazyLock::new(|| {
    let paper = Paper { lab: Some(|_, _| Ok(Some(String::new()))), ..impact_paper::paper() };
    let saved = tempfile::tempdir().unwrap();
    let session = session(&paper, saved.path());
    let results = paper.results(ALL, &session).unwrap();
    let published = paper.published(&session).unwrap();
    let figures = paper.figures.iter().map(|figure| figure.figure(&results).unwrap()).collect();
    let templates = session.templates.clone();
    Quick { paper: impact_paper::paper(), templates, published, figures, results }
});
