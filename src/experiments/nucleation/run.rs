//! First impacts: how many chains have one by some time, and the number expected from the reach of single gaps.

use crate::experiments::prelude::*;
use crate::params::NucleationParams;

/// First impacts of chains from rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Nucleation {
    /// What was run.
    pub parameters: NucleationParams,
    /// For each length and σ, length by length, the realisations.
    pub rows: Vec<Vec<First>>,
}

/// The time of a chain's first impact, if it has one in time.
pub type First = Option<f64>;

/// The ensembles in their order: masses, realisations, σ.
pub(super) fn ensembles(
    parameters: &NucleationParams,
) -> impl Iterator<Item = (usize, usize, f64)> {
    let of = |&(masses, realisations): &(usize, usize)| {
        parameters.sigmas.iter().map(move |&sigma| (masses, realisations, sigma))
    };
    parameters.lengths.iter().flat_map(of)
}

/// Chains of all ensembles.
pub(super) fn count(parameters: &NucleationParams) -> u64 {
    ensembles(parameters).map(|(_, realisations, _)| realisations as u64).sum()
}

/// Runs all chains, each to its first impact.
pub fn run(parameters: &NucleationParams, progress: &Progress) -> Result<Nucleation, Error> {
    let stage = progress.stage("first impacts", count(parameters));
    let rows = ensembles(parameters).map(|(masses, realisations, sigma)| {
        let chain = Chain { masses, ..parameters.chain.clone() };
        let one = |index| first(parameters, &chain, sigma, index);
        each(&stage, progress, 0..realisations as u64, one)
    });
    Ok(Nucleation { parameters: parameters.clone(), rows: rows.collect::<Result<_, _>>()? })
}

fn first(
    parameters: &NucleationParams,
    chain: &Chain,
    sigma: f64,
    index: u64,
) -> Result<First, Error> {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(chain, sigma, &mut normals);
    let until = parameters.times.last().copied().unwrap_or(0.0);
    let impact = Engine::new(&scenario).and_then(|mut engine| engine.next_impact(until));
    let impact = impact.map_err(|source| Error::failed("nucleation", source))?;
    Ok(impact.map(|impact| impact.time))
}
