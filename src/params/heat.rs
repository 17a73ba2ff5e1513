//! How hot a running chain is: sizes of the experiment.

use super::{Chain, Profile, Protocol, set};
use serde::{Deserialize, Serialize};

/// One ensemble of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeatRow {
    /// Standard deviation σ of the amplitudes.
    pub sigma: f64,
    /// Restitution r.
    pub restitution: f64,
}

/// Ensembles whose free parts are looked at when the window ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeatParams {
    /// The chain, but for its restitution.
    pub chain: Chain,
    /// Transient, and the window in which impacts are weighed.
    pub protocol: Protocol,
    /// First the paper's restitution at rising σ, then other restitutions at one σ.
    pub rows: Vec<HeatRow>,
    /// Ensembles on a ring, which has no walls.
    pub ring: Vec<HeatRow>,
    /// Realisations of each.
    pub realisations: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl HeatParams {
    /// The σ at which restitutions are compared.
    pub const SIGMA: f64 = 0.15;

    /// The restitution of which the text speaks, beside the paper's; every profile has it.
    pub const RESTITUTION: f64 = 0.9;

    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        let (sigmas, restitutions, realisations, transient): (&[f64], &[f64], _, _) = match profile
        {
            Profile::Full | Profile::Deep => (
                &[0.1, 0.11, 0.12, 0.13, 0.14, 0.15, 0.16, 0.18, 0.2, 0.25, 0.3, 0.4],
                &[0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95],
                24,
                2000.0,
            ),
            Profile::Ci => (&[0.1, 0.12, 0.15, 0.2, 0.3], &[0.6, 0.8, 0.9], 8, 1000.0),
            Profile::Quick => (&[0.1, 0.12, 0.2, 0.3], &[0.8, 0.9], 3, 500.0),
        };
        let chain = set::chain();
        let paper = chain.restitution;
        let sigmas = sigmas.iter().map(|&sigma| HeatRow { sigma, restitution: paper });
        let ring = sigmas.clone().collect();
        let others = restitutions.iter().map(|&r| HeatRow { sigma: Self::SIGMA, restitution: r });
        HeatParams {
            protocol: Protocol { transient, window: transient / 4.0 },
            rows: sigmas.chain(others).collect(),
            ring,
            chain,
            realisations,
            stream: "heat".into(),
            seed: set::seed(),
        }
    }
}
