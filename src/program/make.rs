//! The whole report, from experiments to files in memory.

use super::Failure;
use super::judged;
use super::sources::{Sources, run};
use crate::claims::{self, Check};
use crate::committed;
use crate::experiments::{ALL, Progress, Results, Store};
use crate::figures::{self, Figure, Listed};
use crate::params::Profile;
use crate::report::{self, PROGRAM, Report, contents, equations};
use rayon::prelude::*;
use std::path::Path;

/// The engine as WebAssembly, where `.ci/module` has put it: the machine may have no compiler for that.
const MODULE: &str = "target/page.wasm";

/// Runs every experiment that is not in the store, and makes every file of a report in the folder `out`. Says also what holds.
pub fn whole(
    sources: &Sources,
    profile: Profile,
    out: &Path,
    store: &Store,
    progress: &Progress,
) -> Result<(Report, Vec<Check>), Failure> {
    let templates = sources.templates()?;
    report::filler::Filler::new(&templates, PROGRAM)?;
    // Faults of the templates are told before the long runs, not after them.
    let published = sources.published(&templates)?;
    let results = run(ALL, profile, &templates, store, progress)?;
    results.tables();
    let draw = |listed| {
        progress.check()?;
        figure(listed, &results)
    };
    let drawn = figures::ALL.par_iter().map(draw).collect::<Result<Vec<Figure>, Failure>>()?;
    let claims = claims::all(&results, &published)?;
    let values = contents::registry(&results, &published)?;
    let rows = contents::rows(&results, &claims)?;
    let module = committed::bytes(MODULE).filter(|module| module.starts_with(b"\0asm"));
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
        claims: &claims,
        figures: &drawn,
        equations: &equations::entries(),
        lab: lab.as_deref(),
        top: committed::top(out).as_deref(),
        program: PROGRAM,
    })?;
    Ok((report, [claims, judged::own(&results)?].concat()))
}

/// Draws one figure.
pub fn figure(figure: &Listed, results: &Results) -> Result<Figure, Failure> {
    let named = |error| Failure::from(error).of(format!("figure {}", figure.number));
    figure.draw(results).map_err(named)
}
