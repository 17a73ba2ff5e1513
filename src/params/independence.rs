//! Are impacts independent: sizes of the experiment.

use super::{Chain, Profile, Protocol, SEED};
use serde::{Deserialize, Serialize};

/// One ensemble of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct IndependenceRow {
    /// Number of masses n.
    pub masses: usize,
    /// Standard deviation σ of the amplitudes.
    pub sigma: f64,
}

/// Ensembles whose sequences of impacts are looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct IndependenceParams {
    /// The chain, but for its number of masses.
    pub chain: Chain,
    /// Transient, and the window in which impacts are taken down.
    pub protocol: Protocol,
    /// First the paper's chain at rising σ, then shorter chains.
    pub rows: Vec<IndependenceRow>,
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
    /// The σ of shorter chains.
    pub const SIGMA: f64 = 0.3;

    /// The largest length of a circuit that is called short.
    pub const SHORT: usize = 10;

    /// The distance from which on the next impact is called far.
    pub const FAR: usize = 10;

    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        let (sigmas, shorter, realisations, window): (&[f64], &[usize], _, _) = match profile {
            Profile::Full | Profile::Deep => (&[0.12, 0.15, 0.2, 0.3], &[10, 3], 24, 4000.0),
            Profile::Ci => (&[0.12, 0.2, 0.3], &[3], 8, 1000.0),
            Profile::Quick => (&[0.12, 0.3], &[3], 4, 600.0),
        };
        let chain = Chain::default();
        let masses = chain.masses;
        let long = sigmas.iter().map(|&sigma| IndependenceRow { masses, sigma });
        let short = shorter.iter().map(|&masses| IndependenceRow { masses, sigma: Self::SIGMA });
        IndependenceParams {
            protocol: Protocol { transient: 500.0, window },
            rows: long.chain(short).collect(),
            chain,
            realisations,
            quarters: 12,
            stream: "independence".into(),
            seed: SEED,
        }
    }
}
