//! The number of different impacts and the jump of its most likely value: Secs. 6 and 7, Figs. 8 to 10.

use super::{known, one};
use crate::experiments::identities::jump::{flat, mean_slopes, top, touching};
use crate::experiments::prelude::*;
use crate::params::{DISTRIBUTION_P, Grid, VERTICES};
use impact_circuits::distribution::Law;
use impact_circuits::distribution::SampleSpace::{self, Simple};
use impact_circuits::{Fraction, jump};

pub(super) fn tables() -> Vec<Table> {
    vec![distributions(), mean(), jumping(), first_maximum()]
}

/// The distribution for the paper's N.
pub(crate) fn law(space: SampleSpace, p: f64) -> Law {
    known(Law::new(space, VERTICES, p))
}

/// P(X = k) of simple circuits, k = 1..=N.
pub fn simple(p: f64) -> Vec<f64> {
    law(Simple, p).probabilities()
}

/// k* of simple circuits.
pub fn k_star(p: f64) -> usize {
    law(Simple, p).k_star()
}

/// Fig. 8.
fn distributions() -> Table {
    Table::of("theory.distribution", &DISTRIBUTION_P, |_| 0)
        .computed_by(origin(Law::mean))
        .key("p", "1", |p| *p)
        .real("mean", "1", 3, "μ", |p| law(Simple, *p).mean())
        .computed_by(origin(Law::k_star))
        .count("k_star", "k*", |p| k_star(*p) as u64)
        .done()
}

/// Fig. 9 (a): each p at which k* changes, from p = 0 on, and its value from there.
pub fn steps() -> Vec<(f64, usize)> {
    let leap = known(jump::p_jump(Simple, VERTICES));
    let later = (leap.k_after..VERTICES - 1).map(|k| (jump::step(VERTICES, k), k + 1));
    [(0.0, 1), (leap.p, leap.k_after)].into_iter().chain(later).collect()
}

/// Fig. 9 (b): μ(p) of simple circuits, finer where it rises.
pub fn means() -> Vec<(f64, f64)> {
    let grid = Grid::default().and(0, 400, 1, 10_000).and(9, 200, 1, 200).values();
    grid.into_iter().map(|p| (p, law(Simple, p).mean())).collect()
}

/// The p at which μ passes `level`, linear between points.
fn crossing(means: &[(f64, f64)], level: f64) -> Option<f64> {
    let w = means.windows(2).find(|w| w[0].1 < level && level <= w[1].1)?;
    Some(w[0].0 + (w[1].0 - w[0].0) * (level - w[0].1) / (w[1].1 - w[0].1))
}

/// Fig. 9.
fn mean() -> Table {
    let mut heights: Vec<usize> = steps().windows(2).map(|w| w[1].1 - w[0].1).collect();
    heights.sort_unstable_by(|a, b| b.cmp(a));
    let means = means();
    let p_at = |share: f64| crossing(&means, share * VERTICES as f64).unwrap_or(1.0);
    one("theory.mean", origin(steps))
        .count("largest_step", "of k*", |()| heights[0] as u64)
        .count("other_steps", "the second largest step of k*", |()| heights[1] as u64)
        .computed_by(origin(Law::mean))
        .real("at_zero", "1", 1, "μ for p → 0", |()| means[0].1)
        .real("at_one", "1", 2, "μ at p = 1", |()| law(Simple, 1.0).mean())
        .computed_by(origin(crossing))
        .real("p_tenth", "1", 3, "p at which μ is N/10", |()| p_at(0.1))
        .real("p_nine_tenths", "1", 2, "p at which μ is 9 N/10", |()| p_at(0.9))
        .done()
}

/// Sec. 7.
fn jumping() -> Table {
    let p_crit = |vertices| known(jump::p_crit(vertices));
    let (crit, leap) = (p_crit(VERTICES), known(jump::p_jump(Simple, VERTICES)));
    let (at_one, between) = (law(Simple, 1.0), 0.5 * (crit + leap.bracket[0]));
    let [before, last] = [VERTICES - 1, VERTICES].map(|k| known(at_one.weight(k)));
    let [by_variance, by_difference] = mean_slopes(leap.p);
    one("theory.jump", origin(jump::p_crit))
        .real("p_crit", "1", 5, "Eq. (18)", |()| crit)
        .real("p_crit_walls", "1", 5, "the same for N + 1", |()| p_crit(VERTICES + 1))
        .real("k_touch", "1", 4, "double zero of f at p_crit", |()| top(crit))
        .computed_by(origin(touching))
        .real("p_crit_found", "1", 5, "where zeros of f appear, by bisection", |()| touching())
        .computed_by(origin(flat))
        .real("p_flat", "1", 6, "where Φ of real k has a stationary inflexion", |()| flat()[0])
        .real("k_flat", "1", 3, "its k", |()| flat()[1])
        .computed_by(origin(jump::p_jump))
        .real("p_jump", "1", 5, "p at which k* leaves 1", |()| leap.p)
        .count("k_after", "k* after it", |()| leap.k_after as u64)
        .real("after_crit", "1", 2, "p_jump/p_crit − 1", |()| leap.p / crit - 1.0)
        .computed_by(origin(Law::k_star))
        .count("k_at_zero", "k* for p → 0", |()| k_star(0.0) as u64)
        .count("k_at_crit", "k* at p_crit", |()| k_star(crit) as u64)
        .count("k_before", "k* half way from p_crit to p_jump", |()| k_star(between) as u64)
        .count("k_at_one", "k* at p = 1", |()| at_one.k_star() as u64)
        .computed_by(origin(Law::weight))
        .real("last_ratio", "1", 2, "Φ(N)/Φ(N − 1) at p = 1", |()| (last / before).to_f64())
        .computed_by(origin(mean_slopes))
        .real("slope", "1", 4, "dμ/dp at p_jump, by a difference", |()| by_difference)
        .real("variance_over_p", "1", 4, "Var(X)/p at p_jump", |()| by_variance)
        .done()
}

fn first_maximum() -> Table {
    let (k, [above, below]) =
        jump::first_local_maximum(VERTICES).expect("N = 100 has a local maximum");
    let p = Fraction::new(above as u128, below as u128);
    one("theory.first_maximum", origin(jump::first_local_maximum))
        .count("numerator", "of p", |()| p.numerator as u64)
        .count("denominator", "of p", |()| p.denominator as u64)
        .real("p", "1", 5, "where Φ first has a local maximum beyond k = 1", |()| p.to_f64())
        .count("k", "where it is", |()| k as u64)
        .count("k_next", "where it is as well", |()| k as u64 + 1)
        .done()
}

/// Fig. 10: p → 0, p_crit, half way from p_crit to the jump, and the jump itself.
pub fn stages() -> [f64; 4] {
    let (crit, leap) = (known(jump::p_crit(VERTICES)), known(jump::p_jump(Simple, VERTICES)).p);
    [0.0, crit, 0.5 * (crit + leap), leap]
}

/// f_{N,p}(k) on [0, N], four points to a unit of k.
pub fn f(p: f64) -> Vec<(f64, f64)> {
    let ks = (0..=VERTICES * 4).map(|i| i as f64 / 4.0);
    ks.map(|k| (k, jump::f(VERTICES, p, k))).collect()
}

/// The zeros of f_{N,p}. The double nearest to p_crit may lie on either side of it; there both are 1/√p.
pub fn zeros(p: f64) -> Option<[f64; 2]> {
    if p == known(jump::p_crit(VERTICES)) {
        return Some([1.0 / p.sqrt(); 2]);
    }
    jump::zeros(VERTICES, p)
}
