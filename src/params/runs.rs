//! Defines runs of equal chains at one σ, and the sizes of the experiments that consist of them.

use super::chosen::{SEED, printed_threshold};
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
