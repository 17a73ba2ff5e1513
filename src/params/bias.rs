//! What methods do to the mean count: sizes of the experiment.

use super::accuracy::settings;
use super::{Chain, MethodName, Profile, Protocol, SEED, Setting};
use serde::{Deserialize, Serialize};

/// The mean number of distinct gaps by every method, on the same chains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BiasParams {
    /// The chain without its forcing.
    pub chain: Chain,
    /// Standard deviations σ, each with transient and window.
    pub scenes: Vec<(f64, Protocol)>,
    /// The methods, each with its number of realisations.
    pub settings: Vec<(Setting, usize)>,
    /// Name of the random stream: that of the main sweep.
    pub stream: String,
    /// Master seed, likewise.
    pub seed: u64,
}

impl BiasParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        use MethodName::{MoreauJean, Penalty, RungeKutta, Sampled, Verlet};
        let coarse = |n| {
            settings(&[(MoreauJean, &[0.1]), (Verlet, &[0.1]), (Penalty, &[0.1])])
                .into_iter()
                .map(|setting| (setting, n))
                .collect::<Vec<_>>()
        };
        let short = Protocol { transient: 100.0, window: 100.0 };
        let (scenes, settings) = match profile {
            Profile::Quick => (vec![(0.12, short), (0.3, short)], coarse(2)),
            Profile::Full => {
                let mut list = coarse(64);
                for (method, value, n) in [
                    (Verlet, 0.01, 10),
                    (MoreauJean, 0.01, 10),
                    (Penalty, 0.01, 10),
                    (Sampled, 0.3, 24),
                    (RungeKutta, 1e-3, 6),
                    (RungeKutta, 1e-6, 6),
                ] {
                    list.push((Setting { method, value }, n));
                }
                (vec![(0.12, Protocol::default()), (0.15, short), (0.3, short)], list)
            }
        };
        BiasParams { chain: Chain::default(), scenes, settings, stream: "sweep".into(), seed: SEED }
    }
}
