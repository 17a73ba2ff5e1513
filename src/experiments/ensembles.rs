//! Makes experiments of ensembles of chains, cut by σ and realisation and joined to curves.

use crate::params::{Ensemble, Profile, Protocol};
use impact_chain::Abreast;
use impact_chain::counts::{Counts, Total};
use impact_chain::rise::{Curve, CurveData, RisePoint};
use literate::experiments::cutting::{Cutting, Unit, UnitRow};
use literate::experiments::experiment::How::Cut;
use literate::experiments::progress::Stage;
use literate::experiments::{Error, Experiment, Progress};
use literate::table::Table;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub type Ensembles = Experiment<Vec<Ensemble>, Vec<Counted>, Counts>;

/// Makes the experiment of some ensembles; its title is shown while it runs.
pub const fn ensembles(
    name: &'static str,
    title: &'static str,
    parameters: fn(Profile) -> Vec<Ensemble>,
    tables: fn(&Vec<Counted>) -> Vec<Table>,
) -> Ensembles {
    let own = &["src/experiments/ensembles.rs"];
    Experiment { name, own, reads: &[], parameters, how: Cut(title, CUTTING), tables }
}

pub const CUTTING: Cutting<Vec<Ensemble>, Counts, Vec<Counted>> =
    Cutting { rows: unit_rows, run_unit, join };

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Counted {
    pub ensemble: Ensemble,
    /// Totals of whole runs, for each σ.
    pub runs: Vec<RunTotals>,
    pub curves: Vec<Curve>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunTotals {
    pub sigma: f64,
    pub realisations: usize,
    pub rejected: usize,
    pub failed: usize,
    /// Realisations that were not simulated side by side.
    pub by_engine: usize,
    pub total: Total,
}

impl Counted {
    /// Returns the curve of a window, or `None` if it was not counted.
    pub fn find_curve(&self, protocol: Protocol) -> Option<&Curve> {
        self.curves.iter().find(|curve| curve.protocol == protocol)
    }

    pub fn first_curve(&self) -> &Curve {
        &self.curves[0]
    }

    /// Lists the rows of the first window with few overlapping starts.
    pub fn comparable(&self) -> impl Iterator<Item = &RisePoint> {
        let both = self.first_curve().rows.iter().zip(&self.runs);
        let few = both.filter(|(row, runs)| self.ensemble.is_comparable(row.sigma, runs.rejected));
        few.map(|(row, _)| row)
    }
}

/// Lists each ensemble with each of its σ.
fn cases(ensembles: &[Ensemble]) -> impl Iterator<Item = (&Ensemble, f64)> {
    ensembles.iter().flat_map(|one| one.sigmas.iter().map(move |&sigma| (one, sigma)))
}

/// Returns a row of work for each σ of each ensemble.
pub fn unit_rows(ensembles: &Vec<Ensemble>) -> Vec<UnitRow> {
    let row = |(one, sigma): (&Ensemble, f64)| UnitRow {
        realisations: one.realisations_at(sigma),
        work_of_one: one.work(sigma),
        group_size: Abreast::batch_size(&one.chain),
    };
    cases(ensembles).map(row).collect()
}

pub fn run_unit(
    ensembles: &Vec<Ensemble>,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Counts, Error> {
    let Some((one, sigma)) = cases(ensembles).nth(unit.row) else { return Ok(Counts::default()) };
    let stopped = || progress.stopped();
    let realisations = one.prepare(sigma, &stopped);
    let count = |indices| {
        progress.check()?;
        let counts = realisations.count(indices);
        progress.check()?;
        counts.map_err(|source| Error::failed("an ensemble", source))
    };
    let group_size = Abreast::batch_size(&one.chain);
    Ok(unit.run_in_groups(group_size, stage, count)?.into_iter().flatten().collect())
}

/// The counts of the units of each row.
pub type Parts = Vec<Vec<Counts>>;

/// Joins the counts of units of work, and lists those of each ensemble at each σ.
pub fn join_counts(
    ensembles: &[Ensemble],
    parts: Parts,
) -> impl Iterator<Item = (Ensemble, Vec<Counts>)> {
    let mut at_each = parts.into_iter().map(Counts::from_iter);
    let counts = move |one: &Ensemble| at_each.by_ref().take(one.sigmas.len()).collect();
    ensembles.iter().cloned().zip(ensembles.iter().map(counts))
}

fn join(groups: &Vec<Ensemble>, parts: Parts, progress: &Progress) -> Result<Vec<Counted>, Error> {
    let summarise = |(one, counts): (Ensemble, Vec<Counts>)| {
        let totals = |(&sigma, counts): (&f64, &Counts)| RunTotals {
            sigma,
            realisations: one.realisations_at(sigma),
            rejected: counts.rejected,
            failed: counts.failed,
            by_engine: counts.by_engine,
            total: counts.total.clone(),
        };
        let runs: Vec<RunTotals> = one.sigmas.iter().zip(&counts).map(totals).collect();
        let compared: Vec<_> =
            runs.iter().map(|runs| one.is_comparable(runs.sigma, runs.rejected)).collect();
        let gaps = one.chain.gaps() as f64 / one.pieces as f64;
        let curve = |window_index: usize| {
            progress.check()?;
            Ok(Curve::new(&CurveData {
                protocol: one.protocols[window_index],
                window_index,
                sigmas: &one.sigmas,
                counts: &counts,
                compared: &compared,
                gaps,
                seed: one.seed,
            }))
        };
        let window_indices = (0..one.protocols.len()).into_par_iter().with_max_len(1);
        let curves = window_indices.map(curve).collect::<Result<_, Error>>()?;
        Ok(Counted { ensemble: one, runs, curves })
    };
    join_counts(groups, parts).map(summarise).collect()
}

/// Runs a function on each item, on all threads, and returns the results in the order of the items;
/// each is one step of the stage.
pub fn run_each<A: Send, R: Send>(
    stage: &Stage,
    progress: &Progress,
    items: impl IntoIterator<Item = A>,
    run: impl Fn(A) -> Result<R, Error> + Sync,
) -> Result<Vec<R>, Error> {
    let items: Vec<A> = items.into_iter().collect();
    let step = |item| {
        progress.check()?;
        let result = run(item)?;
        stage.advance(1);
        Ok(result)
    };
    items.into_par_iter().with_max_len(1).map(step).collect()
}

/// Returns the counts of the ensemble of this name, or `None` if there is none.
pub fn find_ensemble<'a>(ensembles: &'a [Counted], name: &str) -> Option<&'a Counted> {
    ensembles.iter().find(|one| one.ensemble.name == name)
}
