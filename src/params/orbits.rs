//! Periodic orbits from circuits: sizes of the experiment.

use super::{Chain, Profile, SEED};
use serde::{Deserialize, Serialize};

/// The search for one circuit over many forcings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HuntParams {
    /// Standard deviations σ of the amplitudes.
    pub sigmas: Vec<f64>,
    /// Forcings of each.
    pub forcings: usize,
    /// Random starts for each forcing and period.
    pub starts: usize,
    /// Length of the runs whose close returns are starts too.
    pub until: f64,
}

/// Periodic orbits of a short chain, and where its runs end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrbitsParams {
    /// The chain.
    pub chain: Chain,
    /// Standard deviations σ of the amplitudes.
    pub sigmas: Vec<f64>,
    /// Forcings of each; the same ones, scaled.
    pub forcings: usize,
    /// Orbits are sought with a period of 1 to so many periods of the forcing.
    pub periods: usize,
    /// Random starts of Newton's method for each circuit, forcing and period.
    pub starts: usize,
    /// Length of the runs, in periods of the forcing.
    pub until: usize,
    /// Runs are recognised as periodic up to so many periods of the forcing.
    pub recognised: usize,
    /// Periods of an orbit after which a motion that began beside it is looked at.
    pub returns: usize,
    /// The circuits of Figs. 5 and 6.
    pub hunt: HuntParams,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl OrbitsParams {
    /// Masses of Figs. 4 to 6.
    pub const MASSES: usize = 3;

    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        let (sigmas, forcings, starts, until, hunt): (&[f64], _, _, _, _) = match profile {
            Profile::Full | Profile::Deep => {
                (&[0.1, 0.15, 0.2, 0.3, 0.4, 0.6], 40, 16, 2400, (200, 16, 1000.0))
            }
            Profile::Ci => (&[0.1, 0.2, 0.3, 0.6], 15, 8, 1200, (60, 8, 400.0)),
            Profile::Quick => (&[0.1, 0.3], 5, 6, 600, (20, 6, 100.0)),
        };
        let (hunted, hunt_starts, hunt_until) = hunt;
        OrbitsParams {
            chain: Chain { masses: Self::MASSES, ..Chain::default() },
            sigmas: sigmas.to_vec(),
            forcings,
            periods: 4,
            starts,
            until,
            recognised: 24,
            returns: 200,
            hunt: HuntParams {
                sigmas: vec![0.4, 0.7, 1.0],
                forcings: hunted,
                starts: hunt_starts,
                until: hunt_until,
            },
            stream: "orbits".into(),
            seed: SEED,
        }
    }
}
