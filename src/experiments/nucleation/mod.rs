//! First impacts: how many chains have one by some time, against what the reach of single gaps says.

pub mod tables;

use super::ensembles::{Begun, Ensembles, Ran};
use super::{Error, Progress};
use crate::circuits::nucleation::reach::closes_by_itself;
use crate::dynamics::{self, Engine, Scenario};
use crate::numerics::random::NormalPairs;
use crate::params::{Chain, NucleationParams};
use literate::experiments::cutting::Row;

/// First impacts of chains from rest, for each length and σ: length by length.
pub type Nucleation = Ran<NucleationParams, First>;

/// One chain: whether it has a gap that closes by itself, and the time of its first impact.
pub type First = (bool, Option<f64>);

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

    fn fits(&self, _: usize, (able, time): &First) -> bool {
        let last = self.times.last().copied().unwrap_or(0.0);
        time.is_none_or(|time| *able && (0.0..=last).contains(&time))
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
    let able = differences(&scenario.forcing).any(|delta| closes_by_itself(chain, delta));
    let fault = |source: dynamics::Error| Error::failed("nucleation", source);
    let mut time = None;
    Engine::new(&scenario)
        .map_err(fault)?
        .run(parameters.times.last().copied().unwrap_or(0.0), |impact| {
            time = Some(impact.time);
            false
        })
        .map_err(fault)?;
    Ok((able, time))
}

/// The differences of the amplitudes on both sides of each gap of a chain between walls, which are
/// not forced.
pub(super) fn differences(forcing: &[[f64; 2]]) -> impl Iterator<Item = [f64; 2]> {
    let wall = || std::iter::once([0.0; 2]);
    let left = wall().chain(forcing.iter().copied());
    let right = forcing.iter().copied().chain(wall());
    left.zip(right).map(|(a, b)| [b[0] - a[0], b[1] - a[1]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::ensembles::cutting;
    use crate::params::Profile;

    #[test]
    fn the_first_impact_is_in_a_gap_that_closes_by_itself() {
        let mut parameters = NucleationParams::new(Profile::Quick);
        parameters.lengths = vec![(1, 40), (30, 40)];
        parameters.sigmas = vec![0.1, 0.16, 0.3];
        let found = cutting().run(&parameters, "test", &Progress::silent()).unwrap();
        let tables = tables::tables(&found);
        let chains = tables.iter().find(|table| table.name() == "nucleation.chains").unwrap();
        let hits = |masses: f64, sigma: f64, time: f64| {
            let keys = [("masses", masses), ("sigma", sigma), ("time", time)];
            let [able, found] = ["able", "found"].map(|of| chains.number(&keys, of).unwrap());
            [able, 40.0 * found]
        };
        for (masses, sigma) in [1.0, 30.0].map(|n| [(n, 0.1), (n, 0.16), (n, 0.3)]).concat() {
            // By T = 500 nearly all that can have closed, and no others.
            let [able, hit] = hits(masses, sigma, 500.0);
            assert!(hit <= able && able <= hit + 2.0, "{hit} {able}");
        }
        let early =
            [(1.0, 0.1), (30.0, 0.1), (30.0, 0.3)].map(|(n, sigma)| hits(n, sigma, 10.0)[1]);
        assert!(early[0] < 5.0 && early[1] < 25.0 && early[2] == 40.0, "{early:?}");
    }

    #[test]
    fn gaps_lie_between_neighbours_and_unforced_walls() {
        let found: Vec<_> = differences(&[[1.0, 2.0], [4.0, -1.0]]).collect();
        assert_eq!(found, [[1.0, 2.0], [3.0, -3.0], [-4.0, 1.0]]);
    }
}
