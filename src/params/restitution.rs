//! What restitution does to a chain: sizes of the experiment.

use super::{Chain, Grid, Profile, Protocol, SEED};
use serde::{Deserialize, Serialize};

/// Chains with several restitutions, the random numbers being common to all.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestitutionParams {
    /// The chain, but for its restitution.
    pub chain: Chain,
    /// Transient, and the window in which is counted.
    pub protocol: Protocol,
    /// Restitutions r of the curves over σ, rising.
    pub restitutions: Vec<f64>,
    /// Standard deviations σ of the amplitudes of these curves, rising.
    pub sigmas: Vec<f64>,
    /// Realisations of each (r, σ).
    pub realisations: usize,
    /// Restitutions of the chains that are watched while they heat, rising; 1 is the last.
    pub heated: Vec<f64>,
    /// σ of these.
    pub heated_sigma: f64,
    /// Ends of the windows in which they are watched, each twice the one before.
    pub ends: Vec<f64>,
    /// Realisations of each of these.
    pub heated_realisations: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl RestitutionParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        let rise = Grid::default();
        let (restitutions, sigmas, realisations): (&[f64], _, _) = match profile {
            Profile::Full => (
                &[0.0, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95],
                rise.and(8, 18, 1, 100).and(4, 6, 1, 20).and(2, 3, 1, 5),
                24,
            ),
            Profile::Quick => (&[0.0, 0.8], rise.and(9, 15, 6, 100).and(30, 60, 30, 100), 2),
        };
        let (heated, doublings, heated_realisations): (&[f64], _, _) = match profile {
            Profile::Full => (&[0.9, 0.98, 0.995, 1.0], 6, 8),
            Profile::Quick => (&[0.9, 1.0], 2, 2),
        };
        RestitutionParams {
            chain: Chain::default(),
            protocol: Protocol::default(),
            restitutions: restitutions.to_vec(),
            sigmas: sigmas.values(),
            realisations,
            heated: heated.to_vec(),
            heated_sigma: 0.3,
            ends: (0..=doublings).map(|i| 25.0 * f64::from(1_u32 << i)).collect(),
            heated_realisations,
            stream: "restitution".into(),
            seed: SEED,
        }
    }
}
