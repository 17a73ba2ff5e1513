//! The whole report, from experiments to files in memory.

use super::Failure;
use super::judged::Judged;
use super::sources::Sources;
use crate::claims;
use crate::committed;
use crate::experiments::{ALL, Progress, Results, alive};
use crate::figures::{self, Figure};
use crate::params::Profile;
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
    let results = sources.run(ALL, profile, &templates, progress)?;
    results.tables();
    // Machines may be slow or busy, a loop of a template long.
    let _alive = alive(|| Some("making figures and documents".into()));
    let draw = |number| {
        progress.check()?;
        figure(number, &results)
    };
    let numbers: Vec<figures::Number> = figures::all().collect();
    let drawn: Vec<Figure> = numbers.into_par_iter().map(draw).collect::<Result<_, Failure>>()?;
    let claims = claims::all(&results, &published)?;
    let values = contents::registry(&results, &published)?;
    let rows = contents::rows(&results, &claims)?;
    let judged = Judged::all(&results, &published, claims)?;
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
        Failure { message, ..failure }
    })
}
