//! What restitution does to a chain: the rise and its heat.
//!
//! One kind of run serves both. A curve is run at each σ through a transient and a window; a
//! chain that is watched while it heats goes through windows of which each is as long as all before.

pub mod hot;
mod run;
pub mod tables;

use hot::hot;

use super::{Error, Progress, weights};
use crate::params::{Chain, RestitutionParams};
use literate::experiments::cutting::{Cutting, Row, Unit};
use literate::experiments::progress::Stage;
use serde::{Deserialize, Serialize};

/// What was run: for each row its realisations, none where the engine gave up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Restitution {
    /// The sizes.
    pub parameters: RestitutionParams,
    /// First the curves, r by r and σ by σ, then the chains that are watched while they heat, by rising r.
    pub rows: Vec<Part>,
}

/// One realisation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Impacts in each window.
    pub impacts: Vec<u64>,
    /// Half the sum of squares of the free amplitudes of all masses, at the end of each window.
    pub free: Vec<f64>,
    /// Different gaps with an impact in the last window, in which all that follows is counted.
    pub distinct: u64,
    /// Contact phases begun.
    pub phases: u64,
}

/// What is run with the same times: one σ and one restitution.
#[derive(Clone, Debug, PartialEq)]
struct Case {
    sigma: f64,
    restitution: f64,
    /// Ends of the windows, rising. What ends first is a transient where there are two.
    ends: Vec<f64>,
    realisations: usize,
}

/// Some realisations of one ensemble; none where the engine gave up.
pub type Part = Vec<Option<Run>>;

/// The experiment in units of work.
pub const CUTTING: Cutting<RestitutionParams, Part, Restitution> =
    Cutting { rows, part, fits, join };

/// All ensembles: the curves, r by r, and those that are watched while they heat.
fn cases(parameters: &RestitutionParams) -> Vec<Case> {
    let protocol = parameters.protocol;
    let curve = |&restitution: &f64| {
        parameters.sigmas.iter().map(move |&sigma| Case {
            sigma,
            restitution,
            ends: vec![protocol.transient, protocol.transient + protocol.window],
            realisations: parameters.realisations,
        })
    };
    let heated = |&restitution: &f64| Case {
        sigma: parameters.heated_sigma,
        restitution,
        ends: parameters.ends.clone(),
        realisations: parameters.heated_realisations,
    };
    let curves = parameters.restitutions.iter().flat_map(curve);
    curves.chain(parameters.heated.iter().map(heated)).collect()
}

fn join(
    parameters: &RestitutionParams,
    parts: Vec<Vec<Part>>,
    _: &Progress,
) -> Result<Restitution, Error> {
    let rows = parts.into_iter().map(|parts| parts.concat()).collect();
    Ok(Restitution { parameters: parameters.clone(), rows })
}

fn chain(parameters: &RestitutionParams, restitution: f64) -> Chain {
    Chain { restitution, ..parameters.chain.clone() }
}

/// Impacts of one realisation, within a factor of a few where there are many.
fn weight(parameters: &RestitutionParams, case: &Case) -> u64 {
    let until = case.ends.last().copied().unwrap_or(0.0);
    if case.restitution == 1.0 {
        return (hot(&parameters.chain, case.sigma, 0.0, until).rate * until) as u64;
    }
    let paper = weights::run(&parameters.chain, case.sigma, until) as f64;
    // Masses that move faster meet more often: as the heat of the balance, but for its limit.
    let speed = |r: f64| ((1.0 + r) / (1.03 - r)).sqrt();
    // Under strong forces impacts accumulate at small r.
    let soft = (1.0 - case.restitution / 0.15).max(0.0);
    let force = case.sigma / 0.3;
    let sequences = 1.0 + soft * force * force;
    (paper * sequences * speed(case.restitution) / speed(parameters.chain.restitution)) as u64
}

fn rows(parameters: &RestitutionParams) -> Vec<Row> {
    let row = |case: Case| Row {
        covers: format!("sigma = {}, r = {}", case.sigma, case.restitution),
        realisations: case.realisations,
        weight: weight(parameters, &case),
    };
    cases(parameters).into_iter().map(row).collect()
}

fn part(
    parameters: &RestitutionParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Part, Error> {
    let case = &cases(parameters)[unit.row];
    unit.each(stage, |index| run::realisation(parameters, case, index, progress))
}

fn fits(parameters: &RestitutionParams, unit: &Unit, runs: &Part) -> bool {
    let gaps = parameters.chain.gaps() as u64;
    let Some(case) = cases(parameters).into_iter().nth(unit.row) else { return false };
    let fits = |run: &Run| {
        run.impacts.len() == case.ends.len()
            && run.free.len() == case.ends.len()
            && run.distinct <= gaps
    };
    runs.len() == unit.realisations.len() && runs.iter().flatten().all(fits)
}

#[cfg(test)]
mod tests;
