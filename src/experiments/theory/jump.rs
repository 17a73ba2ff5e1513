//! Computes the jump of the most likely number of impacts: Sec. 7, Fig. 10.

use super::basics::*;
use super::law::{k_star, law};

const N: f64 = VERTICES as f64;

pub(super) fn numbers() -> Table {
    let p_crit_of = |vertices| expect_known(jump::p_crit(vertices));
    let (p_crit, p_jump) = (p_crit_of(VERTICES), expect_known(jump::p_jump(Simple, VERTICES)));
    let (at_one, between) = (law(Simple, 1.0), 0.5 * (p_crit + p_jump.bracket[0]));
    let [before, last] = [VERTICES - 1, VERTICES].map(|k| expect_known(at_one.weight(k)));
    let [by_variance, by_difference] = mean_slopes(p_jump.p);
    one_row("theory.jump", origin(jump::p_crit))
        .real("p_crit", "1", 5, "Eq. (18)", |()| p_crit)
        .real("p_crit_walls", "1", 5, "the same for N + 1", |()| p_crit_of(VERTICES + 1))
        .real("k_touch", "1", 4, "double zero of f at p_crit", |()| top(p_crit))
        .computed_by(origin(top), &["k_touch"])
        .real("p_crit_found", "1", 5, "where zeros of f appear, by bisection", |()| touching())
        .computed_by(origin(touching), &["p_crit_found"])
        .real("p_flat", "1", 6, "where Φ of real k has a stationary inflexion", |()| flat()[0])
        .real("k_flat", "1", 3, "its k", |()| flat()[1])
        .computed_by(origin(flat), &["p_flat", "k_flat"])
        .real("p_jump", "1", 5, "p at which k* leaves 1", |()| p_jump.p)
        .count("k_after", "k* after it", |()| p_jump.k_after as u64)
        .real("after_crit", "1", 2, "p_jump/p_crit − 1", |()| p_jump.p / p_crit - 1.0)
        .computed_by(origin(jump::p_jump), &["p_jump", "k_after", "after_crit"])
        .count("k_at_zero", "k* for p → 0", |()| k_star(0.0) as u64)
        .count("k_at_crit", "k* at p_crit", |()| k_star(p_crit) as u64)
        .count("k_before", "k* half way from p_crit to p_jump", |()| k_star(between) as u64)
        .count("k_at_one", "k* at p = 1", |()| at_one.k_star() as u64)
        .computed_by(origin(Law::k_star), &["k_at_zero", "k_at_crit", "k_before", "k_at_one"])
        .real("last_ratio", "1", 2, "Φ(N)/Φ(N − 1) at p = 1", |()| (last / before).to_f64())
        .computed_by(origin(Law::weight), &["last_ratio"])
        .real("slope", "1", 4, "dμ/dp at p_jump, by a difference", |()| by_difference)
        .real("variance_over_p", "1", 4, "Var(X)/p at p_jump", |()| by_variance)
        .computed_by(origin(mean_slopes), &["slope", "variance_over_p"])
        .done()
}

pub(super) fn first_maximum() -> Table {
    let (k, [above, below]) =
        jump::first_local_maximum(VERTICES).expect("N = 100 has a local maximum");
    let p = above as f64 / below as f64;
    one_row("theory.first_maximum", origin(jump::first_local_maximum))
        .count("numerator", "of p", |()| above as u64)
        .count("denominator", "of p", |()| below as u64)
        .real("p", "1", 5, "where Φ first has a local maximum beyond k = 1", |()| p)
        .count("k", "where it is", |()| k as u64)
        .count("k_next", "where it is as well", |()| k as u64 + 1)
        .done()
}

/// Returns the p of Fig. 10: 0, p_crit, half way from there to the jump, and the jump itself.
pub fn stages() -> [f64; 4] {
    let p_crit = expect_known(jump::p_crit(VERTICES));
    let p_jump = expect_known(jump::p_jump(Simple, VERTICES)).p;
    [0.0, p_crit, 0.5 * (p_crit + p_jump), p_jump]
}

/// Returns f_{N,p}(k) on [0, N], four points to a unit of k.
pub fn f(p: f64) -> Vec<(f64, f64)> {
    (0..=VERTICES * 4).map(|i| i as f64 / 4.0).map(|k| (k, jump::f(VERTICES, p, k))).collect()
}

/// Returns the zeros of f_{N,p}; at the double nearest to p_crit both are 1/√p, on whichever side
/// of p_crit it lies.
pub fn zeros(p: f64) -> Option<[f64; 2]> {
    if p == expect_known(jump::p_crit(VERTICES)) {
        return Some([1.0 / p.sqrt(); 2]);
    }
    jump::zeros(VERTICES, p)
}

/// Returns where f is largest.
pub(crate) fn top(p: f64) -> f64 {
    (N * p - 1.0) / (2.0 * p)
}

/// Returns the p from which on the largest value of f, at some k > 0, is not negative: Eq. (18).
pub(crate) fn touching() -> f64 {
    roots::bracket(1e-6, 1.0, |p| top(p) > 0.0 && jump::f(VERTICES, p, top(p)) >= 0.0)[1]
}

/// Returns the p and real k of a stationary inflexion of Φ with Γ functions: its logarithm has the
/// derivative ln p − 1/k + ψ(N + 1 − k), zero twice in k where 1/k² = ψ′(N + 1 − k).
pub(crate) fn flat() -> [f64; 2] {
    let k = roots::bracket(1.0, N / 2.0, |k| 1.0 / (k * k) <= pxfm::f_trigamma(N + 1.0 - k))[1];
    [pxfm::f_exp(1.0 / k - pxfm::f_digamma(N + 1.0 - k)), k]
}

/// Returns dμ/dp twice: as Var(X)/p, for weights in proportion to p^k, and by a central difference.
pub(crate) fn mean_slopes(p: f64) -> [f64; 2] {
    let mean = law(Simple, p).mean();
    let squares = (1..).map(f64::from).map(|k: f64| (k - mean) * (k - mean));
    let variance: f64 = squares.zip(law(Simple, p).probabilities()).map(|(x, q)| q * x).sum();
    let step = 1e-5 * p;
    [variance / p, (law(Simple, p + step).mean() - law(Simple, p - step).mean()) / (2.0 * step)]
}
