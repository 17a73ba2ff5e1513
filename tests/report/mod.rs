//! Makes the report in memory, and tests it and what it is made of.

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
use literate::report::{Document, Files};
use literate::{Paper, Templates, make_report};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::LazyLock;

struct Quick {
    paper: Paper,
    templates: Templates,
    published: Published,
    figures: Vec<Figure>,
    report: Files,
    /// The same as it is written into a folder of target/.
    below: Files,
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

    fn markdown(&self, document: &Document) -> &str {
        std::str::from_utf8(&self.report[document.markdown]).unwrap()
    }

    /// The prose of a document before it is filled.
    fn prose(&self, document: &Document) -> String {
        let texts =
            document.files(&self.templates).into_iter().map(|path| self.templates.text(path));
        texts.map(Result::unwrap).collect::<Vec<_>>().join("\n\n")
    }
}

/// Links and places of each file.
type Links = BTreeMap<String, (Vec<String>, Vec<String>)>;

/// Follows the links of files in a report that is written into paper/, into a folder of target/,
/// and where no checkout is; so many at least lead within a file, and from one to another.
fn links_land(files: impl Fn(&Files) -> Links, least: usize, across: usize) {
    let alone = &crate::QUICK.report;
    for (report, top) in [(&QUICK.report, "../"), (&QUICK.below, "../../"), (alone, "none")] {
        let files = files(report);
        let (mut inside, mut outside, mut up) = (0, 0, 0);
        for (name, (links, places)) in &files {
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
                    inside += usize::from(to == name);
                    outside += usize::from(to != name);
                    assert!(files[to].1.iter().any(|place| place == id), "{name}: no {link}");
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
    let figures: Vec<_> =
        paper.figures.iter().map(|figure| figure.figure(&results).unwrap()).collect();
    let made = |out: &str| {
        let made = make_report(&paper, &session, Path::new(out));
        made.unwrap_or_else(|failure| panic!("{}", failure.message)).0
    };
    let [report, below] = ["paper", "target/paper-quick"].map(made);
    let templates = session.templates.clone();
    Quick { paper: impact_paper::paper(), templates, published, figures, report, below, results }
});
