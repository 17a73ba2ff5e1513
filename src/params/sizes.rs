//! Sample sizes and grids of each profile, in one place.

use super::{Chain, PRINTED_THRESHOLD, Profile, SEED};
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

/// Twin runs that differ in the last bit of every amplitude.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HorizonParams {
    /// The chain without its forcing.
    pub chain: Chain,
    /// Standard deviation σ.
    pub sigma: f64,
    /// Time at which the twins are given up.
    pub until: f64,
    /// Number of twins.
    pub realisations: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl HorizonParams {
    /// The twins of each profile.
    pub fn new(profile: Profile) -> Self {
        HorizonParams {
            chain: Chain::default(),
            sigma: 0.2,
            until: 500.0,
            realisations: if profile == Profile::Quick { 10 } else { 100 },
            stream: "horizon".into(),
            seed: SEED,
        }
    }
}

/// Two masses under a low force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoMassesParams {
    /// The chain, with n = 2.
    pub chain: Chain,
    /// Times within which an impact must come, rising.
    pub times: Vec<f64>,
    /// Number of random directions of the forcing.
    pub directions: usize,
    /// Halvings of the bracket around the smallest amplitude.
    pub halvings: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl TwoMassesParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        let (times, directions) = match profile {
            Profile::Full => (vec![1e2, 1e3, 1e4], 40),
            Profile::Quick => (vec![1e2, 1e3], 10),
        };
        TwoMassesParams {
            chain: Chain { masses: 2, ..Chain::default() },
            times,
            directions,
            halvings: 28,
            stream: "two-masses".into(),
            seed: SEED,
        }
    }
}

/// One realisation at the printed threshold, kept impact by impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceTimeParams {
    /// The chain without its forcing.
    pub chain: Chain,
    /// Standard deviation σ.
    pub sigma: f64,
    /// Length of the run.
    pub until: f64,
    /// The first realisation is taken that has an impact in the last part of this length.
    pub last: f64,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl SpaceTimeParams {
    /// The run of each profile.
    pub fn new(profile: Profile) -> Self {
        let until = if profile == Profile::Quick { 400.0 } else { 4000.0 };
        SpaceTimeParams {
            chain: Chain::default(),
            sigma: PRINTED_THRESHOLD,
            until,
            last: until / 10.0,
            stream: "space-time".into(),
            seed: SEED,
        }
    }
}
