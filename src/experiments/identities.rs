//! The exact statements of Secs. 3 to 9, each compared with a second route: formulas with the
//! enumeration of small graphs, closed forms with quadrature, zeros with the function.
//!
//! Cheap and in memory, as the theory is; what a claim judges is how many cases fail, or by how
//! much.

use crate::circuits::counting::{paths, phi};
use crate::circuits::distribution::{Law, SampleSpace};
use crate::circuits::graph::{Circuit, Graph};
use crate::circuits::higher_order::{
    Class, compositions, doubled, doubled_as_printed, doubled_paths, four_visits, three_visits,
    two_doubled,
};
use crate::circuits::impact_probability::{ImpactProbability, density_forced, density_free};
use crate::circuits::{Fraction, jump};
use crate::numerics::bisection;
use crate::numerics::quadrature::GaussLegendre;
use crate::params::{Chain, Profile, SweepParams};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Whole cases that agree or fail.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cases {
    /// How many were compared.
    pub compared: u64,
    /// How many of these failed.
    pub failed: u64,
}

impl Cases {
    fn see(&mut self, agrees: bool) {
        self.compared += 1;
        self.failed += u64::from(!agrees);
    }
}

/// A printed formula for a class of circuits, against enumeration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClassRange {
    /// Its equation.
    pub equation: u32,
    /// The smallest length from which on it is right in every case.
    pub right_from: usize,
    /// Cases from that length on.
    pub cases: Cases,
    /// One length below, on three vertices: what it gives.
    pub formula_below: f64,
    /// One length below, on three vertices: what enumeration finds.
    pub counted_below: u64,
}

/// A gap that closes by itself, at one σ.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Nucleation {
    /// Standard deviation σ.
    pub sigma: f64,
    /// p of Eq. (25); 0 where it is below the range of doubles.
    pub p: f64,
    /// Probability that a gap between two masses closes by itself after a start from rest.
    pub p_rest: f64,
    /// Probability that one of all N gaps does, if they were independent and alike.
    pub any_rest: f64,
}

/// All comparisons.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identities {
    /// n + 1 impacts of a chain, n − 1 of them between masses, by the names of the vertices.
    pub impact_types: Cases,
    /// Vertices of the graph for three masses.
    pub graph_vertices: usize,
    /// Its edges.
    pub graph_edges: usize,
    /// Eq. (6) against enumeration.
    pub eq6: Cases,
    /// Eq. (7) against enumeration.
    pub eq7: Cases,
    /// Lengths k < N with φ_N(k)/φ_N(N) above one tenth.
    pub eq8_exceptions: Vec<usize>,
    /// Eq. (9): largest distance of the sum of the probabilities from one.
    pub normalisation: f64,
    /// Eq. (11): sign of the difference of neighbouring weights against the sign of f.
    pub eq11: Cases,
    /// Eq. (13): |f(k±)| over the largest of its three terms, the largest seen.
    pub eq13: f64,
    /// Eqs. (14) and (15): largest relative deviation of f at the ends.
    pub eq14_15: f64,
    /// Eqs. (16) and (17): signs, and the slope against a finite difference.
    pub eq16_17: Cases,
    /// Eq. (18): the p at which the zeros of f appear, by bisection.
    pub p_crit_by_bisection: f64,
    /// Eq. (18): the place of the double zero.
    pub k_touch: f64,
    /// Steps of k* with p, on a grid of [p_jump, 1]: how many do not fall.
    pub monotone: Cases,
    /// Steps Φ(k) > Φ(k + 1) at p = 0.
    pub falling_at_zero: Cases,
    /// Steps Φ(k) > Φ(k + 1) at every p of a grid between 0 and p_crit.
    pub falling_below_crit: Cases,
    /// k* at p_crit and half way to p_jump.
    pub k_star_before_jump: [usize; 2],
    /// dμ/dp at p_jump: the variance of X over p.
    pub mean_slope_by_variance: f64,
    /// The same from values of μ on both sides of p_jump.
    pub mean_slope_by_difference: f64,
    /// Eqs. (22) and (23): largest distance of the integrals from one.
    pub densities: f64,
    /// Eq. (25): largest relative difference between closed form and double integral.
    pub eq25: f64,
    /// Eq. (29) against enumeration, for both loops given.
    pub eq29: Cases,
    /// Eq. (30) as printed, at k = N = 3.
    pub eq30_printed: f64,
    /// What enumeration finds there.
    pub eq30_counted: u64,
    /// Eq. (30) times N against enumeration.
    pub eq30_times_n: Cases,
    /// Eq. (32) against enumeration.
    pub eq32: Cases,
    /// Eqs. (33), (35), (36) and (37) against enumeration.
    pub classes: Vec<ClassRange>,
    /// Gaps that close by themselves, at the σ of the main sweep of every profile.
    pub nucleation: Vec<Nucleation>,
    /// σ at which one of all N gaps closes by itself with probability one half, after a start
    /// from rest and as if gaps were independent.
    pub sigma_kept_half: f64,
    /// σ of the random starts whose overlap is given.
    pub overlap_sigma: f64,
    /// Probability that a gap with a random free part starts overlapped, over p of Eq. (25).
    pub overlap_share: f64,
}

/// Makes all comparisons, for N = `vertices`.
///
/// # Errors
/// As [`super::theory::run`].
pub fn run(vertices: usize) -> Result<Identities, crate::circuits::Error> {
    let census = census();
    let crit = jump::p_crit(vertices)?;
    let leap = jump::p_jump(SampleSpace::Simple, vertices)?;
    let law = |p: f64| Law::new(SampleSpace::Simple, vertices, p);
    let graph = Graph::of_chain(3);
    let chain = Chain::default();
    let before = [crit, 0.5 * (crit + leap.bracket[0])];
    let [by_variance, by_difference] = mean_slopes(vertices, leap.p)?;
    let overlap_sigma = 0.145;
    Ok(Identities {
        impact_types: impact_types(),
        graph_vertices: graph.vertices(),
        graph_edges: graph.edges().count(),
        eq6: eq6(&census),
        eq7: eq7(&census),
        eq8_exceptions: (1..vertices)
            .filter(|&k| crate::circuits::counting::ratio_to_longest(vertices, k) > 0.1)
            .collect(),
        normalisation: normalisation(vertices)?,
        eq11: eq11(vertices)?,
        eq13: eq13(vertices),
        eq14_15: ends(vertices),
        eq16_17: slopes(vertices),
        p_crit_by_bisection: touching(vertices),
        k_touch: (vertices as f64 * crit - 1.0) / (2.0 * crit),
        monotone: monotone(vertices, leap.bracket[1])?,
        falling_at_zero: falling_at_zero(vertices)?,
        falling_below_crit: falling(vertices, crit),
        k_star_before_jump: [law(before[0])?.k_star(), law(before[1])?.k_star()],
        mean_slope_by_variance: by_variance,
        mean_slope_by_difference: by_difference,
        densities: densities(),
        eq25: eq25()?,
        eq29: eq29(),
        eq30_printed: doubled_as_printed(3, 3).map_or(f64::NAN, Fraction::to_f64),
        eq30_counted: counted(&census, 3, 3, &[1]),
        eq30_times_n: eq30_times_n(&census),
        eq32: eq32(),
        classes: class_ranges(&census),
        nucleation: nucleation(chain.gaps())?,
        sigma_kept_half: sigma_kept_half(chain.gaps()),
        overlap_sigma,
        overlap_share: overlap(overlap_sigma, &chain)?,
    })
}

/// Number of primitive circuits by (N, length, class), found by enumeration.
type Census = BTreeMap<(usize, usize, Vec<usize>), u64>;

/// Longest circuits that are enumerated on N = 1, 2, … vertices.
const LONGEST: [usize; 6] = [6, 10, 8, 7, 6, 6];

fn census() -> Census {
    let mut census = Census::new();
    for (n, longest) in (1..).zip(LONGEST) {
        for circuit in Graph::of_chain(n - 1).circuits(longest) {
            *census.entry((n, circuit.length(), circuit.repeats())).or_insert(0) += 1;
        }
    }
    census
}

/// All (N, length) that were enumerated.
fn enumerated() -> impl Iterator<Item = (usize, usize)> {
    (1..).zip(LONGEST).flat_map(|(n, longest)| (1..=longest).map(move |k| (n, k)))
}

fn counted(census: &Census, n: usize, k: usize, repeats: &[usize]) -> u64 {
    census.get(&(n, k, repeats.to_vec())).copied().unwrap_or(0)
}

fn impact_types() -> Cases {
    let mut cases = Cases::default();
    for masses in 1..=20 {
        let graph = Graph::of_chain(masses);
        let walls = (0..graph.vertices())
            .filter(|&v| graph.label(v).starts_with('L') || graph.label(v).ends_with('R'))
            .count();
        cases.see(graph.vertices() == masses + 1 && walls == 2);
    }
    cases
}

/// Closed paths from vertex 0 without repetition: rotations of the simple circuits through it.
fn eq6(census: &Census) -> Cases {
    let mut cases = Cases::default();
    for (n, k) in enumerated().filter(|&(n, k)| k <= n) {
        // A path is a simple circuit with one of its k vertices as the first: N paths in all.
        let all_paths = u128::from(counted(census, n, k, &[])) * k as u128;
        cases.see(paths(n, k).map(|each| each * n as u128) == Some(all_paths));
    }
    cases
}

fn eq7(census: &Census) -> Cases {
    let mut cases = Cases::default();
    for (n, k) in enumerated().filter(|&(n, k)| k <= n) {
        cases.see(phi(n, k) == Some(u128::from(counted(census, n, k, &[]))));
    }
    cases
}

/// The p of Figs. 8 to 14, and some beyond.
const GRID: [f64; 10] = [0.001, 0.005, 0.01, 0.012, 0.015, 0.02, 0.04, 0.1, 0.5, 1.0];

fn normalisation(n: usize) -> Result<f64, crate::circuits::Error> {
    let mut largest = 0.0_f64;
    for p in GRID {
        let sum: f64 = Law::new(SampleSpace::Simple, n, p)?.probabilities().iter().sum();
        largest = largest.max((sum - 1.0).abs());
    }
    Ok(largest)
}

fn eq11(n: usize) -> Result<Cases, crate::circuits::Error> {
    let mut cases = Cases::default();
    for p in GRID {
        let law = Law::new(SampleSpace::Simple, n, p)?;
        let mut here = law.weight(1)?;
        for k in 1..n {
            let next = law.weight(k + 1)?;
            let f = jump::f(n, p, k as f64);
            // A tie of the weights is a zero of f.
            cases.see((next > here) == (f > 0.0) && (next < here) == (f < 0.0));
            here = next;
        }
    }
    Ok(cases)
}

fn eq13(n: usize) -> f64 {
    let mut largest = 0.0_f64;
    for p in GRID {
        for k in jump::zeros(n, p).into_iter().flatten() {
            let terms = [p * k * k, (n as f64 * p - 1.0) * k, 1.0];
            let size = terms.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            largest = largest.max(jump::f(n, p, k).abs() / size);
        }
    }
    largest
}

fn ends(n: usize) -> f64 {
    let at = |p, k| jump::f(n, p, k);
    GRID.into_iter()
        .flat_map(|p| [at(p, 0.0) + 1.0, at(p, n as f64) / (n as f64 + 1.0) + 1.0])
        .fold(0.0, |a, b| a.max(b.abs()))
}

fn slopes(n: usize) -> Cases {
    let mut cases = Cases::default();
    for k in 1..n {
        let k = k as f64;
        let none = jump::f(n, 0.0, k);
        cases.see(none < 0.0 && none == -(k + 1.0));
        // f is linear in p, so the difference over all of [0, 1] is the slope.
        let slope = jump::f(n, 1.0, k) - none;
        cases.see(slope > 0.0 && (slope / (k * (n as f64 - k)) - 1.0).abs() < 1e-14);
    }
    cases
}

fn touching(n: usize) -> f64 {
    // f has real zeros for k > 0 where its largest value, at k = (N p − 1)/2p, is not negative.
    let top = |p: f64| {
        let k = (n as f64 * p - 1.0) / (2.0 * p);
        k > 0.0 && jump::f(n, p, k) >= 0.0
    };
    bisection::bracket(1e-6, 1.0, top)[1]
}

fn monotone(n: usize, from: f64) -> Result<Cases, crate::circuits::Error> {
    let mut cases = Cases::default();
    let mut last = 1;
    for i in 0..=1000 {
        let p = from + (1.0 - from) * f64::from(i) / 1000.0;
        let k = Law::new(SampleSpace::Simple, n, p.min(1.0))?.k_star();
        cases.see(k >= last);
        last = k;
    }
    Ok(cases)
}

/// At p = 0 the weights proper, p times those of [`Law`], are all zero.
fn falling_at_zero(n: usize) -> Result<Cases, crate::circuits::Error> {
    let mut cases = Cases::default();
    let law = Law::new(SampleSpace::Simple, n, 0.0)?;
    let proper = |k| Ok::<_, crate::circuits::Error>(0.0 * law.weight(k)?.to_f64());
    for k in 1..n {
        cases.see(proper(k)? > proper(k + 1)?);
    }
    Ok(cases)
}

fn falling(n: usize, crit: f64) -> Cases {
    let mut cases = Cases::default();
    for i in 1..=100 {
        for k in 1..n {
            cases.see(jump::f(n, crit * f64::from(i) / 100.0, k as f64) < 0.0);
        }
    }
    cases
}

/// dμ/dp = Var(X)/p for weights in proportion to p^k, and by a central difference.
fn mean_slopes(n: usize, p: f64) -> Result<[f64; 2], crate::circuits::Error> {
    let law = Law::new(SampleSpace::Simple, n, p)?;
    let mean = law.mean();
    let variance: f64 = (1_u32..)
        .zip(law.probabilities())
        .map(|(k, q)| q * (f64::from(k) - mean) * (f64::from(k) - mean))
        .sum();
    let step = 1e-5 * p;
    let at = |p| Ok::<_, crate::circuits::Error>(Law::new(SampleSpace::Simple, n, p)?.mean());
    Ok([variance / p, (at(p + step)? - at(p - step)?) / (2.0 * step)])
}

fn densities() -> f64 {
    let rule = GaussLegendre::new(20);
    [0.05, 0.12, 0.4]
        .into_iter()
        .flat_map(|sigma| {
            let whole = |f: &dyn Fn(f64) -> f64| rule.integrate_panels(0.0, 20.0 * sigma, 40, f);
            [whole(&|x| density_free(x, sigma)), whole(&|x| density_forced(x, sigma, 1.0))]
        })
        .fold(0.0, |largest, integral| largest.max((integral - 1.0).abs()))
}

/// The σ at which the double integral still has some digits of p left.
const EQ25_SIGMAS: [f64; 5] = [0.15, 0.2, 0.3, 0.5, 1.0];

fn eq25() -> Result<f64, crate::circuits::Error> {
    let mut largest = 0.0_f64;
    for sigma in EQ25_SIGMAS {
        let gap = ImpactProbability::of_paper(sigma)?;
        largest = largest.max((gap.p_by_double_integral(8) / gap.p()? - 1.0).abs());
    }
    Ok(largest)
}

/// Circuits through vertex 0 twice, by the sorted lengths of their two loops.
fn eq29() -> Cases {
    let mut cases = Cases::default();
    for (n, longest) in (1..).zip(LONGEST) {
        let mut loops: BTreeMap<[usize; 2], u128> = BTreeMap::new();
        let through = |circuit: &Circuit| {
            let visits = circuit.visits();
            visits.get(&0) == Some(&2) && visits.iter().all(|(&v, &times)| v == 0 || times == 1)
        };
        for circuit in Graph::of_chain(n - 1).circuits(longest).filter(through) {
            let at: Vec<usize> =
                (0..circuit.length()).filter(|&i| circuit.word()[i] == 0).collect();
            let first = at[1] - at[0];
            let mut lengths = [first, circuit.length() - first];
            lengths.sort_unstable();
            *loops.entry(lengths).or_insert(0) += 1;
        }
        for ([a, b], circuits) in loops {
            // Two loops of equal length may be named in either order: half of the formula.
            let ordered = if a == b { 2 * circuits } else { circuits };
            cases.see(doubled_paths(n, a + b) == Some(ordered));
        }
    }
    cases
}

fn eq30_times_n(census: &Census) -> Cases {
    let mut cases = Cases::default();
    for (n, k) in enumerated().filter(|&(n, k)| k >= 3 && k <= n + 1) {
        let times_n = doubled_as_printed(n, k)
            .map(|f| Fraction::new(f.numerator * n as u128, f.denominator))
            .and_then(Fraction::integer);
        cases.see(times_n == Some(u128::from(counted(census, n, k, &[1]))));
    }
    cases
}

fn eq32() -> Cases {
    /// Ordered sums of j positive integers, one by one.
    fn count(n: usize, j: usize) -> u128 {
        match j {
            0 => u128::from(n == 0),
            _ => (1..=n).map(|first| count(n - first, j - 1)).sum(),
        }
    }
    let mut cases = Cases::default();
    for n in 1..=10 {
        for j in 1..=n {
            cases.see(compositions(n, j) == Some(count(n, j)));
        }
    }
    cases
}

/// A formula for N vertices and length k.
type Formula = fn(usize, usize) -> Option<Fraction>;

fn class_ranges(census: &Census) -> Vec<ClassRange> {
    let printed: [(u32, Formula, &[usize]); 4] = [
        (33, doubled, &[1]),
        (35, three_visits, &[0, 1]),
        (36, four_visits, &[0, 0, 1]),
        (37, two_doubled, &[2]),
    ];
    printed
        .into_iter()
        .map(|(equation, formula, repeats)| {
            let class = Class::new(repeats);
            let agrees = |n: usize, k: usize| {
                let value = formula(n, k).and_then(Fraction::integer);
                value == Some(u128::from(counted(census, n, k, repeats)))
            };
            let possible: Vec<(usize, usize)> =
                enumerated().filter(|&(n, k)| class.different(k).is_some_and(|d| d <= n)).collect();
            let wrong = possible.iter().filter(|&&(n, k)| !agrees(n, k)).map(|&(_, k)| k).max();
            let right_from = wrong.map_or(1, |k| k + 1);
            let mut cases = Cases::default();
            for &(n, k) in possible.iter().filter(|&&(_, k)| k >= right_from) {
                cases.see(agrees(n, k));
            }
            let below = right_from - 1;
            ClassRange {
                equation,
                right_from,
                cases,
                formula_below: formula(3, below).map_or(f64::NAN, Fraction::to_f64),
                counted_below: counted(census, 3, below, repeats),
            }
        })
        .collect()
}

/// Probability that one of `gaps` independent gaps closes by itself.
fn any(p: f64, gaps: usize) -> f64 {
    -pxfm::f_expm1(gaps as f64 * pxfm::f_log1p(-p))
}

/// At the σ of the main sweeps of all profiles.
fn nucleation(gaps: usize) -> Result<Vec<Nucleation>, crate::circuits::Error> {
    let profiles = [Profile::Quick, Profile::Ci, Profile::Full];
    let mut sigmas = profiles.map(|profile| SweepParams::main(profile).sigmas).concat();
    sigmas.sort_by(f64::total_cmp);
    sigmas.dedup();
    sigmas
        .into_iter()
        .map(|sigma| {
            let gap = ImpactProbability::of_paper(sigma)?;
            let p_rest = gap.p_from_rest().unwrap_or(0.0);
            let any_rest = any(p_rest, gaps);
            Ok(Nucleation { sigma, p: gap.p().unwrap_or(0.0), p_rest, any_rest })
        })
        .collect()
}

fn sigma_kept_half(gaps: usize) -> f64 {
    let half = |sigma: f64| {
        let p = ImpactProbability::of_paper(sigma).and_then(|gap| gap.p_from_rest());
        p.is_ok_and(|p| any(p, gaps) >= 0.5)
    };
    bisection::bracket(0.01, 1.0, half)[1]
}

/// Δ(0) = d + δα_0 − δα_1 is normal with variance 4σ² (both frequencies of the paper's chain).
fn overlap(sigma: f64, chain: &Chain) -> Result<f64, crate::circuits::Error> {
    let deviations = chain.spacing / (2.0 * sigma);
    let overlapped = 0.5 * pxfm::f_erfc(deviations / std::f64::consts::SQRT_2);
    Ok(overlapped / ImpactProbability::of_paper(sigma)?.p()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_statements_hold_and_slips_show() {
        let found = run(100).unwrap();
        for (name, cases) in [
            ("types", found.impact_types),
            ("6", found.eq6),
            ("7", found.eq7),
            ("11", found.eq11),
            ("16, 17", found.eq16_17),
            ("monotone", found.monotone),
            ("falling", found.falling_below_crit),
            ("29", found.eq29),
            ("30 times N", found.eq30_times_n),
            ("32", found.eq32),
        ] {
            assert!(cases.compared > 5 && cases.failed == 0, "({name}): {cases:?}");
        }
        assert_eq!((found.graph_vertices, found.graph_edges), (4, 16));
        // φ_N(97..=99)/φ_N(100) = 100/(97·6), 100/(98·2), 100/99; at 96 it is 100/(96·24) = 0.043.
        assert_eq!(found.eq8_exceptions, [97, 98, 99]);
        let right_from: Vec<_> = found.classes.iter().map(|c| (c.equation, c.right_from)).collect();
        assert_eq!(right_from, [(33, 3), (35, 4), (36, 5), (37, 5)]);
        assert_eq!((found.eq30_printed, found.eq30_counted), (2.0, 6));
    }

    /// p_rest from 40-digit arithmetic: 0.0309524 at σ = 0.12, 0.00711502 at 0.1, and with them
    /// 1 − (1 − p_rest)^101 = 0.958 and 0.514; half of 10⁶ would lie between.
    #[test]
    fn nucleation_has_its_known_values() {
        let found = run(100).unwrap();
        let at = |sigma| found.nucleation.iter().find(|n| n.sigma == sigma).unwrap();
        assert!((at(0.12).p_rest - 0.0309524).abs() < 1e-7);
        assert!((at(0.12).any_rest - 0.958).abs() < 1e-3);
        assert!(found.sigma_kept_half > 0.099 && found.sigma_kept_half < 0.1);
        assert!((found.mean_slope_by_variance / found.mean_slope_by_difference - 1.0).abs() < 1e-6);
    }
}
