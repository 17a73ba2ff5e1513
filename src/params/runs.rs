//! Defines runs of equal chains at one σ, and the sizes of the experiments that consist of them.

use super::chosen::{SEED, printed_threshold};
use super::ensembles::Grid;
use impact_chain::{Chain, Scenario};
use impact_numerics::random::{NormalPairs, Seed};
use literate::experiments::Profile;
use serde::{Deserialize, Serialize};

/// Equal chains under random forces of one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Runs {
    pub chain: Chain,
    pub sigma: f64,
    pub until: f64,
    pub realisations: usize,
    pub stream: String,
    pub seed: u64,
}

impl Runs {
    /// Returns the runs whose twins differ in the last bit of every amplitude.
    pub fn horizon(profile: Profile) -> Self {
        let realisations = if profile == Profile::Quick { 10 } else { 100 };
        let (chain, stream) = (Chain::default(), "horizon".into());
        Runs { chain, sigma: 0.2, until: 500.0, realisations, stream, seed: SEED }
    }

    /// Returns runs at the printed threshold, of which the first with an impact in its last tenth
    /// is recorded.
    pub fn spacetime(profile: Profile) -> Self {
        let until = if profile == Profile::Quick { 400.0 } else { 4000.0 };
        let (chain, stream) = (Chain::default(), "space-time".into());
        Runs { chain, sigma: printed_threshold(), until, realisations: 1000, stream, seed: SEED }
    }

    /// Draws the forces of a realisation.
    pub fn scenario(&self, index: u64) -> Scenario {
        let mut normals = NormalPairs::new(&self.stream, Seed(self.seed), index);
        Scenario::draw(&self.chain, self.sigma, &mut normals)
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoMassesParams {
    /// Random directions of the forcing, as amplitudes with σ = 1.
    pub directions: Runs,
    /// Times within which an impact must come, rising.
    pub times: Vec<f64>,
}

impl TwoMassesParams {
    pub fn new(profile: Profile) -> Self {
        let (times, realisations) = match profile {
            Profile::Full => (vec![1e2, 1e3, 1e4], 40),
            Profile::Quick => (vec![1e2, 1e3], 10),
        };
        let chain = Chain { masses: 2, ..Chain::default() };
        let (sigma, until, stream) = (1.0, 1e4, "two-masses".into());
        let directions = Runs { chain, sigma, until, realisations, stream, seed: SEED };
        TwoMassesParams { directions, times }
    }
}

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
