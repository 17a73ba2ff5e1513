//! Makes experiments of ensembles of chains, which are cut into units by σ and realisation and
//! joined to curves.

use crate::params::Profile;
use impact_chain::rise::{Counted, Curve};
use impact_chain::{Counts, Ensemble};
use literate::experiments::cutting::{Cutting, Unit, UnitRow};
use literate::experiments::experiment::How::Cut;
use literate::experiments::progress::Stage;
use literate::experiments::{Error, Experiment, Progress};
use literate::table::Table;
use rayon::prelude::*;

/// An experiment that is ensembles of chains.
pub type Ensembles = Experiment<Vec<Ensemble>, Vec<Counted>, Counts>;

/// Returns an experiment with these ensembles and tables; people who wait see its title.
pub const fn ensembles(
    name: &'static str,
    title: &'static str,
    parameters: fn(Profile) -> Vec<Ensemble>,
    tables: fn(&Vec<Counted>) -> Vec<Table>,
) -> Ensembles {
    let code = &["src/experiments/ensembles.rs"];
    Experiment { name, code, parameters, how: Cut(title, CUTTING), tables }
}

/// How ensembles are cut into units, and joined.
pub const CUTTING: Cutting<Vec<Ensemble>, Counts, Vec<Counted>> = Cutting { rows, part, join };

/// Lists each ensemble with each of its σ.
fn cases(all: &[Ensemble]) -> impl Iterator<Item = (&Ensemble, f64)> {
    all.iter().flat_map(|one| one.sigmas.iter().map(move |&sigma| (one, sigma)))
}

/// Returns a row of work for each σ of each ensemble.
pub fn rows(all: &Vec<Ensemble>) -> Vec<UnitRow> {
    let row = |(one, sigma): (&Ensemble, f64)| UnitRow {
        realisations: one.realisations_at(sigma),
        weight: one.work(sigma),
    };
    cases(all).map(row).collect()
}

/// Counts the realisations of a unit.
pub fn part(
    all: &Vec<Ensemble>,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Counts, Error> {
    let Some((one, sigma)) = cases(all).nth(unit.row) else { return Ok(Counts::default()) };
    let one = |index| {
        progress.check()?;
        let counts = one.realisation(sigma, index, || progress.stopped());
        progress.check()?;
        counts.map_err(|source| Error::failed("an ensemble", source))
    };
    Ok(unit.each(stage, one)?.into_iter().collect())
}

fn join(
    all: &Vec<Ensemble>,
    parts: Vec<Vec<Counts>>,
    progress: &Progress,
) -> Result<Vec<Counted>, Error> {
    let mut parts = parts.into_iter();
    let counted = |one: &Ensemble| {
        let at_each = parts.by_ref().take(one.sigmas.len());
        let counts: Vec<Counts> = at_each.map(|parts| parts.into_iter().collect()).collect();
        let curve = |window| {
            progress.check()?;
            Ok(Curve::new(one, &counts, window))
        };
        let windows = (0..one.protocols.len()).into_par_iter().with_max_len(1);
        Ok(Counted::new(one.clone(), &counts, windows.map(curve).collect::<Result<_, Error>>()?))
    };
    all.iter().map(counted).collect()
}

/// Returns the results of a function on each item, on all threads; the stage advances by one for
/// each.
pub fn each<A: Send, R: Send>(
    stage: &Stage,
    progress: &Progress,
    all: impl IntoIterator<Item = A>,
    run: impl Fn(A) -> Result<R, Error> + Sync,
) -> Result<Vec<R>, Error> {
    let all: Vec<A> = all.into_iter().collect();
    let one = |item| {
        progress.check()?;
        let found = run(item)?;
        stage.advance(1);
        Ok(found)
    };
    all.into_par_iter().with_max_len(1).map(one).collect()
}

/// Returns the ensemble of a name.
pub fn named<'a>(all: &'a [Counted], name: &str) -> Option<&'a Counted> {
    all.iter().find(|one| one.ensemble.name == name)
}
