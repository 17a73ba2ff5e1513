//! The whole report, from experiments to files in memory.

use super::Failure;
use super::judged::Judged;
use super::sources::Sources;
use crate::claims::{self, Check, Text, Verdict};
use crate::committed;
use crate::experiments::{ALL, Progress, Results, alive};
use crate::figures::{self, Figure};
use crate::params::{Profile, set};
use crate::report::{self, PROGRAM, Report, contents, equations};
use rayon::prelude::*;

/// The engine as WebAssembly, where `.ci/module` has put it: the machine may have no compiler for that.
const MODULE: &str = "target/page.wasm";

/// Runs every experiment and makes every file. Says also what holds.
///
/// # Errors
/// Exit codes 1 (a lint), 2, 4 and 130.
pub fn whole(
    sources: &Sources,
    profile: Profile,
    progress: &Progress,
) -> Result<(Report, Judged), Failure> {
    let reading = alive(|| Some("reading the templates".into()));
    let templates = sources.templates()?;
    report::lint::check(&templates, PROGRAM)?;
    // Faults of the templates are told before the long runs, not after them.
    let published = sources.published(&templates)?;
    drop(reading);
    let results = sources.run(&ALL, profile, &templates, progress)?;
    results.look();
    // Machines may be slow or busy, a loop of a template long.
    let _alive = alive(|| Some("making figures and documents".into()));
    let draw = |number| {
        progress.check()?;
        figure(number, &results)
    };
    let numbers: Vec<figures::Number> = figures::all().collect();
    let drawn: Vec<Figure> = numbers.into_par_iter().map(draw).collect::<Result<_, Failure>>()?;
    let mut claims =
        claims::all(&results, &published).map_err(|error| of_parameters(error.into()))?;
    if let Some(told) = set::told() {
        claims.iter_mut().for_each(|claim| not_judged(claim, &told));
    }
    let contents = contents::registry(&results, &published);
    let values = contents.map_err(|error| of_parameters(error.into()))?;
    let rows = contents::rows(&results, &claims).map_err(|error| of_parameters(error.into()))?;
    let judged = match set::told() {
        None => Judged::all(&results, &published, values.clone(), claims)?,
        Some(_) => Judged { claims, ..Judged::default() },
    };
    let claims = &judged.claims;
    let module = committed::bytes(MODULE).filter(|module| is_module(module));
    if module.is_none() {
        let what = "is not there or no module, so the pages run nothing; `make paper` builds it";
        progress.say(&format!("{MODULE} {what}"));
    }
    let script = templates.text("lab.js")?;
    let lab = module.map(|module| report::lab::script(&module, &results, script)).transpose()?;
    progress.check()?;
    let report = report::assemble(&report::Input {
        templates: &templates,
        values: &values,
        rows: &rows,
        claims,
        figures: &drawn,
        equations: &equations::entries(),
        lab: lab.as_deref(),
        program: PROGRAM,
    });
    let report = report.map_err(|error| match error {
        // A value that these parameters do not have.
        report::Error::Template(_) | report::Error::NotFinite(_) => of_parameters(error.into()),
        error => error.into(),
    })?;
    Ok((report, judged))
}

/// Bytes of a module at most: ours has some hundred kilobytes, and the next run reads what is made of it.
const LARGEST: usize = 4 << 20;

/// Is it WebAssembly, of a size that a page can load?
fn is_module(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\0asm") && bytes.len() <= LARGEST
}

/// Draws one figure.
///
/// # Errors
/// Exit codes 2 and 4, with its number.
pub fn figure(number: figures::Number, results: &Results) -> Result<Figure, Failure> {
    figures::draw(number, results).map_err(|error| {
        let failure = Failure::from(error);
        let message = format!("figure {number}: {}", failure.message);
        of_parameters(Failure { message, ..failure })
    })
}

/// What fails for parameters that were set is their fault, and not the program's.
fn of_parameters(failure: Failure) -> Failure {
    let failed = [2, 4].contains(&failure.code) && set::told().is_some();
    if !failed {
        return failure;
    }
    Failure::input(failure.message).and(
        "with these parameters not every part can be made; give values nearer to the paper's, or --figure with those \
         that can be drawn",
    )
}

/// The paper says nothing of other parameters than its own.
fn not_judged(claim: &mut Check, told: &str) {
    claim.verdict = Verdict::CannotBeJudged;
    claim.note = Text::words(format!("Not judged, {told}."));
}
