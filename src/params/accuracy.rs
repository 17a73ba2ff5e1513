//! Chooses the sizes of the experiments on the speed and accuracy of methods.

use super::chosen::SEED;
use super::ensemble::Ensemble;
use super::methods::{MethodName, Setting};
use super::runs::Runs;
use impact_chain::{Chain, Protocol};
use literate::experiments::Profile;
use serde::{Deserialize, Serialize};

/// The settings of a method in each experiment, coarse to fine; empty where it has no part.
struct MethodSettings {
    method: MethodName,
    /// In the race against the true motion, and the one of the quick profile.
    race: &'static [f64],
    quick_race: f64,
    /// In the scenes where methods fail.
    scenes: &'static [f64],
    /// Against the number of masses.
    scale: &'static [f64],
    /// For the mean, each with its number of chains at each of [`MEANS`]. The engine and the
    /// cheapest rivals have so many that the 95 % interval is about half of what is asked; less is
    /// enough for one that is far off, and for one that takes longer than another that suffices.
    means: &'static [(f64, [usize; 4])],
}

/// Settings that several methods have.
const STEPS: &[f64] = &[1e-1, 1e-2, 1e-3, 1e-4];
const FEW_STEPS: &[f64] = &[1e-2, 1e-4];
const TOLERANCES: &[f64] = &[1e-6, 1e-12];

/// σ of the chains whose mean is compared, and the time T that is dropped: up the rise, and late.
const MEANS: [(f64, f64); 4] = [(0.11, 500.0), (0.12, 500.0), (0.14, 500.0), (0.115, 2000.0)];

/// Chains at each of [`MEANS`] of the engine and of the cheapest rival.
const MANY: [usize; 4] = [3000, 1000, 1600, 1500];

/// The methods in the order of the tables.
const METHODS: [MethodSettings; 8] = [
    MethodSettings {
        method: MethodName::Certified,
        race: &[0.0],
        quick_race: 0.0,
        scenes: &[0.0],
        scale: &[0.0],
        means: &[(0.0, MANY)],
    },
    MethodSettings {
        method: MethodName::Sampled,
        race: &[0.5, 0.25, 0.1, 0.03, 0.01],
        quick_race: 0.1,
        scenes: &[0.1, 0.01],
        scale: &[0.25],
        means: &[(0.25, [100, 60, 40, 20])],
    },
    MethodSettings {
        method: MethodName::Advancement,
        race: &[1e-3, 1e-6, 1e-9, 1e-12, 1e-14],
        quick_race: 1e-9,
        scenes: TOLERANCES,
        scale: &[1e-12],
        means: &[(1e-2, [40, 40, 20, 20]), (1e-12, [100, 40, 30, 20])],
    },
    MethodSettings {
        method: MethodName::RungeKutta,
        race: &[1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13],
        quick_race: 1e-3,
        scenes: TOLERANCES,
        scale: &[1e-6],
        means: &[(1e-3, [8, 0, 0, 0]), (1e-6, [4, 4, 4, 0])],
    },
    MethodSettings {
        method: MethodName::MoreauJean,
        race: STEPS,
        quick_race: 0.1,
        scenes: FEW_STEPS,
        scale: &[0.01],
        means: &[(0.1, [100, 60, 60, 20]), (0.01, [10, 10, 10, 0])],
    },
    MethodSettings {
        method: MethodName::Verlet,
        race: STEPS,
        quick_race: 0.1,
        scenes: FEW_STEPS,
        scale: &[0.01],
        means: &[(0.3, [400, 400, 200, 100]), (0.1, [400, 100, 400, 40]), (0.01, [10, 10, 10, 0])],
    },
    MethodSettings {
        method: MethodName::Penalty,
        race: STEPS,
        quick_race: 0.1,
        scenes: FEW_STEPS,
        scale: &[],
        means: &[(0.1, [40, 40, 20, 20]), (0.01, [10, 10, 10, 0])],
    },
    MethodSettings {
        method: MethodName::VerletAbreast,
        race: &[0.1, 0.03, 0.01],
        quick_race: 0.03,
        scenes: &[],
        scale: &[],
        means: &[(0.5, MANY), (0.4, MANY), (0.3, MANY), (0.2, MANY), (0.1, MANY)],
    },
];

/// Lists some settings of all methods.
fn settings(values: impl Fn(&'static MethodSettings) -> &'static [f64]) -> Vec<Setting> {
    let own = |one: &'static MethodSettings| {
        let MethodSettings { method, .. } = *one;
        values(one).iter().map(move |&value| Setting { method, value, stop: 0.0 })
    };
    METHODS.iter().flat_map(own).collect()
}

/// Random stream and seed of the chains on which other programs are measured.
pub const BENCH_STREAM: &str = "bench";
pub const BENCH_SEED: u64 = 1;

/// Every method against the true motion: the next impact from exact states, and whole runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RaceParams {
    /// The twins whose growth gives the horizon that chaos allows; all methods run the same chains.
    pub growth: Runs,
    pub until: f64,
    /// Until then a run goes on although it has left the truth, so that its cost is known.
    pub at_least: f64,
    pub chains: usize,
    /// Impacts from whose states each method starts anew, spread evenly over all chains.
    pub segments: usize,
    pub settings: Vec<Setting>,
}

impl RaceParams {
    pub fn new(profile: Profile) -> Self {
        let quick = profile == Profile::Quick;
        let (until, at_least, chains, segments, realisations) =
            if quick { (30.0, 10.0, 2, 12, 6) } else { (250.0, 20.0, 16, 1200, 60) };
        let chain = Chain { masses: 20, ..Chain::default() };
        let (stream, seed) = (BENCH_STREAM.into(), BENCH_SEED);
        let growth = Runs { chain, sigma: 0.3, until: 300.0, realisations, stream, seed };
        let race = |one: &'static MethodSettings| {
            if quick { std::slice::from_ref(&one.quick_race) } else { one.race }
        };
        let settings = settings(race);
        RaceParams { growth, until, at_least, chains, segments, settings }
    }
}

/// Least rebound speeds in the scenes, each with the fine setting of a method that locates impacts.
const STOPS: [f64; 2] = [1e-3, 1e-4];

/// Returns the settings in the scenes: each method from coarse to fine, in the quick profile only
/// coarse, and then with the least rebound speeds.
pub fn trial_settings(profile: Profile) -> Vec<Setting> {
    let most = if profile == Profile::Quick { 1 } else { usize::MAX };
    let mut settings = settings(|one| &one.scenes[..one.scenes.len().min(most)]);
    for method in MethodName::ALL.into_iter().filter(|method| method.locates_impacts()) {
        if let Some(fine) = settings.iter().rposition(|setting| setting.method == method) {
            let stopping = STOPS.map(|stop| Setting { stop, ..settings[fine] });
            settings.splice(fine + 1..fine + 1, stopping);
        }
    }
    settings
}

/// Counted work of an impact against the number of masses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScaleParams {
    pub sigma: f64,
    pub masses: Vec<usize>,
    /// Largest n of all methods but the engine.
    pub largest_for_rivals: usize,
    pub settings: Vec<Setting>,
}

impl ScaleParams {
    pub fn new(profile: Profile) -> Self {
        let (masses, largest_for_rivals) = match profile {
            Profile::Full => (vec![10, 30, 100, 300, 1000, 10_000], 300),
            Profile::Quick => (vec![10, 30, 100, 1000], 30),
        };
        let settings = settings(|one| one.scale);
        ScaleParams { sigma: 0.3, masses, largest_for_rivals, settings }
    }
}

/// The mean number of distinct gaps by every method, on the same chains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BiasParams {
    pub means: Vec<Means>,
}

/// Chains of one σ, and the methods that run them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Means {
    /// Chains of the main sweep, to the end of the window.
    pub chains: Runs,
    /// Time T that is dropped; the window goes from there to the end of the runs.
    pub transient: f64,
    /// The methods that run any of them, the engine first, each with its number of chains.
    pub settings: Vec<(Setting, usize)>,
}

/// Two motions of a chain whose forces differ by this factor part by chaos long before they end.
const NUDGE: f64 = 1.0 + 4.0 * f64::EPSILON;

impl Means {
    /// Returns the window in which gaps are counted.
    pub fn window(&self) -> Protocol {
        let Means { transient, .. } = *self;
        Protocol { transient, window: self.chains.until - transient }
    }

    /// Returns the chains as the engine simulates many, side by side; with a nudge, the same with
    /// other roundings.
    pub fn ensemble(&self, nudged: bool) -> Ensemble {
        let Runs { chain, sigma, realisations, stream, seed, .. } = self.chains.clone();
        Ensemble {
            chain,
            sigmas: vec![if nudged { NUDGE * sigma } else { sigma }],
            protocols: vec![self.window()],
            realisations,
            stream,
            seed,
            ..Ensemble::default()
        }
    }
}

impl BiasParams {
    pub fn new(profile: Profile) -> Self {
        let quick = profile == Profile::Quick;
        let means = MEANS.iter().enumerate().skip(usize::from(quick)).map(|(i, &place)| {
            let (sigma, transient) = if quick { (place.0, 100.0) } else { place };
            let window = if quick { 100.0 } else { Protocol::default().window };
            let mut settings = Vec::new();
            for MethodSettings { method, means, .. } in &METHODS {
                for &(value, chains) in means.iter().filter(|(_, chains)| chains[i] > 0) {
                    let chains = if quick { chains[i].min(2) } else { chains[i] };
                    settings.push((Setting { method: *method, value, stop: 0.0 }, chains));
                }
            }
            let (chain, until, stream) = (Chain::default(), transient + window, "sweep".into());
            let realisations = settings[0].1;
            let chains = Runs { chain, sigma, until, realisations, stream, seed: SEED };
            Means { chains, transient, settings }
        });
        BiasParams { means: means.collect() }
    }

    /// Counts the runs of all methods.
    pub fn runs(&self) -> u64 {
        let settings = self.means.iter().flat_map(|means| &means.settings);
        settings.map(|(_, chains)| *chains as u64).sum::<u64>() + self.engine_again()
    }

    /// Counts the chains that the engine runs again, to know what chaos makes of a rounding.
    fn engine_again(&self) -> u64 {
        self.means.iter().map(|means| means.chains.realisations as u64).sum()
    }
}
