//! The whole report, from experiments to files in memory.

use super::judged::Judged;
use super::sources::Sources;
use super::{Failure, mutate};
use impact_paper::claims;
use impact_paper::experiments::{Need, Progress};
use impact_paper::figures::{self, Figure, Scene};
use impact_paper::params::Profile;
use impact_paper::report::mutate::{Subject, TABLE, Tally};
use impact_paper::report::{self, Report, contents};
use rayon::prelude::*;

/// Runs every experiment and makes every file; with `pdf`, report.pdf too. Says also what holds.
///
/// # Errors
/// Exit codes 1 (a lint), 2, 4 and 130.
pub fn whole(
    sources: &Sources,
    profile: Profile,
    pdf: bool,
    progress: &Progress,
) -> Result<(Report, Judged), Failure> {
    if pdf && cfg!(not(feature = "pdf")) {
        return Err(report::Error::NoTypesetter.into());
    }
    let templates = sources.templates()?;
    report::lint::check(&templates)?;
    // Faults of the templates are told before the long runs, not after them.
    let published = sources.published(&templates)?;
    let reasons = sources.reasons(&templates)?.for_profile(profile);
    let results = sources.run(&Need::ALL.into(), profile, &templates, progress)?;
    results.look();
    let draw = |number| {
        progress.check()?;
        Ok(figures::draw(number, &results)?)
    };
    let numbers: Vec<figures::Number> = figures::all().collect();
    let drawn: Vec<Figure> = numbers.into_par_iter().map(draw).collect::<Result<_, Failure>>()?;
    let claims = claims::all(&results, &published)?;
    let mut values = contents::registry(&results, &published)?;
    let mut rows = contents::rows(&results, &claims)?;
    let judged = Judged::all(&results, &published, values.clone(), claims)?;
    let claims = &judged.claims;
    let subject = Subject { results: &results, published: &published };
    let found = mutate::found(sources, profile, subject, progress)?;
    let used = report::mutate::used(&templates, &values, &rows, claims, &reasons)?;
    let tally = Tally::of(&used, &found, &reasons, &values);
    values.extend(tally.values(&reasons))?;
    let lines = serde_json::to_value(tally.rows(&reasons)).map_err(contents::Error::Rows)?;
    rows.insert(TABLE, lines);
    let scene = Scene::of(results.spacetime()?);
    progress.check()?;
    let report = report::assemble(&report::Input {
        templates: &templates,
        values: &values,
        rows: &rows,
        claims,
        figures: &drawn,
        scene: scene.as_ref(),
        pdf,
    })?;
    Ok((report, judged))
}
