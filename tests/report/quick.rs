//! The whole report of the quick profile in memory, for the tests that read it.

// Each test file compiles this for itself, and reads a part of it.
#![allow(dead_code)]

use impact_paper::claims::{self, Published};
use impact_paper::experiments::spacetime::SpaceTime;
use impact_paper::experiments::{Need, Progress, Store, run::run};
use impact_paper::figures::{self, Figure};
use impact_paper::params::Profile;
use impact_paper::report::mutate::{Reasons, TABLE, Tally};
use impact_paper::report::{Input, Report, Templates, assemble, contents};
use std::path::Path;
use std::sync::LazyLock;

pub struct Quick {
    pub templates: Templates,
    pub figures: Vec<Figure>,
    pub report: Report,
    /// The run that figure S2 and the scene show.
    pub run: SpaceTime,
}

pub static QUICK: LazyLock<Quick> = LazyLock::new(|| {
    let templates = Templates::read(Path::new("templates")).unwrap();
    let scenario = |file: &str| {
        std::fs::read_to_string(Path::new("templates").join(file)).map_err(|e| e.to_string())
    };
    let results =
        run(&Need::ALL, Profile::Quick, scenario, &Store::nowhere(), &Progress::silent()).unwrap();
    let published = Published::parse(templates.text("published.toml").unwrap()).unwrap();
    let claims = claims::all(&results, &published).unwrap();
    let mut values = contents::registry(&results, &published).unwrap();
    let mut rows = contents::rows(&results, &claims).unwrap();
    // How much checks notice takes seconds to measure, and the form of the report does not need it.
    let reasons = Reasons::read(templates.text("unguarded.toml").unwrap()).unwrap();
    values.extend(Tally::default().values(&reasons)).unwrap();
    rows.insert(TABLE, serde_json::to_value(Tally::default().rows(&reasons)).unwrap());
    let scene = figures::Scene::of(results.spacetime().unwrap());
    let figures: Vec<_> = figures::all().map(|n| figures::draw(n, &results).unwrap()).collect();
    let input = Input {
        templates: &templates,
        values: &values,
        rows: &rows,
        claims: &claims,
        figures: &figures,
        scene: scene.as_ref(),
        pdf: false,
    };
    let report = assemble(&input).unwrap_or_else(|error| panic!("{error}"));
    assert!(report == assemble(&input).unwrap(), "the same input gives other bytes");
    Quick { templates, figures, report, run: results.spacetime.unwrap() }
});
