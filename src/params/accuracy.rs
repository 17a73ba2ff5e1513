//! Sizes of what the report says about speed and accuracy.

use super::{Chain, HorizonParams, Profile};
use serde::{Deserialize, Serialize};

/// A way to simulate, as `impact-paper trace --method` names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MethodName {
    /// The certified engine of this project.
    Certified,
    /// Gaps looked at on a grid of times, and bisection.
    Sampled,
    /// A Runge–Kutta pair of orders 5 and 4 with events.
    RungeKutta,
    /// Time stepping on velocities.
    MoreauJean,
    /// Verlet's scheme with a flip of velocities.
    Verlet,
    /// Springs where masses overlap.
    Penalty,
}

impl MethodName {
    /// All of them, ours first.
    pub const ALL: [MethodName; 6] = [
        MethodName::Certified,
        MethodName::Sampled,
        MethodName::RungeKutta,
        MethodName::MoreauJean,
        MethodName::Verlet,
        MethodName::Penalty,
    ];

    /// The name on the command line and in measurements.
    pub fn id(self) -> &'static str {
        match self {
            MethodName::Certified => "certified",
            MethodName::Sampled => "sampled",
            MethodName::RungeKutta => "runge-kutta",
            MethodName::MoreauJean => "moreau-jean",
            MethodName::Verlet => "verlet",
            MethodName::Penalty => "penalty",
        }
    }
}

/// A method with its step or tolerance; the certified engine has none, and 0 stands for it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Setting {
    /// The method.
    pub method: MethodName,
    /// Step h in units of 1/ω, or tolerance.
    pub value: f64,
}

/// Shorthand for lists of settings.
pub(super) fn settings(list: &[(MethodName, &[f64])]) -> Vec<Setting> {
    let of = |&(method, values): &(MethodName, &[f64])| {
        values.iter().map(move |&value| Setting { method, value }).collect::<Vec<_>>()
    };
    list.iter().flat_map(of).collect()
}

/// Every method against the true motion of a few chains: the next impact from many exact states,
/// and whole runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RaceParams {
    /// The chain without its forcing.
    pub chain: Chain,
    /// Standard deviation σ.
    pub sigma: f64,
    /// Length of the runs; a run ends where it has left the truth.
    pub until: f64,
    /// Until then a run goes on although it has left the truth, so that its cost is known.
    pub at_least: f64,
    /// Number of chains.
    pub chains: usize,
    /// Impacts from whose states each method starts anew, spread evenly over all chains.
    pub segments: usize,
    /// The methods.
    pub settings: Vec<Setting>,
    /// The twins whose growth gives the line that chaos allows.
    pub growth: HorizonParams,
    /// Name of the random stream: that of `benches/peers/measure.rs`, so that its first chain is the one
    /// on which other programs are measured.
    pub stream: String,
    /// Master seed, likewise.
    pub seed: u64,
}

impl RaceParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        use MethodName::{Certified, MoreauJean, Penalty, RungeKutta, Sampled, Verlet};
        let quick = settings(&[
            (Certified, &[0.0]),
            (Sampled, &[0.1]),
            (RungeKutta, &[1e-3]),
            (MoreauJean, &[1e-1]),
            (Verlet, &[1e-1]),
            (Penalty, &[1e-1]),
        ]);
        let whole = settings(&[
            (Certified, &[0.0]),
            (Sampled, &[0.5, 0.2, 0.1, 0.03, 0.01]),
            (RungeKutta, &[1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13]),
            (MoreauJean, &[1e-1, 1e-2, 1e-3, 1e-4]),
            (Verlet, &[1e-1, 1e-2, 1e-3, 1e-4]),
            (Penalty, &[1e-1, 1e-2, 1e-3, 1e-4]),
        ]);
        let (until, at_least, chains, segments, settings) = match profile {
            Profile::Full => (250.0, 20.0, 12, 1200, whole),
            Profile::Quick => (30.0, 10.0, 2, 12, quick),
        };
        let chain = Chain { masses: 20, ..Chain::default() };
        let (stream, seed) = ("bench".to_string(), 1);
        let growth = HorizonParams {
            chain: chain.clone(),
            sigma: 0.3,
            until: 300.0,
            realisations: match profile {
                Profile::Full => 60,
                Profile::Quick => 6,
            },
            stream: stream.clone(),
            seed,
        };
        RaceParams {
            chain,
            sigma: 0.3,
            until,
            at_least,
            chains,
            segments,
            settings,
            growth,
            stream,
            seed,
        }
    }
}

/// Every method on every scene in which methods fail.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrialParams {
    /// One setting of each method.
    pub settings: Vec<Setting>,
    /// Whether the scenes that take long (waits, many impacts) are cut short.
    pub short: bool,
    /// Numbers of masses that are pressed together; without any that scene is left out.
    pub clusters: Vec<u32>,
}

impl TrialParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        use MethodName::{Certified, MoreauJean, Penalty, RungeKutta, Sampled, Verlet};
        TrialParams {
            settings: settings(&[
                (Certified, &[0.0]),
                (Sampled, &[0.03]),
                (RungeKutta, &[1e-9]),
                (MoreauJean, &[1e-3]),
                (Verlet, &[1e-3]),
                (Penalty, &[1e-3]),
            ]),
            short: profile < Profile::Full,
            clusters: match profile {
                Profile::Full => vec![3, 5],
                Profile::Quick => Vec::new(),
            },
        }
    }
}

/// Counted work of an impact against the number of masses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScaleParams {
    /// The chain without its forcing and its number of masses.
    pub chain: Chain,
    /// Standard deviation σ.
    pub sigma: f64,
    /// Numbers of masses n, rising.
    pub masses: Vec<usize>,
    /// The methods, each with its largest n.
    pub settings: Vec<(Setting, usize)>,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl ScaleParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        use MethodName::{Certified, MoreauJean, RungeKutta, Sampled, Verlet};
        let (masses, largest, rivals) = match profile {
            Profile::Full => (vec![10, 30, 100, 300, 1000, 10_000], 10_000, 300),
            Profile::Quick => (vec![10, 30, 100, 1000], 1000, 30),
        };
        let list = settings(&[
            (Certified, &[0.0]),
            (Sampled, &[0.1]),
            (RungeKutta, &[1e-6]),
            (MoreauJean, &[0.01]),
            (Verlet, &[0.01]),
        ]);
        let limit = |s: Setting| (s, if s.method == Certified { largest } else { rivals });
        ScaleParams {
            chain: Chain::default(),
            sigma: 0.3,
            masses,
            settings: list.into_iter().map(limit).collect(),
            stream: "bench".into(),
            seed: 1,
        }
    }

    /// Simulated time at n masses: that of `benches/peers/measure.rs`, and short for rivals.
    pub fn until(&self, masses: usize, method: MethodName) -> f64 {
        match method {
            MethodName::Certified => (200_000.0 / masses as f64).clamp(10.0, 200.0),
            _ => 20.0,
        }
    }
}
