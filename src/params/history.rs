//! Chains that are heated first: sizes of the experiment.

use super::{Chain, Grid, Profile, SEED};
use serde::{Deserialize, Serialize};

/// Chains that run under a large force, which is then lowered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HistoryParams {
    /// The chain.
    pub chain: Chain,
    /// Standard deviation σ of the force at first ...
    pub hot: f64,
    /// ... and for how long.
    pub heating: f64,
    /// Standard deviations σ to which it is lowered, rising.
    pub sigmas: Vec<f64>,
    /// Transients T since then, rising.
    pub transients: Vec<f64>,
    /// Window W.
    pub window: f64,
    /// Realisations at each σ.
    pub realisations: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl HistoryParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        let (sigmas, last, realisations) = match profile {
            Profile::Full => (Grid::default().and(2, 13, 1, 100), 4000.0, 32),
            Profile::Quick => (Grid::default().and(6, 12, 3, 100), 1000.0, 3),
        };
        HistoryParams {
            chain: Chain::default(),
            hot: 0.2,
            heating: 300.0,
            sigmas: sigmas.values(),
            transients: vec![500.0, last],
            window: 200.0,
            realisations,
            stream: "history".into(),
            seed: SEED,
        }
    }
}
