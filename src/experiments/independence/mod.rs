//! Are impacts independent: sequences of impacts beside the fully connected graph of Secs. 3 to 6.

mod succession;
pub mod tables;

use super::ensembles::{Begun, Ensembles, Ran, Running};
use super::{Error, Progress, weights};
use crate::dynamics::Scenario;
use crate::numerics::random::{NormalPairs, generator};
use crate::params::IndependenceParams;
use literate::experiments::cutting::Row;
use serde::{Deserialize, Serialize};
use succession::{Matrix, distinct, hits, next};

/// What successive impacts have to do with one another: what became of each realisation.
pub type Independence = Ran<IndependenceParams, Outcome>;

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

/// Numbers of successive impacts of which the different gaps are counted.
fn blocks(parameters: &IndependenceParams, big_n: usize) -> impl Iterator<Item = usize> {
    (1..=parameters.quarters).map(move |i| (i * big_n / 4).max(1))
}

impl Ensembles for IndependenceParams {
    type One = Outcome;

    fn rows(&self) -> Vec<Row> {
        let until = self.protocol.transient + 2.0 * self.protocol.window;
        let row = |&sigma: &f64| Row {
            covers: format!("sigma = {sigma}"),
            realisations: self.realisations,
            weight: weights::run(&self.chain, sigma, until),
        };
        self.sigmas.iter().map(row).collect()
    }

    fn row<'a>(&'a self, row: usize, progress: &'a Progress) -> Begun<'a, Outcome> {
        Ok(Box::new(move |index| realisation(self, self.sigmas[row], index, progress)))
    }

    fn fits(&self, _: usize, outcome: &Outcome) -> bool {
        let big_n = self.chain.gaps();
        match outcome {
            Outcome::Failed | Outcome::Quiet => true,
            Outcome::Ran(run) => {
                let lists = [&run.hits, &run.distances, &run.circuits];
                lists.into_iter().all(|list| list.len() == big_n)
                    && run.hits.iter().sum::<u64>() > 1
                    && run.distinct.len() == self.quarters
            }
        }
    }
}

fn realisation(
    parameters: &IndependenceParams,
    sigma: f64,
    index: u64,
    progress: &Progress,
) -> Result<Outcome, Error> {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(&parameters.chain, sigma, &mut normals);
    let mut motion = Running::new(&scenario, "independence", progress)?;
    let (mut gaps, protocol) = (Vec::new(), parameters.protocol);
    let ended = motion.go(protocol.transient, |_| ())?
        && motion.go(protocol.transient + protocol.window, |impact| gaps.push(impact.gap))?;
    Ok(match ended {
        false => Outcome::Failed,
        true if gaps.len() < 2 => Outcome::Quiet,
        true => Outcome::Ran(Box::new(counted(parameters, &gaps, scenario.gaps(), index))),
    })
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
