//! Sample sizes and grids of each profile, in one place.

use super::{Boundary, Chain, Profile, Protocol, SECOND_SEED, SEED, Start};
use serde::{Deserialize, Serialize};

/// A σ axis made of stretches of equal steps; values are exact quotients, so 0.12 is the double
/// nearest to 0.12.
#[derive(Clone, Debug, Default)]
pub struct Grid(Vec<f64>);

impl Grid {
    /// Appends i / `denominator` for i = `from`, `from` + `step`, … up to `to`, included.
    pub fn and(mut self, from: u32, to: u32, step: usize, denominator: u32) -> Self {
        self.0.extend((from..=to).step_by(step).map(|i| f64::from(i) / f64::from(denominator)));
        self
    }

    /// The values, rising.
    pub fn values(self) -> Vec<f64> {
        debug_assert!(self.0.windows(2).all(|w| w[0] < w[1]));
        self.0
    }
}

/// An ensemble over σ: what `impact-paper sweep` and the experiments built on it run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepParams {
    /// The chain without its forcing.
    pub chain: Chain,
    /// Transient and window.
    pub protocol: Protocol,
    /// Standard deviations σ of the amplitudes, rising.
    pub sigmas: Vec<f64>,
    /// Realisations at each σ; realisation i has the same standard normals at every σ.
    pub realisations: usize,
    /// Where fewer of them do.
    pub level: Option<Level>,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

/// Beyond the rise all chains count nearly the same number of gaps, and each costs most: of fewer the
/// mean is known as well.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// Above this σ ...
    pub above: f64,
    /// ... so many realisations are run.
    pub realisations: usize,
}

impl SweepParams {
    /// Realisations at a σ.
    pub fn realisations_at(&self, sigma: f64) -> usize {
        match self.level {
            Some(level) if sigma > level.above => level.realisations,
            _ => self.realisations,
        }
    }

    /// The main sweep of Sec. 2 (Figs. 2, 3, 12 and 15).
    pub fn main(profile: Profile) -> Self {
        let (sigmas, realisations, level) = match profile {
            Profile::Full => (
                // 69 values, 0.0025 apart where the rise is.
                Grid::default()
                    .and(4, 15, 1, 200)
                    .and(32, 72, 1, 400)
                    .and(19, 28, 1, 100)
                    .and(15, 20, 1, 50)
                    .values(),
                1000,
                100,
            ),
            Profile::Quick => (
                Grid::default()
                    .and(2, 8, 2, 100)
                    .and(9, 16, 1, 100)
                    .and(9, 9, 1, 50)
                    .and(4, 8, 1, 20)
                    .values(),
                12,
                6,
            ),
        };
        SweepParams {
            chain: Chain::default(),
            protocol: Protocol::default(),
            sigmas,
            realisations,
            level: Some(Level { above: 0.16, realisations: level }),
            stream: "sweep".into(),
            seed: SEED,
        }
    }

    /// The headline numbers again, with another seed and fewer realisations on the rise only.
    pub fn second_seed(profile: Profile) -> Self {
        let (sigmas, realisations) = match profile {
            Profile::Full => (Grid::default().and(34, 64, 1, 400).values(), 400),
            Profile::Quick => (Grid::default().and(8, 16, 1, 100).values(), 8),
        };
        SweepParams { sigmas, realisations, seed: SECOND_SEED, ..Self::main(profile) }
    }
}

/// One chain that differs from the paper's in one respect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StartVariant {
    /// Short name: `rest`, `zero`, `random`, `ring`, `restitution-0.6`, …
    pub name: String,
    /// The chain.
    pub chain: Chain,
    /// Standard deviations σ, rising.
    pub sigmas: Vec<f64>,
}

/// The variants of start, boundary, restitution and forcing frequency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StartsParams {
    /// The variants; the first is the paper's chain.
    pub variants: Vec<StartVariant>,
    /// Transient and window.
    pub protocol: Protocol,
    /// Realisations at each σ.
    pub realisations: usize,
    /// Name of the random stream, common to the variants.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl StartsParams {
    /// The variants of each profile.
    pub fn new(profile: Profile) -> Self {
        let (step, realisations) = match profile {
            Profile::Full => (1, 100),
            Profile::Quick => (2, 4),
        };
        let near = Grid::default().and(8, 18, step, 100).values();
        let wide = Grid::default().and(8, 26, step, 100).values();
        // A smaller r or a larger Ω move the rise up, a larger r or a smaller Ω move it down.
        let low = Grid::default().and(4, 14, step, 100).values();
        let variant = |name: &str, sigmas: &Vec<f64>, change: fn(&mut Chain)| {
            let mut chain = Chain::default();
            change(&mut chain);
            StartVariant { name: name.into(), chain, sigmas: sigmas.clone() }
        };
        let mut variants = vec![
            variant("rest", &near, |_| ()),
            variant("zero", &wide, |c| c.start = Start::Zero),
            variant("random", &near, |c| c.start = Start::Random),
            variant("ring", &near, |c| c.boundary = Boundary::Ring),
        ];
        if profile >= Profile::Full {
            variants.extend([
                variant("restitution-0.6", &wide, |c| c.restitution = 0.6),
                variant("restitution-0.9", &low, |c| c.restitution = 0.9),
                variant("forcing-frequency-1.3", &low, |c| c.forcing_frequency = 1.3),
                variant("forcing-frequency-1.6", &wide, |c| c.forcing_frequency = 1.6),
            ]);
        }
        StartsParams {
            variants,
            protocol: Protocol::default(),
            realisations,
            stream: "starts".into(),
            seed: SEED,
        }
    }
}

/// Twin runs that differ in the last bit of every amplitude.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HorizonParams {
    /// The chain without its forcing.
    pub chain: Chain,
    /// Standard deviation σ.
    pub sigma: f64,
    /// Time at which the twins are given up.
    pub until: f64,
    /// Number of twins.
    pub realisations: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl HorizonParams {
    /// The twins of each profile.
    pub fn new(profile: Profile) -> Self {
        HorizonParams {
            chain: Chain::default(),
            sigma: 0.2,
            until: 500.0,
            realisations: match profile {
                Profile::Full => 100,
                Profile::Quick => 10,
            },
            stream: "horizon".into(),
            seed: SEED,
        }
    }
}

/// Two masses under a low force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoMassesParams {
    /// The chain, with n = 2.
    pub chain: Chain,
    /// Times within which an impact must come, rising.
    pub times: Vec<f64>,
    /// Number of random directions of the forcing.
    pub directions: usize,
    /// Halvings of the bracket around the smallest amplitude.
    pub halvings: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl TwoMassesParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        TwoMassesParams {
            chain: Chain { masses: 2, ..Chain::default() },
            times: match profile {
                Profile::Full => vec![1e2, 1e3, 1e4],
                _ => vec![1e2, 1e3],
            },
            directions: match profile {
                Profile::Full => 40,
                Profile::Quick => 10,
            },
            halvings: 28,
            stream: "two-masses".into(),
            seed: SEED,
        }
    }
}
