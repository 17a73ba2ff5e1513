//! Are impacts independent: sizes of the experiment.

use super::{Chain, Profile, Protocol, set};
use serde::{Deserialize, Serialize};

/// Ensembles whose sequences of impacts are looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct IndependenceParams {
    /// The chain.
    pub chain: Chain,
    /// Transient, and the window in which impacts are taken down.
    pub protocol: Protocol,
    /// Standard deviations σ of the amplitudes, rising.
    pub sigmas: Vec<f64>,
    /// Realisations of each.
    pub realisations: usize,
    /// Numbers of successive impacts of which the different gaps are counted: so many of a
    /// quarter of the number of gaps.
    pub quarters: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl IndependenceParams {
    /// The largest length of a circuit that is called short.
    pub const SHORT: usize = 10;

    /// The distance from which on the next impact is called far.
    pub const FAR: usize = 10;

    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        let (sigmas, realisations, window): (&[f64], _, _) = match profile {
            Profile::Full | Profile::Deep => (&[0.12, 0.15, 0.2, 0.3], 24, 4000.0),
            Profile::Ci => (&[0.12, 0.2, 0.3], 8, 1000.0),
            Profile::Quick => (&[0.12, 0.3], 4, 600.0),
        };
        IndependenceParams {
            protocol: Protocol { transient: 500.0, window },
            chain: set::chain(),
            sigmas: sigmas.to_vec(),
            realisations,
            quarters: 12,
            stream: "independence".into(),
            seed: set::seed(),
        }
    }
}
