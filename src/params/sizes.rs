//! Sample sizes and grids of each profile, in one place.

use super::{Chain, PRINTED_THRESHOLD, Profile, SEED};
use impact_chain::Scenario;
use impact_numerics::random::NormalPairs;
use serde::{Deserialize, Serialize};

/// A σ axis made of stretches of equal steps; values are exact quotients, so 0.12 is the double
/// nearest to 0.12.
#[derive(Clone, Debug, Default)]
pub struct Grid(Vec<f64>);

impl Grid {
    /// Appends i / `denominator` for i = `from`, `from` + `step`, … up to `to`, included.
    pub fn and(mut self, from: u32, to: u32, step: usize, denominator: u32) -> Self {
        self.0.extend((from..=to).step_by(step).map(|i| f64::from(i) / f64::from(denominator)));
        self
    }

    /// The values, rising.
    pub fn values(self) -> Vec<f64> {
        debug_assert!(self.0.windows(2).all(|w| w[0] < w[1]));
        self.0
    }
}

/// Chains of one kind at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Runs {
    /// The chain without its forcing.
    pub chain: Chain,
    /// Standard deviation σ.
    pub sigma: f64,
    /// Time at which runs end.
    pub until: f64,
    /// Number of realisations.
    pub realisations: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl Runs {
    /// Twins that differ in the last bit of every amplitude.
    pub fn horizon(profile: Profile) -> Self {
        let realisations = if profile == Profile::Quick { 10 } else { 100 };
        let (chain, stream) = (Chain::default(), "horizon".into());
        Runs { chain, sigma: 0.2, until: 500.0, realisations, stream, seed: SEED }
    }

    /// A run at the printed threshold, recorded impact by impact: the first of these that has an impact in its last tenth.
    pub fn spacetime(profile: Profile) -> Self {
        let until = if profile == Profile::Quick { 400.0 } else { 4000.0 };
        let (chain, stream) = (Chain::default(), "space-time".into());
        Runs { chain, sigma: PRINTED_THRESHOLD, until, realisations: 1000, stream, seed: SEED }
    }

    /// A realisation.
    pub fn scenario(&self, index: u64) -> Scenario {
        let mut normals = NormalPairs::new(&self.stream, self.seed, index);
        Scenario::draw(&self.chain, self.sigma, &mut normals)
    }
}

/// Two masses under a low force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoMassesParams {
    /// Random directions of the forcing, as amplitudes with σ = 1.
    pub directions: Runs,
    /// Times within which an impact must come, rising.
    pub times: Vec<f64>,
}

impl TwoMassesParams {
    /// The sizes of each profile.
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
