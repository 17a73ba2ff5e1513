//! Chooses the sizes of the experiments on the speed and accuracy of methods.

use super::chosen::SEED;
use super::ensemble::Ensemble;
use super::methods::{MethodName, Setting};
use super::runs::Runs;
use impact_chain::{Chain, Protocol};
use literate::experiments::Profile;
use serde::{Deserialize, Serialize};

const STEPS: &[f64] = &[1e-1, 1e-2, 1e-3, 1e-4];

/// Settings of each method of [`MethodName::ALL`] in the race, coarse to fine.
const RACE: [&[f64]; 8] = [
    &[0.0],
    &[0.5, 0.25, 0.1, 0.03, 0.01],
    &[1e-3, 1e-6, 1e-9, 1e-12, 1e-14],
    &[1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13],
    STEPS,
    STEPS,
    STEPS,
    &[0.1, 0.03, 0.01],
];

/// The same in the quick profile.
const QUICK: [&[f64]; 8] = [&[0.0], &[0.1], &[1e-9], &[1e-3], &[0.1], &[0.1], &[0.1], &[0.03]];

/// A coarse and a fine tolerance, and step, in the scenes where methods fail.
const TOLERANCES: &[f64] = &[1e-6, 1e-12];
const FEW_STEPS: &[f64] = &[1e-2, 1e-4];

const SCENES: [&[f64]; 7] =
    [&[0.0], &[0.1, 0.01], TOLERANCES, TOLERANCES, FEW_STEPS, FEW_STEPS, FEW_STEPS];

/// The same against the number of masses, without the last methods.
const SCALE: [&[f64]; 6] = [&[0.0], &[0.25], &[1e-12], &[1e-6], &[0.01], &[0.01]];

/// σ of the chains whose mean is compared, and the time T that is dropped: up the rise, and late.
const MEANS: [(f64, f64); 4] = [(0.11, 500.0), (0.12, 500.0), (0.14, 500.0), (0.115, 2000.0)];

/// The settings there, each with its number of chains at each of [`MEANS`]. The engine and the
/// cheapest rivals have so many that the 95 % interval is about half of what is asked; less is
/// enough for one that is far off, and for one that takes longer than another that suffices.
const BIAS: [&[(f64, [usize; 4])]; 8] = [
    &[(0.0, [3000, 1000, 1600, 1500])],
    &[(0.25, [100, 60, 40, 20])],
    &[(1e-2, [40, 40, 20, 20]), (1e-12, [100, 40, 30, 20])],
    &[(1e-3, [8, 0, 0, 0]), (1e-6, [4, 4, 4, 0])],
    &[(0.1, [100, 60, 60, 20]), (0.01, [10, 10, 10, 0])],
    &[(0.3, [400, 400, 200, 100]), (0.1, [400, 100, 400, 40]), (0.01, [10, 10, 10, 0])],
    &[(0.1, [40, 40, 20, 20]), (0.01, [10, 10, 10, 0])],
    &[
        (0.5, [3000, 1000, 1600, 1500]),
        (0.4, [3000, 1000, 1600, 1500]),
        (0.3, [3000, 1000, 1600, 1500]),
        (0.2, [3000, 1000, 1600, 1500]),
        (0.1, [3000, 1000, 1600, 1500]),
    ],
];

fn all<T: Copy>(values: &[&[T]]) -> Vec<(MethodName, T)> {
    let all = MethodName::ALL.into_iter().zip(values);
    all.flat_map(|(method, values)| values.iter().map(move |value| (method, *value))).collect()
}

fn settings(values: &[&[f64]]) -> Vec<Setting> {
    all(values).into_iter().map(|(method, value)| Setting { method, value, stop: 0.0 }).collect()
}

/// Random stream and seed of the chains on which other programs are measured.
pub const BENCH: (&str, u64) = ("bench", 1);

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
        let (stream, seed) = (BENCH.0.into(), BENCH.1);
        let growth = Runs { chain, sigma: 0.3, until: 300.0, realisations, stream, seed };
        let settings = settings(if quick { &QUICK } else { &RACE });
        RaceParams { growth, until, at_least, chains, segments, settings }
    }
}

/// Least rebound speeds there, each with the fine setting of a method that locates impacts.
const STOPS: [f64; 2] = [1e-3, 1e-4];

/// Returns the settings there: methods from coarse to fine, only coarse in the quick profile, then
/// with the least rebound speeds.
pub fn trial_settings(profile: Profile) -> Vec<Setting> {
    let few =
        |values: &'static [f64]| if profile == Profile::Quick { &values[..1] } else { values };
    let mut all = settings(&SCENES.map(few));
    for method in MethodName::ALL.into_iter().filter(|method| method.locates_impacts()) {
        if let Some(fine) = all.iter().rposition(|setting| setting.method == method) {
            let stopping = STOPS.map(|stop| Setting { stop, ..all[fine] });
            all.splice(fine + 1..fine + 1, stopping);
        }
    }
    all
}

/// Counted work of an impact against the number of masses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScaleParams {
    pub sigma: f64,
    pub masses: Vec<usize>,
    /// Largest n of all methods but the engine.
    pub rivals: usize,
    pub settings: Vec<Setting>,
}

impl ScaleParams {
    pub fn new(profile: Profile) -> Self {
        let (masses, rivals) = match profile {
            Profile::Full => (vec![10, 30, 100, 300, 1000, 10_000], 300),
            Profile::Quick => (vec![10, 30, 100, 1000], 30),
        };
        ScaleParams { sigma: 0.3, masses, rivals, settings: settings(&SCALE) }
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
        let means = MEANS.iter().enumerate().skip(usize::from(quick)).map(|(i, &at)| {
            let (sigma, transient) = if quick { (at.0, 100.0) } else { at };
            let window = if quick { 100.0 } else { Protocol::default().window };
            let with = |(method, (value, chains)): (MethodName, (f64, [usize; 4]))| {
                let chains = if quick { chains[i].min(2) } else { chains[i] };
                (Setting { method, value, stop: 0.0 }, chains)
            };
            let settings = all(&BIAS).into_iter().map(with).filter(|(_, chains)| *chains > 0);
            let settings: Vec<(Setting, usize)> = settings.collect();
            let (chain, until, stream) = (Chain::default(), transient + window, "sweep".into());
            let realisations = settings[0].1;
            let chains = Runs { chain, sigma, until, realisations, stream, seed: SEED };
            Means { chains, transient, settings }
        });
        BiasParams { means: means.collect() }
    }

    pub fn runs(&self) -> u64 {
        let settings = self.means.iter().flat_map(|of| &of.settings);
        settings.map(|(_, chains)| *chains as u64).sum::<u64>() + self.engine_again()
    }

    /// Counts the chains that the engine runs again, to know what chaos makes of a rounding.
    fn engine_again(&self) -> u64 {
        self.means.iter().map(|of| of.chains.realisations as u64).sum()
    }
}
