//! The whole report of the quick profile in memory, for the tests that read it.

use impact_paper::claims::{self, Published};
use impact_paper::experiments::{ALL, Progress, Results, Store, run::run};
use impact_paper::figures::{self, Figure};
use impact_paper::params::Profile;
use impact_paper::report::{
    Document, Input, PROGRAM, Registry, Report, Templates, assemble, contents, equations,
};
use std::path::Path;
use std::sync::LazyLock;

pub struct Quick {
    pub templates: Templates,
    pub figures: Vec<Figure>,
    pub report: Report,
    pub results: Results,
    pub values: Registry,
    /// The figures that the same results would give if they were of the full profile.
    pub full: Vec<Figure>,
}

impl Quick {
    /// A document as hosts show it.
    pub fn markdown(&self, document: &Document) -> &str {
        std::str::from_utf8(&self.report.committed[document.markdown]).unwrap()
    }

    /// The prose of a document before it is filled.
    pub fn prose(&self, document: &Document) -> String {
        let texts =
            document.files(&self.templates).into_iter().map(|path| self.templates.text(path));
        texts.map(Result::unwrap).collect::<Vec<_>>().join("\n\n")
    }
}

pub static QUICK: LazyLock<Quick> = LazyLock::new(|| {
    let templates = Templates::read(Path::new("templates")).unwrap();
    let scenario = |file: &str| {
        std::fs::read_to_string(Path::new("templates").join(file)).map_err(|e| e.to_string())
    };
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path()).unwrap();
    // Run, then read again as it was saved.
    let [results, mut full] =
        [(); 2].map(|()| run(ALL, Profile::Quick, &scenario, &store, &Progress::silent()).unwrap());
    full.profile = Profile::Full;
    let published = Published::parse(templates.text("published.toml").unwrap()).unwrap();
    let claims = claims::all(&results, &published).unwrap();
    let values = contents::registry(&results, &published).unwrap();
    let rows = contents::rows(&results, &claims).unwrap();
    let [figures, full] = [&results, &full].map(|results| -> Vec<_> {
        figures::all().map(|number| figures::draw(number, results).unwrap()).collect()
    });
    let input = Input {
        templates: &templates,
        values: &values,
        rows: &rows,
        claims: &claims,
        figures: &figures,
        equations: &equations::entries(),
        lab: Some(""),
        program: PROGRAM,
    };
    let report = assemble(&input).unwrap_or_else(|error| panic!("{error}"));
    assert!(report == assemble(&input).unwrap(), "the same input gives other bytes");
    Quick { templates, figures, report, results, values, full }
});
