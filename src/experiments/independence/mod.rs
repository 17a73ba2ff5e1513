//! Are impacts independent: sequences of impacts beside the fully connected graph of Secs. 3 to 6.

mod succession;
mod surrogate;
pub mod tables;

use super::{Error, Progress, weights};
use crate::dynamics::{self, Engine, Scenario};
use crate::numerics::random::{NormalPairs, generator};
use crate::params::{Chain, IndependenceParams, IndependenceRow};
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
    /// How many cells of the transition matrix have which count.
    histogram: Vec<[u64; 2]>,
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
    /// Circuits i → j → i, and pairs of them that are the same.
    returns: [u64; 2],
    /// Circuits of a Markov chain with the measured transition matrix.
    markov: Vec<u64>,
    /// For each number of impacts: different gaps, and blocks.
    distinct: Vec<[u64; 2]>,
    /// Different gaps of the Markov chain.
    distinct_markov: Vec<u64>,
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

fn chain(parameters: &IndependenceParams, row: &IndependenceRow) -> Chain {
    Chain { masses: row.masses, ..parameters.chain.clone() }
}

/// Numbers of successive impacts of which the different gaps are counted.
fn blocks(parameters: &IndependenceParams, big_n: usize) -> impl Iterator<Item = usize> {
    (1..=parameters.quarters).map(move |i| (i * big_n / 4).max(1))
}

fn weight(parameters: &IndependenceParams, row: &IndependenceRow) -> u64 {
    let protocol = parameters.protocol;
    weights::run(&chain(parameters, row), row.sigma, protocol.transient + 2.0 * protocol.window)
}

fn rows(parameters: &IndependenceParams) -> Vec<Row> {
    let row = |row: &IndependenceRow| Row {
        covers: format!("n = {}, sigma = {}", row.masses, row.sigma),
        realisations: parameters.realisations,
        weight: weight(parameters, row),
    };
    parameters.rows.iter().map(row).collect()
}

fn part(
    parameters: &IndependenceParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Part, Error> {
    let row = &parameters.rows[unit.row];
    unit.each(stage, |index| realisation(parameters, row, index, progress))
}

fn fits(parameters: &IndependenceParams, unit: &Unit, outcomes: &Part) -> bool {
    let big_n = chain(parameters, &parameters.rows[unit.row]).gaps();
    let fits = |outcome: &Outcome| match outcome {
        Outcome::Failed | Outcome::Quiet => true,
        Outcome::Ran(run) => {
            let lists = [&run.hits, &run.distances, &run.circuits, &run.markov];
            let numbers = parameters.quarters;
            lists.into_iter().all(|list| list.len() == big_n)
                && run.hits.iter().sum::<u64>() > 1
                && (run.distinct.len(), run.distinct_markov.len()) == (numbers, numbers)
        }
    };
    outcomes.len() == unit.realisations.len() && outcomes.iter().all(fits)
}

fn realisation(
    parameters: &IndependenceParams,
    row: &IndependenceRow,
    index: u64,
    progress: &Progress,
) -> Result<Outcome, Error> {
    progress.check()?;
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(&chain(parameters, row), row.sigma, &mut normals);
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
    let shuffled = surrogate::shuffled(gaps, &mut random);
    let markov = surrogate::markov(gaps, big_n, &mut random);
    let circuits = |gaps| succession::circuits(gaps, big_n, IndependenceParams::SHORT);
    let own = circuits(gaps);
    Run {
        histogram: matrix.histogram(),
        distances: matrix.distances(),
        information: [matrix.information(&hits), Matrix::new(&shuffled, big_n).information(&hits)],
        next: next(gaps, big_n),
        circuits: own.lengths,
        passing: own.passing,
        returns: own.returns,
        markov: circuits(&markov).lengths,
        distinct: blocks(parameters, big_n).map(|m| distinct(gaps, big_n, m)).collect(),
        distinct_markov: blocks(parameters, big_n)
            .map(|m| distinct(&markov, big_n, m)[0])
            .collect(),
        hits,
    }
}

#[cfg(test)]
mod tests;
