//! What restitution does to a chain: where it rises, and how many impacts it has per unit of time.
//!
//! One kind of run serves both. A curve is run at each σ through a transient and a window; a
//! chain that is watched while it heats goes through windows of which each is as long as all before.

pub mod hot;
mod run;
pub mod tables;

use hot::hot;

use super::ensembles::{Begun, Ensembles, Ran};
use super::{Progress, weights};
use crate::params::{Chain, RestitutionParams};
use literate::experiments::cutting::Row;
use serde::{Deserialize, Serialize};

/// What was run: first the curves, r by r and σ by σ, then the chains that are watched while they heat, by rising r;
/// none where the engine gave up.
pub type Restitution = Ran<RestitutionParams, Option<Run>>;

/// One realisation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Impacts in each window.
    pub impacts: Vec<u64>,
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

fn chain(parameters: &RestitutionParams, restitution: f64) -> Chain {
    Chain { restitution, ..parameters.chain.clone() }
}

/// Impacts of one realisation, within a factor of a few where there are many.
fn weight(parameters: &RestitutionParams, case: &Case) -> u64 {
    let until = case.ends.last().copied().unwrap_or(0.0);
    if case.restitution == 1.0 {
        return (hot(&parameters.chain, case.sigma, 0.0, until) * until) as u64;
    }
    let paper = weights::run(&parameters.chain, case.sigma, until) as f64;
    // Masses that lose less move faster and meet more often; the number keeps r = 1 finite.
    let speed = |r: f64| ((1.0 + r) / (1.03 - r)).sqrt();
    // Under strong forces impacts accumulate at small r.
    let soft = (1.0 - case.restitution / 0.15).max(0.0);
    let force = case.sigma / 0.3;
    let sequences = 1.0 + soft * force * force;
    (paper * sequences * speed(case.restitution) / speed(parameters.chain.restitution)) as u64
}

impl Ensembles for RestitutionParams {
    type One = Option<Run>;

    fn rows(&self) -> Vec<Row> {
        let row = |case: Case| Row {
            covers: format!("sigma = {}, r = {}", case.sigma, case.restitution),
            realisations: case.realisations,
            weight: weight(self, &case),
        };
        cases(self).into_iter().map(row).collect()
    }

    fn row<'a>(&'a self, row: usize, progress: &'a Progress) -> Begun<'a, Option<Run>> {
        let case = cases(self).swap_remove(row);
        Ok(Box::new(move |index| run::realisation(self, &case, index, progress)))
    }

    fn fits(&self, row: usize, run: &Option<Run>) -> bool {
        let (gaps, windows) = (self.chain.gaps() as u64, cases(self)[row].ends.len());
        run.as_ref().is_none_or(|run| run.impacts.len() == windows && run.distinct <= gaps)
    }
}

#[cfg(test)]
mod tests;
