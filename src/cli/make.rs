//! The whole report, from experiments to files in memory.

use super::sources::Sources;
use super::{Failure, mutate};
use impact_paper::claims;
use impact_paper::experiments::{Need, Progress};
use impact_paper::figures::{self, Figure, Scene};
use impact_paper::params::Profile;
use impact_paper::report::mutate::{Subject, TABLE, Tally};
use impact_paper::report::{self, Report, contents};
use rayon::prelude::*;

/// Runs every experiment and makes every file; with `pdf`, report.pdf too.
///
/// # Errors
/// Exit codes 2, 4 and 130.
pub fn whole(
    sources: &Sources,
    profile: Profile,
    pdf: bool,
    progress: &Progress,
) -> Result<Report, Failure> {
    if pdf && cfg!(not(feature = "pdf")) {
        return Err(Failure::input(report::Error::NoTypesetter.to_string()));
    }
    let templates = sources.templates()?;
    report::lint::check(&templates).map_err(|error| Failure::input(error.to_string()))?;
    // Faults of the templates are told before the long runs, not after them.
    let published = sources.published(&templates)?;
    let reasons = sources.reasons(&templates)?.for_profile(profile);
    let results = sources.run(&Need::ALL.into(), profile, &templates, progress)?;
    let fault = |error: &dyn std::error::Error| Failure::run(error.to_string());
    results.look();
    let draw = |number| {
        progress.check()?;
        figures::draw(number, &results).map_err(|e| fault(&e))
    };
    let numbers: Vec<figures::Number> = figures::all().collect();
    let drawn: Vec<Figure> = numbers.into_par_iter().map(draw).collect::<Result<_, Failure>>()?;
    let claims = claims::all(&results, &published).map_err(|e| fault(&e))?;
    let mut values = contents::registry(&results, &published).map_err(|e| fault(&e))?;
    let mut rows = contents::rows(&results, &claims).map_err(|e| fault(&e))?;
    let subject = Subject { results: &results, published: &published };
    let found = mutate::found(sources, profile, subject, progress)?;
    let told = |error: report::Error| Failure::input(error.to_string());
    let used = report::mutate::used(&templates, &values, &rows, &claims, &reasons).map_err(told)?;
    let tally = Tally::of(&used, &found, &reasons, &values);
    values.extend(tally.values(&reasons)).map_err(told)?;
    let lines = serde_json::to_value(tally.rows(&reasons)).map_err(|e| fault(&e))?;
    rows.insert(TABLE, lines);
    let scene = Scene::of(results.spacetime().map_err(|e| fault(&e))?);
    progress.check()?;
    report::assemble(&report::Input {
        templates: &templates,
        values: &values,
        rows: &rows,
        claims: &claims,
        figures: &drawn,
        scene: scene.as_ref(),
        pdf,
    })
    .map_err(|error| Failure::input(error.to_string()))
}
