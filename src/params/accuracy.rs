//! Sizes of the experiments on the speed and accuracy of methods.

use super::chosen::{SEED, printed_threshold};
use super::methods::{MethodName, Setting};
use super::runs::Runs;
use impact_chain::{Chain, Protocol};
use literate::experiments::Profile;
use serde::{Deserialize, Serialize};

const STEPS: &[f64] = &[1e-1, 1e-2, 1e-3, 1e-4];

/// Settings of each method of [`MethodName::ALL`] in the race, coarse to fine.
const RACE: [&[f64]; 7] = [
    &[0.0],
    &[0.5, 0.2, 0.1, 0.03, 0.01],
    &[1e-3, 1e-6, 1e-9, 1e-12],
    &[1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13],
    STEPS,
    STEPS,
    STEPS,
];

/// The same in the quick profile.
const QUICK: [&[f64]; 7] = [&[0.0], &[0.1], &[1e-9], &[1e-3], &[0.1], &[0.1], &[0.1]];

/// A coarse and a fine tolerance, and step, in the scenes where methods fail.
const TOLERANCES: &[f64] = &[1e-6, 1e-12];
const FEW_STEPS: &[f64] = &[1e-2, 1e-4];

/// The settings there.
const SCENES: [&[f64]; 7] =
    [&[0.0], &[0.1, 0.01], TOLERANCES, TOLERANCES, FEW_STEPS, FEW_STEPS, FEW_STEPS];

/// The same against the number of masses, without the last method.
const SCALE: [&[f64]; 6] = [&[0.0], &[0.1], &[1e-12], &[1e-6], &[0.01], &[0.01]];

/// The same for the error of the mean, with numbers of chains: the cheaper, the more.
const BIAS: [&[(f64, usize)]; 7] = [
    &[(0.0, 1000)],
    &[(0.5, 80), (0.1, 30)],
    &[(1e-2, 60), (1e-12, 150)],
    &[(1e-3, 12), (1e-6, 20)],
    &[(0.1, 300), (0.01, 40)],
    &[(0.1, 1000), (0.01, 100)],
    &[(0.1, 100), (0.01, 40)],
];

fn all<T: Copy>(values: &[&[T]]) -> Vec<(MethodName, T)> {
    let all = MethodName::ALL.into_iter().zip(values);
    all.flat_map(|(method, values)| values.iter().map(move |value| (method, *value))).collect()
}

fn settings(values: &[&[f64]]) -> Vec<Setting> {
    all(values).into_iter().map(|(method, value)| Setting { method, value }).collect()
}

/// Random stream and seed of the chains on which other programs are measured.
pub const BENCH: (&str, u64) = ("bench", 1);

/// Every method against the true motion: the next impact from exact states, and whole runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RaceParams {
    /// The twins whose growth gives the horizon that chaos allows; all methods run the same chains.
    pub growth: Runs,
    /// Length of the runs; a run ends where it has left the truth.
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
            if quick { (30.0, 10.0, 2, 12, 6) } else { (250.0, 20.0, 12, 1200, 60) };
        let chain = Chain { masses: 20, ..Chain::default() };
        let (stream, seed) = (BENCH.0.into(), BENCH.1);
        let growth = Runs { chain, sigma: 0.3, until: 300.0, realisations, stream, seed };
        let settings = settings(if quick { &QUICK } else { &RACE });
        RaceParams { growth, until, at_least, chains, segments, settings }
    }
}

pub fn trial_settings() -> Vec<Setting> {
    settings(&SCENES)
}

/// Counted work of an impact against the number of masses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScaleParams {
    pub sigma: f64,
    /// Numbers of masses n, rising.
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
    /// Chains of the main sweep, for each σ on the rise.
    pub chains: Vec<Runs>,
    /// Time T that is dropped; the window goes from there to the end of the runs.
    pub transient: f64,
    /// The methods, the engine first, each with its number of realisations.
    pub settings: Vec<(Setting, usize)>,
}

impl BiasParams {
    pub fn new(profile: Profile) -> Self {
        let mut sigmas = vec![0.11, printed_threshold(), 0.14];
        let mut protocol = Protocol::default();
        let all = all(&BIAS).into_iter();
        let mut settings: Vec<(Setting, usize)> =
            all.map(|(method, (value, n))| (Setting { method, value }, n)).collect();
        if profile == Profile::Quick {
            sigmas.remove(0);
            protocol = Protocol { transient: 100.0, window: 100.0 };
            settings.iter_mut().for_each(|(_, realisations)| *realisations = 2);
        }
        let realisations = settings.iter().map(|pair| pair.1).max().unwrap_or(0);
        let (until, transient) = (protocol.end(), protocol.transient);
        let chains = |sigma| {
            let (chain, stream) = (Chain::default(), "sweep".into());
            Runs { chain, sigma, until, realisations, stream, seed: SEED }
        };
        BiasParams { chains: sigmas.into_iter().map(chains).collect(), transient, settings }
    }

    pub fn runs(&self) -> u64 {
        let realisations: usize = self.settings.iter().map(|(_, realisations)| realisations).sum();
        (self.chains.len() * realisations) as u64
    }
}
