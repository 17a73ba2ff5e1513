//! Are impacts independent: sequences of impacts beside the fully connected graph of Secs. 3 to 6.

pub(crate) mod joining;
mod succession;
mod surrogate;

use super::cutting::{Cutting, Row, Unit};
use super::progress::Stage;
use super::{Error, Progress, weights};
use crate::dynamics::{self, Engine, Scenario};
use crate::numerics::random::{NormalPairs, generator};
use crate::numerics::statistics::Estimate;
use crate::params::{Chain, IndependenceParams, IndependenceRow};
use serde::{Deserialize, Serialize};
use succession::{Matrix, distinct, hits, next};

/// What successive impacts have to do with one another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Independence {
    /// What was run.
    pub parameters: IndependenceParams,
    /// One for each ensemble.
    pub rows: Vec<Dependence>,
    /// Orders of impacts that no mass notices.
    pub orders: Orders,
}

/// Circuits that differ only by the order of impacts without a common mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Orders {
    /// Number of gaps for which circuits were enumerated.
    pub vertices: usize,
    /// Simple circuits.
    pub circuits: usize,
    /// Classes of them that differ for no mass.
    pub classes: usize,
    /// p_jump for the paper's N.
    pub p: f64,
    /// Mean number of different gaps there if each class weighs p^k once.
    pub mean: f64,
}

/// One ensemble. Estimates are ratios of sums over realisations, with errors by the jackknife.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Dependence {
    /// Which.
    pub row: IndependenceRow,
    /// Number of gaps N.
    pub gaps: usize,
    /// Impacts of each gap, in each realisation with impacts.
    pub hits: Vec<Vec<u64>>,
    /// How many cells of the transition matrices have which count, over all realisations.
    pub histogram: Vec<[u64; 2]>,
    /// Impacts by distance to the gap of the next.
    pub distances: Vec<u64>,
    /// Impacts by the place of the next impact of their masses: left, same gap, right.
    pub next: [u64; 3],
    /// Impacts that begin a simple circuit of length k, at index k − 1.
    pub circuits: Vec<u64>,
    /// The same of Markov chains with the measured transition matrices.
    pub markov: Vec<u64>,
    /// Of the short circuits those that pass by a neighbour of their first gap.
    pub passing: u64,
    /// Pairs of circuits i → j → i of the same realisation, and those of the same two gaps.
    pub returns: [u64; 2],
    /// 1/Σ π²: so many gaps with the same frequency would give as many coincidences.
    pub effective: Option<Estimate>,
    /// Entropy of the frequencies, in nats.
    pub entropy: Option<Estimate>,
    /// Information of an impact about the next, in nats.
    pub information: Option<Estimate>,
    /// The same after shuffling.
    pub shuffled: Option<Estimate>,
    /// Their difference over the entropy.
    pub dependence: Option<Estimate>,
    /// Successions at distance |i − j| over those of independent impacts with the same frequencies, by
    /// distance from zero.
    pub near: Vec<Option<Estimate>>,
    /// Share of impacts of which the next of their masses is at the same gap.
    pub same: Option<Estimate>,
    /// The same of independent impacts with the same frequencies.
    pub same_independent: Option<Estimate>,
    /// Probability that an impact begins a simple circuit of length k, at index k − 1, if all gaps are
    /// alike and independent.
    pub uniform: Vec<f64>,
    /// Circuits i → i over those of equal and independent gaps.
    pub loops: Option<Estimate>,
    /// Short circuits, 2 ≤ k, over those of equal and independent gaps.
    pub short: Option<Estimate>,
    /// The same of Markov chains.
    pub short_markov: Option<Estimate>,
    /// N times the factor by which the frequency of a single circuit changes with each gap more.
    pub step: Option<Estimate>,
    /// Share of short circuits that pass by a neighbour of their first gap.
    pub passing_share: Option<Estimate>,
    /// The same if all gaps are alike and independent.
    pub passing_independent: f64,
    /// Probability that two circuits i → j → i of one realisation are the same, times the number of
    /// such circuits.
    pub collisions: Option<Estimate>,
    /// Mean length of a simple circuit that begins at an impact.
    pub length: Option<Estimate>,
    /// The same of Markov chains.
    pub length_markov: Option<Estimate>,
    /// The same if all gaps are alike and independent.
    pub length_uniform: f64,
    /// Different gaps among successive impacts.
    pub distinct: Vec<Distinct>,
    /// Realisations without impacts in the window, and those that the engine ended early.
    pub without: [usize; 2],
}

/// Different gaps among m successive impacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distinct {
    /// Number of impacts m.
    pub impacts: usize,
    /// Blocks of m impacts, of each realisation with impacts.
    pub blocks: Vec<u64>,
    /// Different gaps in them, added up over everything.
    pub different: u64,
    /// The same of Markov chains with the measured transition matrices.
    pub different_markov: u64,
    /// Mean number of different gaps.
    pub mean: Option<Estimate>,
    /// The same of Markov chains with the measured transition matrices.
    pub markov: Option<Estimate>,
    /// The same of independent impacts with the measured frequencies.
    pub frequencies: Option<Estimate>,
    /// The same of independent impacts of gaps that are alike.
    pub uniform: f64,
}

impl Independence {
    /// The rows of the paper's chain, by rising σ.
    pub fn long(&self) -> impl Iterator<Item = &Dependence> {
        self.rows.iter().filter(|row| row.row.masses == self.parameters.chain.masses)
    }
}

/// One realisation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    hits: Vec<u64>,
    histogram: Vec<[u64; 2]>,
    distances: Vec<u64>,
    /// In nats: measured, and shuffled.
    information: [f64; 2],
    next: [u64; 3],
    circuits: Vec<u64>,
    passing: u64,
    returns: [u64; 2],
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
    Cutting { rows, part, fits, join: joining::join };

/// Runs all ensembles.
///
/// # Errors
/// [`Error::Interrupted`]; [`Error::Dynamics`] if the chain is not allowed.
pub fn run(parameters: &IndependenceParams, progress: &Progress) -> Result<Independence, Error> {
    CUTTING.run(parameters, "independence", progress)
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
    let fault = |source| Error::Dynamics { experiment: "independence", source };
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
