//! One long run, to look at.

use super::{Chain, PRINTED_THRESHOLD, Profile, SEED};
use serde::{Deserialize, Serialize};

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
        let until = match profile {
            Profile::Full => 4000.0,
            Profile::Quick => 400.0,
        };
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
