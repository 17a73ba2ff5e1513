//! Chooses the sizes of the experiments on the speed and accuracy of methods.

use super::chosen::SEED;
use super::ensemble::Ensemble;
use super::methods::MethodName::{self, *};
use super::methods::Setting;
use super::runs::Runs;
use impact_chain::{Chain, Protocol};
use literate::experiments::Profile;
use serde::{Deserialize, Serialize};

/// The settings of a method in each experiment, coarse to fine, none where it has no part: in the
/// race against the true motion, the one of the quick profile there, in the scenes where methods
/// fail, and against the number of masses.
type MethodSettings = (MethodName, &'static [f64], f64, &'static [f64], &'static [f64]);

/// Settings that several methods have.
const STEPS: &[f64] = &[1e-1, 1e-2, 1e-3, 1e-4];
const FEW_STEPS: &[f64] = &[1e-2, 1e-4];
const TOLERANCES: &[f64] = &[1e-6, 1e-12];

/// The methods in the order of the tables.
const METHODS: [MethodSettings; 8] = [
    (Certified, &[0.0], 0.0, &[0.0], &[0.0]),
    (Sampled, &[0.5, 0.25, 0.1, 0.03, 0.01], 0.1, &[0.1, 0.01], &[0.25]),
    (Advancement, &[1e-3, 1e-6, 1e-9, 1e-12, 1e-14], 1e-9, TOLERANCES, &[1e-12]),
    (RungeKutta, &[1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13], 1e-3, TOLERANCES, &[1e-6]),
    (MoreauJean, STEPS, 0.1, FEW_STEPS, &[0.01]),
    (Verlet, STEPS, 0.1, FEW_STEPS, &[0.01]),
    (Penalty, STEPS, 0.1, FEW_STEPS, &[]),
    (VerletAbreast, &[0.1, 0.03, 0.01], 0.03, &[], &[]),
];

/// σ of the chains whose mean is compared, and the time T that is dropped: up the rise, and late.
const MEANS: [(f64, f64); 4] = [(0.11, 500.0), (0.12, 500.0), (0.14, 500.0), (0.115, 2000.0)];

/// Chains at each of [`MEANS`] of the engine and of the cheapest rival.
const MANY: [usize; 4] = [3000, 1000, 1600, 1500];

/// The settings for the mean, each with its number of chains at each of [`MEANS`]. The engine and
/// the cheapest rivals have so many that the 95 % interval is about half of what is asked; less is
/// enough for one that is far off, and for one that takes longer than another that suffices.
const CHAINS: [(MethodName, f64, [usize; 4]); 18] = [
    (Certified, 0.0, MANY),
    (Sampled, 0.25, [100, 60, 40, 20]),
    (Advancement, 1e-2, [40, 40, 20, 20]),
    (Advancement, 1e-12, [100, 40, 30, 20]),
    (RungeKutta, 1e-3, [8, 0, 0, 0]),
    (RungeKutta, 1e-6, [4, 4, 4, 0]),
    (MoreauJean, 0.1, [100, 60, 60, 20]),
    (MoreauJean, 0.01, [10, 10, 10, 0]),
    (Verlet, 0.3, [400, 400, 200, 100]),
    (Verlet, 0.1, [400, 100, 400, 40]),
    (Verlet, 0.01, [10, 10, 10, 0]),
    (Penalty, 0.1, [40, 40, 20, 20]),
    (Penalty, 0.01, [10, 10, 10, 0]),
    (VerletAbreast, 0.5, MANY),
    (VerletAbreast, 0.4, MANY),
    (VerletAbreast, 0.3, MANY),
    (VerletAbreast, 0.2, MANY),
    (VerletAbreast, 0.1, MANY),
];

/// Lists some settings of all methods.
fn settings(values: impl Fn(&'static MethodSettings) -> &'static [f64]) -> Vec<Setting> {
    let own = |one: &'static MethodSettings| {
        values(one).iter().map(|&value| Setting { method: one.0, value, stop: 0.0 })
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
        let settings =
            settings(|(_, race, one, ..)| if quick { std::slice::from_ref(one) } else { race });
        RaceParams { growth, until, at_least, chains, segments, settings }
    }
}

/// Least rebound speeds in the scenes, each with the fine setting of a method that locates impacts.
const STOPS: [f64; 2] = [1e-3, 1e-4];

/// Returns the settings in the scenes: each method from coarse to fine, in the quick profile only
/// coarse, and then with the least rebound speeds.
pub fn trial_settings(profile: Profile) -> Vec<Setting> {
    let most = if profile == Profile::Quick { 1 } else { usize::MAX };
    let mut settings = settings(|(.., scenes, _)| &scenes[..scenes.len().min(most)]);
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
        let settings = settings(|(.., scale)| scale);
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
            for (method, value, chains) in CHAINS.into_iter().filter(|row| row.2[i] > 0) {
                let chains = if quick { chains[i].min(2) } else { chains[i] };
                settings.push((Setting { method, value, stop: 0.0 }, chains));
            }
            let (chain, until, stream) = (Chain::default(), transient + window, "sweep".into());
            let realisations = settings[0].1;
            let chains = Runs { chain, sigma, until, realisations, stream, seed: SEED };
            Means { chains, transient, settings }
        });
        BiasParams { means: means.collect() }
    }

    pub fn runs(&self) -> u64 {
        let settings = self.means.iter().flat_map(|means| &means.settings);
        // The engine runs its chains again, to know what chaos makes of a rounding.
        let again = self.means.iter().map(|means| means.chains.realisations as u64);
        settings.map(|(_, chains)| *chains as u64).chain(again).sum()
    }
}
