//! Chains of other lengths, starts and ends: sizes of the experiment.

use super::{Boundary, Chain, Grid, Profile, SEED, Start};
use serde::{Deserialize, Serialize};

/// Chains that differ from the paper's in length, start or ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChainsParams {
    /// The chain, but for what a curve has of its own.
    pub chain: Chain,
    /// Window W.
    pub window: f64,
    /// Gaps of a long chain that are counted together, at least.
    pub piece: usize,
    /// The curves.
    pub curves: Vec<ChainCurve>,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

/// In what a curve differs from the paper's chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ChainKind {
    /// In its length.
    Length,
    /// In its start or its ends, followed over the transients.
    Drift,
}

/// One kind of chain at several σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChainCurve {
    /// In what it differs.
    pub kind: ChainKind,
    /// `length-1000`, `drift-ring`, …
    pub name: String,
    /// Number of masses n.
    pub masses: usize,
    /// The start.
    pub start: Start,
    /// Walls or ring.
    pub boundary: Boundary,
    /// Standard deviations σ, rising.
    pub sigmas: Vec<f64>,
    /// Transients T, rising, no window reaching the next.
    pub transients: Vec<f64>,
    /// Realisations at each σ.
    pub realisations: usize,
}

impl ChainsParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        let chain = Chain::default();
        let grid = |from, to| {
            let step = match profile {
                Profile::Full => 1,
                Profile::Quick => 4,
            };
            Grid::default().and(from, to, step, 100).values()
        };
        let full = matches!(profile, Profile::Full);
        let few = |n: usize| match profile {
            Profile::Full => n,
            Profile::Quick => n.div_ceil(24).max(2),
        };
        let plain = |kind: ChainKind, name: String, realisations: usize| ChainCurve {
            kind,
            name,
            masses: chain.masses,
            start: chain.start,
            boundary: chain.boundary,
            sigmas: grid(8, 16),
            transients: vec![500.0],
            realisations: few(realisations),
        };
        let long = |masses: usize, realisations: usize, sigmas, transients: &[f64]| ChainCurve {
            masses,
            sigmas,
            transients: transients.to_vec(),
            ..plain(ChainKind::Length, format!("length-{masses}"), realisations)
        };
        let mut curves = vec![
            long(10, 600, grid(9, 25), &[50.0, 250.0, 500.0]),
            long(100, 120, grid(8, 16), &[500.0]),
        ];
        if full {
            // All at one T, then in proportion to ln n, one to n.
            curves.extend([
                long(1000, 8, grid(8, 15), &[500.0, 750.0, 5000.0]),
                long(10_000, 2, grid(8, 14), &[500.0, 1000.0]),
            ]);
        }
        let ends: &[f64] = if full { &[100.0, 500.0, 1000.0, 2000.0] } else { &[100.0, 500.0] };
        let drift = |name: &str| ChainCurve {
            sigmas: grid(9, 18),
            transients: ends.to_vec(),
            ..plain(ChainKind::Drift, format!("drift-{name}"), 24)
        };
        curves.extend([
            ChainCurve { start: Start::Random, ..drift("random") },
            ChainCurve { boundary: Boundary::Ring, ..drift("ring") },
        ]);
        ChainsParams {
            chain,
            window: 200.0,
            piece: 1000,
            curves,
            stream: "chains".into(),
            seed: SEED,
        }
    }

    /// Half heights of three lengths after three transients; of two short ones after two in the quick profile.
    pub fn sizes(profile: Profile) -> Self {
        let shape =
            ChainsParams { chain: Chain::default(), seed: SEED, ..Self::new(Profile::Quick) };
        let curve = |transient: f64, masses: usize, realisations, middle: u32| ChainCurve {
            kind: ChainKind::Length,
            name: format!("{masses} masses, T = {transient}"),
            masses,
            start: shape.chain.start,
            boundary: shape.chain.boundary,
            // Three σ about the place where shorter runs put the half height.
            sigmas: Grid::default().and(middle - 4, middle + 4, 4, 1000).values(),
            transients: vec![transient],
            realisations,
        };
        let curves = match profile {
            Profile::Full => vec![
                curve(500.0, 100, 150, 117),
                curve(500.0, 1000, 15, 117),
                curve(500.0, 10_000, 2, 117),
                curve(5000.0, 100, 125, 107),
                curve(5000.0, 1000, 12, 103),
                curve(5000.0, 10_000, 2, 103),
                curve(50_000.0, 100, 100, 103),
                curve(50_000.0, 1000, 3, 98),
                curve(50_000.0, 10_000, 2, 96),
            ],
            Profile::Quick => vec![
                curve(50.0, 20, 10, 160),
                curve(50.0, 100, 2, 140),
                curve(500.0, 20, 10, 125),
                curve(500.0, 100, 2, 117),
            ],
        };
        ChainsParams { curves, stream: "sizes".into(), ..shape }
    }
}
