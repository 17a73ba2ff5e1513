//! The shapes of the theory's results.

use super::Large;
use serde::{Deserialize, Serialize};

/// Everything that the theory figures and theory values need.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Theory {
    /// N of the main curves (100).
    pub vertices: usize,
    /// Fig. 7.
    pub simple_circuits: SimpleCircuits,
    /// Fig. 8 (a)–(d): P(X = k) at p = 0.01, 0.02, 0.05, 0.1.
    pub distributions: Vec<Distribution>,
    /// Fig. 9.
    pub most_likely: MostLikely,
    /// Fig. 10 (a)–(d): p → 0+, p_crit, between p_crit and p_jump, beyond p_jump.
    pub mechanism: Vec<Mechanism>,
    /// Fig. 11, and the same for a start from rest.
    pub relation: Vec<RelationRow>,
    /// Figs. 12 and 15, thick line: μ(p(σ)) for N = `vertices`.
    pub curve: Curve,
    /// Figs. 12 and 15, thin line: μ(p(σ)) for N = `vertices` + 1 (n masses between walls).
    pub curve_walls: Curve,
    /// Fig. 13: p = 0.005, 0.01, 0.05 (panels (a) and (b) share the first).
    pub higher: Vec<HigherDistribution>,
    /// Fig. 14 (a), (b): p = 0.015, 0.04.
    pub convergence: Vec<HigherDistribution>,
    /// Scalars for N = `vertices`.
    pub scalars: Scalars,
    /// Scalars for N = `vertices` + 1.
    pub scalars_walls: Scalars,
    /// The calculations behind the slips of the printed paper.
    pub slips: Slips,
    /// Fig. S6: many vertices, whatever `vertices` is.
    pub large: Large,
}

/// Fig. 7: the number of simple circuits of each length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SimpleCircuits {
    /// φ_N(k) / φ_N^tot, k = 1..=N.
    pub share: Vec<f64>,
    /// ln φ_N(k), k = 1..=N.
    pub log_count: Vec<f64>,
    /// ln φ_N^tot.
    pub log_total: f64,
}

/// Fig. 8: one distribution of the number of different impacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distribution {
    /// Edge probability p.
    pub p: f64,
    /// P(X = k), k = 1..=N.
    pub probability: Vec<f64>,
    /// k*, the most likely k.
    pub k_star: usize,
    /// μ, the expected k.
    pub mean: f64,
}

/// Fig. 9: the most likely and the expected number of impacts against p.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MostLikely {
    /// k*(p) as a step function: exact positions, from p = 0 on; the last step holds to p = 1.
    pub steps: Vec<Step>,
    /// μ(p) on a grid of [0, 1], finer at small p; the first point is the limit p → 0+.
    pub mean: Vec<MeanRow>,
    /// μ(p) on a fine grid of the small-p region (inset).
    pub mean_inset: Vec<MeanRow>,
}

/// k* takes the value `k_star` from `p` (exclusive: at p itself the lower value still holds) on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// Where the step is.
    pub p: f64,
    /// k* just after it.
    pub k_star: usize,
}

/// One point of μ(p).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeanRow {
    /// Edge probability p.
    pub p: f64,
    /// μ, simple circuits.
    pub mean: f64,
    /// μ, five classes.
    pub mean_higher: f64,
}

/// Fig. 10, one row: f_{N,p} and Φ_{N,p} at one p.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mechanism {
    /// Edge probability p (0 stands for p → 0+).
    pub p: f64,
    /// f_{N,p}(k) for real k, on an even grid of [0, N].
    pub f: Vec<Point>,
    /// Zeros k− and k+ of f_{N,p}, if there are any.
    pub zeros: Option<[f64; 2]>,
    /// Φ_{N,p}(k) / Γ_{N,p}, k = 1..=N.
    pub phi_over_gamma: Vec<f64>,
    /// k*.
    pub k_star: usize,
}

/// A point of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Abscissa.
    pub x: f64,
    /// Ordinate.
    pub y: f64,
}

/// Fig. 11, one point of p(σ), at ω = 1, Ω = √2, d = 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RelationRow {
    /// Standard deviation of the forcing.
    pub sigma: f64,
    /// p(σ) of Eq. (25).
    pub p: f64,
    /// The same probability for a start from rest (ours, Sec. 8 assumes random free parts).
    pub p_rest: f64,
}

/// Figs. 12 and 15: expected numbers of impacts against σ for one N.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Number of vertices.
    pub vertices: usize,
    /// The points.
    pub rows: Vec<CurveRow>,
}

/// One σ of a [`Curve`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurveRow {
    /// Standard deviation of the forcing.
    pub sigma: f64,
    /// μ(p(σ)), simple circuits (Fig. 12).
    pub simple: f64,
    /// μ(p(σ)), five classes (Fig. 15).
    pub higher: f64,
    /// μ with the probability for a start from rest in place of Eq. (25), simple circuits.
    pub simple_rest: f64,
}

/// Figs. 13 and 14: the five-class distribution at one p, over k = number of different vertices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HigherDistribution {
    /// Edge probability p.
    pub p: f64,
    /// P(X = k) over all five classes, k = 1..=N.
    pub total: Vec<f64>,
    /// Contributions of the five classes (they add up to `total`), in the order of Eq. (38).
    pub classes: Vec<ClassContribution>,
    /// P(X = k) of simple circuits alone, k = 1..=N.
    pub simple: Vec<f64>,
    /// μ over all five classes.
    pub mean: f64,
    /// μ of simple circuits alone.
    pub mean_simple: f64,
    /// Total variation distance between `total` and `simple`.
    pub total_variation: f64,
}

/// What one class of circuits contributes to a [`HigherDistribution`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClassContribution {
    /// Its part of P(X = k), k = 1..=N.
    pub probability: Vec<f64>,
    /// Its share of the whole.
    pub share: f64,
}

/// Single numbers of the theory for one N.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scalars {
    /// Number of vertices N.
    pub vertices: usize,
    /// p_crit, Eq. (18).
    pub p_crit: f64,
    /// p_jump, where k* leaves 1.
    pub p_jump: f64,
    /// k* just after p_jump.
    pub k_after_jump: usize,
    /// σ at which p(σ) = p_crit.
    pub sigma_crit: f64,
    /// σ at which p(σ) = p_jump.
    pub sigma_jump: f64,
    /// σ at which the probability for a start from rest is p_jump.
    pub sigma_jump_rest: f64,
    /// p_jump of the five-class sample space (primitive counts).
    pub higher_p_jump: f64,
    /// k* just after it.
    pub higher_k_after_jump: usize,
    /// σ at which p(σ) is the five-class p_jump.
    pub higher_sigma_jump: f64,
    /// p_jump of the five-class sample space with the printed formulas at every length.
    pub printed_p_jump: f64,
    /// σ at which μ(p(σ)), simple circuits, is (N + 1)/2: half way between 1 and N.
    pub sigma_half: f64,
    /// The same with five classes.
    pub higher_sigma_half: f64,
    /// The same, simple circuits, with the probability for a start from rest.
    pub sigma_half_rest: f64,
}

/// Calculations that show the slips and ambiguities of the printed paper (N = `Theory::vertices`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Slips {
    /// Eq. (8) at k = N − 1.
    pub ratio_before_last: f64,
    /// The k at which φ_N(k) is largest.
    pub longest_peak: usize,
    /// Share of simple circuits with k ≥ N − 3.
    pub share_near_end: f64,
    /// μ in the limit p → 0+.
    pub mean_at_zero: f64,
    /// k* at p = 1.
    pub k_star_at_one: usize,
    /// Φ(N)/Φ(N − 1) at p = 1.
    pub last_ratio_at_one: f64,
    /// The first integer k to become a local maximum of Φ beyond k = 1, and p there as a fraction.
    pub first_local_maximum: FirstLocalMaximum,
    /// Share of simple circuits in *all* circuits of five classes, at several p.
    pub simple_shares: Vec<Point>,
    /// Total variation between simple and five-class distributions, at several p.
    pub total_variations: Vec<Point>,
    /// Eq. (30) as printed against Eq. (33), at k = 3: they differ by the factor N.
    pub missing_factor: f64,
}

/// The first local maximum of Φ_{N,p} over integers k > 1, as p grows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FirstLocalMaximum {
    /// The k with f(k) = 0 first; the maximum is then at k and k + 1.
    pub k: usize,
    /// Numerator of p.
    pub numerator: u64,
    /// Denominator of p.
    pub denominator: u64,
    /// p.
    pub p: f64,
}
