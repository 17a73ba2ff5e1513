//! Sample sizes and grids of each profile, in one place.

use super::{Chain, Profile, SEED};
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
            realisations: match profile {
                Profile::Full => 100,
                Profile::Quick => 10,
            },
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
        TwoMassesParams {
            chain: Chain { masses: 2, ..Chain::default() },
            times: match profile {
                Profile::Full => vec![1e2, 1e3, 1e4],
                _ => vec![1e2, 1e3],
            },
            directions: match profile {
                Profile::Full => 40,
                Profile::Quick => 10,
            },
            halvings: 28,
            stream: "two-masses".into(),
            seed: SEED,
        }
    }
}
