//! First impacts: how many chains have one by some time, against what the reach of single gaps says.

use super::cutting::{Cutting, Row, Unit};
use super::progress::Stage;
use super::{Error, Progress};
use crate::circuits::impact_probability::ImpactProbability;
use crate::circuits::nucleation::chain::half;
pub use crate::circuits::nucleation::chain::{AtLeastOne, Chances};
use crate::circuits::nucleation::reach::{Reach, closes_by_itself};
use crate::dynamics::{self, Engine, Scenario};
use crate::numerics::random::NormalPairs;
use crate::params::{Chain, NucleationParams};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// First impacts of chains from rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Nucleation {
    /// What was run.
    pub parameters: NucleationParams,
    /// For each σ what single gaps and neighbours do.
    pub gaps: Vec<Gaps>,
    /// For each length and σ what chains do: length by length.
    pub chains: Vec<Chains>,
    /// The σ at which half of the paper's chains have a gap that closes by itself in unlimited time.
    pub half: f64,
}

/// Gaps at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gaps {
    /// Standard deviation σ.
    pub sigma: f64,
    /// Within each time.
    pub within: Vec<Chances>,
    /// In unlimited time.
    pub ever: Chances,
    /// Eq. (25): a start with random free parts, between masses.
    pub random: f64,
    /// A start without free parts, between masses.
    pub zero: f64,
}

/// Chains of one length at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chains {
    /// Number n of masses.
    pub masses: usize,
    /// Standard deviation σ.
    pub sigma: f64,
    /// Chains that were run.
    pub realisations: u64,
    /// Those with a gap that closes by itself in unlimited time.
    pub able: u64,
    /// Those with an impact by each time.
    pub hit: Vec<u64>,
    /// What is expected of them, by each time.
    pub expected: Vec<AtLeastOne>,
    /// What is expected in unlimited time.
    pub ever: AtLeastOne,
}

/// One chain: whether it has a gap that closes by itself, and the time of its first impact.
pub type First = (bool, Option<f64>);

/// Some chains of one row.
pub type Part = Vec<First>;

/// The experiment in units of work.
pub const CUTTING: Cutting<NucleationParams, Part, Nucleation> = Cutting { rows, part, fits, join };

/// The ensembles in their order.
fn ensembles(parameters: &NucleationParams) -> impl Iterator<Item = (usize, usize, f64)> {
    let of = |&(masses, realisations): &(usize, usize)| {
        parameters.sigmas.iter().map(move |&sigma| (masses, realisations, sigma))
    };
    parameters.lengths.iter().flat_map(of)
}

fn rows(parameters: &NucleationParams) -> Vec<Row> {
    let row = |(masses, realisations, sigma)| Row {
        covers: format!("n = {masses}, sigma = {sigma}"),
        realisations,
        // A search of a gap costs about what an impact does.
        weight: masses as u64 + 1,
    };
    ensembles(parameters).map(row).collect()
}

fn part(
    parameters: &NucleationParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Part, Error> {
    let ensemble = ensembles(parameters).nth(unit.row);
    let (masses, _, sigma) = ensemble.unwrap_or_default();
    let chain = Chain { masses, ..parameters.chain.clone() };
    let one = |index| {
        let found = first(parameters, &chain, sigma, index as u64, progress);
        stage.advance(masses as u64 + 1);
        found
    };
    unit.realisations.clone().into_par_iter().with_max_len(64).map(one).collect()
}

fn first(
    parameters: &NucleationParams,
    chain: &Chain,
    sigma: f64,
    index: u64,
    progress: &Progress,
) -> Result<First, Error> {
    progress.check()?;
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(chain, sigma, &mut normals);
    let able = differences(&scenario.forcing).any(|delta| closes_by_itself(chain, delta));
    let fault = |source: dynamics::Error| Error::Dynamics { experiment: "nucleation", source };
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

fn fits(parameters: &NucleationParams, unit: &Unit, firsts: &Part) -> bool {
    let last = parameters.times.last().copied().unwrap_or(0.0);
    let fits = |(able, time): &First| time.is_none_or(|time| *able && (0.0..=last).contains(&time));
    firsts.len() == unit.realisations.len() && firsts.iter().all(fits)
}

pub(crate) fn join(
    parameters: &NucleationParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<Nucleation, Error> {
    let chain = &parameters.chain;
    let within = Reach::within(chain, &parameters.times, parameters.angles);
    // Pairs take the square of the number of angles.
    let coarse = |reach: &Reach| reach.every(parameters.angles / COARSE);
    let pairs: Vec<Reach> = within.iter().map(coarse).collect();
    let ever = Reach::ever(chain, COARSE);
    let gaps = |&sigma: &f64| {
        progress.check()?;
        let within = within.iter().zip(&pairs);
        Ok(Gaps {
            sigma,
            within: within.map(|(all, few)| Chances::new(chain, all, few, sigma)).collect(),
            ever: Chances::new(chain, &ever, &ever, sigma),
            random: p_random(chain, sigma)?,
            zero: p_zero(chain, sigma),
        })
    };
    let gaps: Vec<Gaps> = parameters.sigmas.par_iter().map(gaps).collect::<Result<_, Error>>()?;
    let chains = ensembles(parameters).zip(parts).enumerate();
    let chains = chains.map(|(row, ((masses, _, sigma), parts))| {
        let own = &gaps[row % parameters.sigmas.len()];
        let expected = |chances: &Chances| chances.at_least_one(masses, chain.boundary);
        let firsts = parts.concat();
        let by = |limit: &f64| {
            firsts.iter().filter(|(_, time)| time.is_some_and(|time| time <= *limit)).count() as u64
        };
        Chains {
            masses,
            sigma,
            realisations: firsts.len() as u64,
            able: firsts.iter().filter(|(able, _)| *able).count() as u64,
            hit: parameters.times.iter().map(by).collect(),
            expected: own.within.iter().map(expected).collect(),
            ever: expected(&own.ever),
        }
    });
    Ok(Nucleation {
        parameters: parameters.clone(),
        chains: chains.collect(),
        gaps,
        half: half(chain, &ever, &ever),
    })
}

/// Angles of the rule for neighbours.
const COARSE: usize = 64;

/// Eq. (25) for the chain.
fn p_random(chain: &Chain, sigma: f64) -> Result<f64, Error> {
    let (d, omega, big_omega) = (chain.spacing, chain.natural_frequency, chain.forcing_frequency);
    let law = ImpactProbability::new(sigma, d, omega, big_omega).and_then(|law| law.p());
    law.map_err(|error| Error::input("sigmas", error.to_string(), "see src/params/nucleation.rs"))
}

/// P(Y_1 ≥ d): without a free part the forced one has to do it alone.
fn p_zero(chain: &Chain, sigma: f64) -> f64 {
    let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
    let least = chain.spacing * (omega * omega - big_omega * big_omega) / (2.0 * sigma);
    pxfm::f_exp(-least * least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Profile;

    #[test]
    fn the_first_impact_is_in_a_gap_that_closes_by_itself() {
        let mut parameters = NucleationParams::new(Profile::Quick);
        parameters.lengths = vec![(1, 40), (30, 40)];
        parameters.sigmas = vec![0.1, 0.16, 0.3];
        parameters.angles = 2 * COARSE;
        let found = CUTTING.run(&parameters, "test", &Progress::silent()).unwrap();
        assert_eq!((found.gaps.len(), found.chains.len()), (3, 6));
        for row in &found.chains {
            assert!(row.hit.iter().all(|hit| *hit <= row.able), "{row:?}");
        }
        // By T = 500 nearly all that can have closed.
        let late: u64 = found.chains.iter().map(|row| row.able - row.hit[row.hit.len() - 1]).sum();
        assert!(late <= 3, "{late}");
        let hits: Vec<u64> = found.chains.iter().map(|row| row.hit[0]).collect();
        assert!(hits[5] == 40 && hits[3] < 25 && hits[0] < 5, "{hits:?}");
    }

    #[test]
    fn gaps_lie_between_neighbours_and_unforced_walls() {
        let found: Vec<_> = differences(&[[1.0, 2.0], [4.0, -1.0]]).collect();
        assert_eq!(found, [[1.0, 2.0], [3.0, -3.0], [-4.0, 1.0]]);
    }
}
