//! The map over transients and windows: sizes of the experiment.

use super::{Chain, Grid, Profile, SEED};
use serde::{Deserialize, Serialize};

/// The map of the half height over transient and window: one long run of each realisation, in
/// which every window is read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProtocolParams {
    /// The chain without its forcing.
    pub chain: Chain,
    /// Transients T, rising.
    pub transients: Vec<f64>,
    /// Windows W, rising.
    pub windows: Vec<f64>,
    /// Standard deviations σ, rising.
    pub sigmas: Vec<f64>,
    /// Above this σ ...
    pub short_above: f64,
    /// ... windows that end later than this are not run: the chain is full long before.
    pub short_until: f64,
    /// Realisations at each σ.
    pub realisations: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl ProtocolParams {
    /// The long end of the map.
    pub fn long(profile: Profile) -> Self {
        let (transients, windows, step, realisations) = match profile {
            Profile::Full => (vec![1e3, 4e3, 1e4, 2e4], vec![20.0, 200.0, 2000.0], 1, 12),
            Profile::Quick => (vec![500.0, 1e3], vec![20.0, 200.0], 11, 2),
        };
        ProtocolParams {
            transients,
            windows,
            sigmas: Grid::default().and(26, 48, step, 400).values(),
            // None is shortened.
            short_above: 1.0,
            short_until: 1e6,
            realisations,
            stream: "long-protocol".into(),
            chain: Chain::default(),
            seed: SEED,
        }
    }

    /// The map of each profile.
    pub fn new(profile: Profile) -> Self {
        let (longest, widest, sigmas, realisations) = match profile {
            Profile::Full => {
                (9, 7, Grid::default().and(34, 68, 2, 400).and(18, 22, 1, 100).values(), 120)
            }
            Profile::Quick => (6, 5, Grid::default().and(9, 17, 1, 100).values(), 6),
        };
        let transients = [10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 4000.0];
        let windows = [20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0];
        ProtocolParams {
            chain: Chain::default(),
            transients: transients[..longest].to_vec(),
            windows: windows[..widest].to_vec(),
            sigmas,
            short_above: 0.131,
            short_until: 1000.0,
            realisations,
            stream: "protocol".into(),
            seed: SEED,
        }
    }
}
