//! First impacts: how many chains have one by some time, against what the reach of single gaps says.

pub mod tables;

use super::ensembles::{Begun, Ensembles, Ran};
use super::{Error, Progress};
use crate::params::{Chain, NucleationParams};
use impact_chain::{self, Engine, Scenario};
use impact_numerics::random::NormalPairs;
use literate::experiments::cutting::Row;

/// First impacts of chains from rest, for each length and σ: length by length.
pub type Nucleation = Ran<NucleationParams, First>;

/// The time of a chain's first impact, if it has one in time.
pub type First = Option<f64>;

/// The ensembles in their order.
fn ensembles(parameters: &NucleationParams) -> impl Iterator<Item = (usize, usize, f64)> {
    let of = |&(masses, realisations): &(usize, usize)| {
        parameters.sigmas.iter().map(move |&sigma| (masses, realisations, sigma))
    };
    parameters.lengths.iter().flat_map(of)
}

impl Ensembles for NucleationParams {
    type One = First;

    fn rows(&self) -> Vec<Row> {
        let row = |(masses, realisations, sigma)| Row {
            covers: format!("n = {masses}, sigma = {sigma}"),
            realisations,
            // A search of a gap costs about what an impact does.
            weight: masses as u64 + 1,
        };
        ensembles(self).map(row).collect()
    }

    fn row<'a>(&'a self, row: usize, _: &'a Progress) -> Begun<'a, First> {
        let (masses, _, sigma) = ensembles(self).nth(row).unwrap_or_default();
        let chain = Chain { masses, ..self.chain.clone() };
        Ok(Box::new(move |index| first(self, &chain, sigma, index)))
    }

    fn fits(&self, _: usize, time: &First) -> bool {
        let last = self.times.last().copied().unwrap_or(0.0);
        time.is_none_or(|time| (0.0..=last).contains(&time))
    }
}

fn first(
    parameters: &NucleationParams,
    chain: &Chain,
    sigma: f64,
    index: u64,
) -> Result<First, Error> {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(chain, sigma, &mut normals);
    let fault = |source: impact_chain::Error| Error::failed("nucleation", source);
    let until = parameters.times.last().copied().unwrap_or(0.0);
    let mut engine = Engine::new(&scenario).map_err(fault)?;
    Ok(engine.next_impact(until).map_err(fault)?.map(|impact| impact.time))
}
