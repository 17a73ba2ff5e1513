//! Computes p(σ), and μ along it (Sec. 8, Figs. 11, 12 and 15), and gaps that close by themselves.

use super::basics::*;
use super::law::law;
use impact_chain::rise::ONSET;
use impact_circuits::impact_probability::ImpactProbability;
use std::f64::consts::SQRT_2;

/// σ of the random starts whose overlap is given.
const OVERLAP: f64 = 0.145;

/// Returns p(σ) of Eq. (25) for the paper's chain, 0 where it underflows.
pub(super) fn p_of(sigma: f64) -> f64 {
    expect_known(ImpactProbability::of_paper(sigma)).p().unwrap_or(0.0)
}

fn p_rest_of(sigma: f64) -> f64 {
    expect_known(ImpactProbability::of_paper(sigma)).p_from_rest().unwrap_or(0.0)
}

/// Returns the smallest σ < 1 from which on a property holds, to the last bit.
fn smallest_sigma(holds: impl FnMut(f64) -> bool) -> f64 {
    roots::bracket(0.0, 1.0, holds)[1]
}

/// Returns the σ at which a relation reaches p.
pub(super) fn reaches(p_of: fn(f64) -> f64, p: f64) -> f64 {
    smallest_sigma(|sigma| p_of(sigma) >= p)
}

/// Returns the σ at which μ along a relation is (N + 1)/2: half way between 1 and N.
fn half(p_of: fn(f64) -> f64, space: SampleSpace) -> f64 {
    let middle = 0.5 * (VERTICES as f64 + 1.0);
    smallest_sigma(|sigma| law(space, p_of(sigma)).mean() >= middle)
}

/// Makes the table of curves against σ, finer where circuits of higher order add most.
pub(super) fn curve() -> Table {
    let sigmas = Grid::default().and(20..=139, 1000).and(700..=760, 5000).and(153..=400, 1000);
    let row = |sigma: f64| {
        let (p, rest) = (p_of(sigma), p_rest_of(sigma));
        let means = [(Simple, p), (FiveClasses, p), (Simple, rest)];
        let [simple, higher, from_rest] = means.map(|(space, p)| law(space, p).mean());
        [sigma, p, rest, simple, higher, from_rest]
    };
    let rows: Vec<[f64; 6]> = sigmas.values().into_par_iter().map(row).collect();
    Table::builder("theory.curve", &rows, |_| 0)
        .table_computed_by(origin(Law::mean))
        .key("sigma", SIGMA, |row| row[0])
        .real("p", "1", 3, "Eq. (25)", |row| row[1])
        .computed_by(origin(ImpactProbability::p), &["p"])
        .real("p_rest", "1", 3, "the same from rest", |row| row[2])
        .computed_by(origin(ImpactProbability::p_from_rest), &["p_rest"])
        .real("simple", "1", 3, "μ, simple circuits", |row| row[3])
        .real("higher", "1", 3, "μ, five classes", |row| row[4])
        .real("rest", "1", 3, "μ from rest, simple circuits", |row| row[5])
        .done()
}

/// Returns the probability that one of `gaps` independent gaps closes by itself.
fn any(p: f64, gaps: usize) -> f64 {
    -pxfm::f_expm1(gaps as f64 * pxfm::f_log1p(-p))
}

/// Returns the probability that some gap closes by itself by Eq. (25), for random free parts, with
/// another p at the walls: an upper bound, since normal variables make symmetric convex events no
/// less likely together.
fn any_random(sigma: &f64) -> f64 {
    let none = (Chain::default().gaps() - 2) as f64 * pxfm::f_log1p(-p_of(*sigma));
    -pxfm::f_expm1(none + 2.0 * pxfm::f_log1p(-p_of(sigma / SQRT_2)))
}

/// Returns the σ at which a share of the chains from rest has a gap that closes by itself, as if
/// gaps were independent.
fn sigma_kept(share: f64) -> f64 {
    smallest_sigma(|sigma| any(p_rest_of(sigma), Chain::default().gaps()) >= share)
}

/// Returns the share of starts that overlap, over p: Δ(0) = d + δα_0 − δα_1 has variance 4σ².
fn overlap(sigma: f64) -> f64 {
    0.5 * pxfm::f_erfc(Chain::default().spacing / (2.0 * sigma) / SQRT_2) / p_of(sigma)
}

/// Returns the largest relative difference of the closed form of Eq. (25) and the integral.
fn eq25() -> f64 {
    largest([0.15, 0.2, 0.3, 0.5, 1.0].map(|sigma| {
        let law = expect_known(ImpactProbability::of_paper(sigma));
        (law.p_by_double_integral(8) / expect_known(law.p()) - 1.0).abs()
    }))
}

pub(super) fn relation() -> Table {
    const KEPT_HALF: &str = "σ at which half of the chains have a seed";
    const KEPT_ONSET: &str = "σ at which enough have one for the onset";
    const ALONE: &str = "σ at which a quarter of the gaps close by themselves";
    let crit = expect_known(p_crit(VERTICES));
    let jumps = [(Simple, VERTICES), (Simple, VERTICES + 1), (FiveClasses, VERTICES)];
    let [jump, walls, higher] = jumps.map(|(space, n)| expect_known(p_jump(space, n)).p);
    one_row("theory.relation", origin(reaches))
        .real("sigma_crit", SIGMA, 4, "σ at which p is p_crit", |()| reaches(p_of, crit))
        .real("sigma_jump", SIGMA, 4, "σ at which p is p_jump", |()| reaches(p_of, jump))
        .real("sigma_jump_walls", SIGMA, 4, "the same for N + 1", |()| reaches(p_of, walls))
        .real("sigma_jump_rest", SIGMA, 4, "from rest", |()| reaches(p_rest_of, jump))
        .real("sigma_jump_higher", SIGMA, 4, "with five classes", |()| reaches(p_of, higher))
        .real("sigma_half", SIGMA, 4, "σ at which μ is (N + 1)/2", |()| half(p_of, Simple))
        .real("sigma_half_rest", SIGMA, 4, "from rest", |()| half(p_rest_of, Simple))
        .real("sigma_half_higher", SIGMA, 4, "with five classes", |()| half(p_of, FiveClasses))
        .computed_by(origin(half), &["sigma_half", "sigma_half_rest", "sigma_half_higher"])
        .real("difference", "1", 1, "Eq. (25) less its double integral, relative", |()| eq25())
        .computed_by(origin(eq25), &["difference"])
        .real("sigma_kept_half", SIGMA, 3, KEPT_HALF, |()| sigma_kept(0.5))
        .real("sigma_kept_onset", SIGMA, 3, KEPT_ONSET, |()| sigma_kept(ONSET))
        .computed_by(origin(sigma_kept), &["sigma_kept_half", "sigma_kept_onset"])
        .real("alone_quarter", SIGMA, 3, ALONE, |()| reaches(p_rest_of, 0.25))
        .real("alone_half", SIGMA, 3, "half of them", |()| reaches(p_rest_of, 0.5))
        .real("alone_three_quarters", SIGMA, 3, "three quarters", |()| reaches(p_rest_of, 0.75))
        .chosen("overlap_sigma", SIGMA, "of random starts", |()| Some(OVERLAP))
        .real("overlap_share", "1", 2, "starts that overlap, over p", |()| overlap(OVERLAP))
        .computed_by(origin(overlap), &["overlap_share"])
        .done()
}

/// Makes the table of gaps that close by themselves, at the σ of the main sweeps of all profiles.
pub(super) fn gaps() -> Table {
    let gaps = Chain::default().gaps();
    let expected = |sigma: &f64| gaps as f64 * p_rest_of(*sigma);
    let profiles = [Profile::Quick, Profile::Full];
    let mut sigmas = profiles.map(|profile| params::sweep(profile)[0].sigmas.clone()).concat();
    sigmas.sort_by(f64::total_cmp);
    sigmas.dedup();
    Table::builder("theory.gap", &sigmas, |_| 0)
        .key("sigma", SIGMA, |sigma| *sigma)
        .real("p", "1", 3, "Eq. (25)", |sigma| p_of(*sigma))
        .computed_by(origin(ImpactProbability::p), &["p"])
        .real("p_rest", "1", 3, "the same from rest", |sigma| p_rest_of(*sigma))
        .computed_by(origin(ImpactProbability::p_from_rest), &["p_rest"])
        .real("ratio", "1", 2, "p_rest/p", |sigma| p_rest_of(*sigma) / p_of(*sigma))
        .real("expected", "1", 2, "gaps that close by themselves, from rest", expected)
        .real("any_rest", "1", 3, "probability that one does", |sigma| any(p_rest_of(*sigma), gaps))
        .computed_by(origin(any), &["any_rest"])
        .real("any_random", "1", 3, "bound on it with random free parts", any_random)
        .done()
}
