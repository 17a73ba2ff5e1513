//! Sizes of the experiments on gaps that close by themselves and on the spreading of impacts from
//! one of them.

use super::chosen::SEED;
use super::grid::Grid;
use impact_chain::Chain;
use literate::experiments::Profile;
use serde::{Deserialize, Serialize};

/// Chains from rest, run until their first impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NucleationParams {
    /// The chain, but for its length.
    pub chain: Chain,
    /// Numbers of masses n, each with its realisations at each σ.
    pub lengths: Vec<(usize, usize)>,
    /// Standard deviations σ, rising.
    pub sigmas: Vec<f64>,
    /// Times T by which a first impact is looked for, rising.
    pub times: Vec<f64>,
    pub stream: String,
    pub seed: u64,
}

impl NucleationParams {
    pub fn new(profile: Profile) -> Self {
        let (lengths, sigmas, last): (&[_], _, _) = match profile {
            Profile::Full => (
                &[(10, 4000), (100, 2000), (1000, 400)],
                Grid::default().and(6, 16, 1, 100),
                2000.0,
            ),
            Profile::Quick => (&[(10, 60), (100, 30)], Grid::default().and(8, 16, 2, 100), 500.0),
        };
        let times = [10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0];
        NucleationParams {
            chain: Chain::default(),
            lengths: lengths.to_vec(),
            sigmas: sigmas.values(),
            times: times.into_iter().filter(|time| *time <= last).collect(),
            stream: "nucleation".into(),
            seed: SEED,
        }
    }
}

/// Chains from rest of which exactly one gap closes by itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedsParams {
    pub chain: Chain,
    /// Standard deviations σ, rising.
    pub sigmas: Vec<f64>,
    pub realisations: usize,
    /// A chain whose one gap has not closed by this time is left out.
    pub wait: f64,
    /// Width of the bins of time since its first impact ...
    pub bin: f64,
    /// ... and their number, 64 at most.
    pub bins: usize,
    /// Window W of the counts that are predicted, in bins.
    pub window: usize,
    /// Transients T of the counts that are predicted, in bins, rising; the last window ends with
    /// the bins.
    pub transients: Vec<usize>,
    pub stream: String,
    pub seed: u64,
}

impl SeedsParams {
    pub fn new(profile: Profile) -> Self {
        let (sigmas, realisations) = match profile {
            Profile::Full => (Grid::default().and(16, 30, 1, 200).and(16, 16, 1, 100), 240),
            Profile::Quick => (Grid::default().and(9, 14, 1, 100), 6),
        };
        SeedsParams {
            chain: Chain::default(),
            sigmas: sigmas.values(),
            realisations,
            wait: 2000.0,
            bin: 25.0,
            bins: 48,
            window: 8,
            transients: vec![2, 4, 8, 20, 40],
            stream: "seeds".into(),
            seed: SEED,
        }
    }

    /// Time since the first impact for which a run is followed.
    pub fn until(&self) -> f64 {
        self.bin * self.bins as f64
    }
}
