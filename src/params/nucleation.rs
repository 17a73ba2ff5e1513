//! Chooses the sizes of the experiments on gaps that close by themselves, and on what spreads.

use super::chosen::SEED;
use super::grid::Grid;
use super::runs::Runs;
use impact_chain::Chain;
use literate::experiments::Profile;
use serde::{Deserialize, Serialize};

/// Chains from rest, run until their first impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NucleationParams {
    /// Numbers of masses n, each with its realisations at each σ.
    pub lengths: Vec<(usize, usize)>,
    pub sigmas: Vec<f64>,
    /// Times T by which a first impact is looked for, rising.
    pub times: Vec<f64>,
}

impl NucleationParams {
    pub fn new(profile: Profile) -> Self {
        let (lengths, sigmas, last): (&[_], _, _) = match profile {
            Profile::Full => {
                (&[(10, 4000), (100, 2000), (1000, 400)], Grid::default().and(6..=16, 100), 2000.0)
            }
            Profile::Quick => {
                (&[(10, 60), (100, 30)], Grid::default().and((8..=16).step_by(2), 100), 500.0)
            }
        };
        let mut times = vec![10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0];
        times.retain(|time| *time <= last);
        NucleationParams { lengths: lengths.to_vec(), sigmas: sigmas.values(), times }
    }

    /// Lists the runs, length by length and for each σ.
    pub fn runs(&self) -> impl Iterator<Item = Runs> {
        let until = self.times.last().copied().unwrap_or(0.0);
        let cases = self.lengths.iter();
        let cases = cases.flat_map(|length| self.sigmas.iter().map(move |sigma| (*length, *sigma)));
        cases.map(move |((masses, realisations), sigma)| {
            let chain = Chain { masses, ..Chain::default() };
            Runs { chain, sigma, until, realisations, stream: "nucleation".into(), seed: SEED }
        })
    }

    /// Counts the chains of all lengths and σ.
    pub fn chains(&self) -> u64 {
        self.runs().map(|runs| runs.realisations as u64).sum()
    }
}

/// Chains from rest of which exactly one gap closes by itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedsParams {
    pub chain: Chain,
    pub sigmas: Vec<f64>,
    pub realisations: usize,
    /// Width of the bins of time since its first impact ...
    pub bin: f64,
    /// ... and their number, 64 at most.
    pub bins: usize,
    /// Window W of the counts that are predicted, in bins.
    pub window: usize,
    /// Transients T of these counts, in bins, rising; the last window ends with the bins.
    pub transients: Vec<usize>,
}

impl SeedsParams {
    pub fn new(profile: Profile) -> Self {
        let (sigmas, realisations) = match profile {
            Profile::Full => (Grid::default().and(16..=30, 200).and([16], 100), 240),
            Profile::Quick => (Grid::default().and(9..=14, 100), 6),
        };
        SeedsParams {
            chain: Chain::default(),
            sigmas: sigmas.values(),
            realisations,
            bin: 25.0,
            bins: 48,
            window: 8,
            transients: vec![2, 4, 8, 20, 40],
        }
    }

    /// Time since the first impact for which a run is followed.
    pub fn until(&self) -> f64 {
        self.bin * self.bins as f64
    }
}
