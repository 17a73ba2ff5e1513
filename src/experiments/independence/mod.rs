//! Are impacts independent: sequences of impacts beside the fully connected graph of Secs. 3 to 6.

mod succession;
pub mod tables;

use super::{Error, Progress, weights};
use crate::dynamics::{self, Engine, Scenario};
use crate::numerics::random::{NormalPairs, generator};
use crate::params::IndependenceParams;
use literate::experiments::cutting::{Cutting, Row, Unit};
use literate::experiments::progress::Stage;
use serde::{Deserialize, Serialize};
use succession::{Matrix, distinct, hits, next};

/// What successive impacts have to do with one another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Independence {
    /// What was run.
    pub parameters: IndependenceParams,
    /// What became of each realisation, for each ensemble.
    pub rows: Vec<Part>,
}

/// One realisation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Impacts of each gap.
    hits: Vec<u64>,
    /// Impacts by distance to the gap of the next.
    distances: Vec<u64>,
    /// Information of an impact about the next in nats: measured, and shuffled.
    information: [f64; 2],
    /// Impacts by the place of the next impact of their masses: left, same gap, right.
    next: [u64; 3],
    /// Impacts that begin a simple circuit of length k, at index k − 1.
    circuits: Vec<u64>,
    /// Of the short circuits those that pass by a neighbour of their first gap.
    passing: u64,
    /// For each number of impacts: different gaps, and blocks.
    distinct: Vec<[u64; 2]>,
}

/// What became of a realisation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// The engine gave up.
    Failed,
    /// Fewer than two impacts in the window.
    Quiet,
    /// Impacts.
    Ran(Box<Run>),
}

/// Some realisations of one ensemble.
pub type Part = Vec<Outcome>;

/// The experiment in units of work.
pub const CUTTING: Cutting<IndependenceParams, Part, Independence> =
    Cutting { rows, part, fits, join };

fn join(
    parameters: &IndependenceParams,
    parts: Vec<Vec<Part>>,
    _: &Progress,
) -> Result<Independence, Error> {
    let rows = parts.into_iter().map(|parts| parts.concat()).collect();
    Ok(Independence { parameters: parameters.clone(), rows })
}

/// Numbers of successive impacts of which the different gaps are counted.
fn blocks(parameters: &IndependenceParams, big_n: usize) -> impl Iterator<Item = usize> {
    (1..=parameters.quarters).map(move |i| (i * big_n / 4).max(1))
}

fn rows(parameters: &IndependenceParams) -> Vec<Row> {
    let protocol = parameters.protocol;
    let row = |&sigma: &f64| Row {
        covers: format!("sigma = {sigma}"),
        realisations: parameters.realisations,
        weight: weights::run(&parameters.chain, sigma, protocol.transient + 2.0 * protocol.window),
    };
    parameters.sigmas.iter().map(row).collect()
}

fn part(
    parameters: &IndependenceParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Part, Error> {
    let sigma = parameters.sigmas[unit.row];
    unit.each(stage, |index| realisation(parameters, sigma, index, progress))
}

fn fits(parameters: &IndependenceParams, unit: &Unit, outcomes: &Part) -> bool {
    let big_n = parameters.chain.gaps();
    let fits = |outcome: &Outcome| match outcome {
        Outcome::Failed | Outcome::Quiet => true,
        Outcome::Ran(run) => {
            let lists = [&run.hits, &run.distances, &run.circuits];
            lists.into_iter().all(|list| list.len() == big_n)
                && run.hits.iter().sum::<u64>() > 1
                && run.distinct.len() == parameters.quarters
        }
    };
    outcomes.len() == unit.realisations.len() && outcomes.iter().all(fits)
}

fn realisation(
    parameters: &IndependenceParams,
    sigma: f64,
    index: u64,
    progress: &Progress,
) -> Result<Outcome, Error> {
    progress.check()?;
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(&parameters.chain, sigma, &mut normals);
    let fault = |source| Error::failed("independence", source);
    let mut engine = Engine::new(&scenario).map_err(fault)?;
    let mut gaps = Vec::new();
    let protocol = parameters.protocol;
    let ended = engine.run(protocol.transient, |_| !progress.stopped()).and_then(|()| {
        engine.run(protocol.transient + protocol.window, |impact| {
            gaps.push(impact.gap);
            !progress.stopped()
        })
    });
    progress.check()?;
    match ended {
        Ok(()) if gaps.len() < 2 => Ok(Outcome::Quiet),
        Ok(()) => Ok(Outcome::Ran(Box::new(counted(parameters, &gaps, scenario.gaps(), index)))),
        Err(dynamics::Error::Work { .. }) => Ok(Outcome::Failed),
        Err(source) => Err(fault(source)),
    }
}

/// Everything that is counted in one sequence.
fn counted(parameters: &IndependenceParams, gaps: &[usize], big_n: usize, index: u64) -> Run {
    let name = format!("{} surrogate {big_n}", parameters.stream);
    let mut random = generator(&name, parameters.seed, index);
    let hits = hits(gaps, big_n);
    let matrix = Matrix::new(gaps, big_n);
    let shuffled = succession::shuffled(gaps, &mut random);
    let circuits = succession::circuits(gaps, big_n, IndependenceParams::SHORT);
    Run {
        distances: matrix.distances(),
        information: [matrix.information(&hits), Matrix::new(&shuffled, big_n).information(&hits)],
        next: next(gaps, big_n),
        circuits: circuits.lengths,
        passing: circuits.passing,
        distinct: blocks(parameters, big_n).map(|m| distinct(gaps, big_n, m)).collect(),
        hits,
    }
}

#[cfg(test)]
mod tests;
