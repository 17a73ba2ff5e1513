//! Computes the distribution of the number of different impacts: Sec. 6, Figs. 8 and 9.

use super::basics::*;

pub(crate) fn law(space: SampleSpace, p: f64) -> Law {
    expect_known(Law::new(space, VERTICES, p))
}

pub fn simple(p: f64) -> Vec<f64> {
    law(Simple, p).probabilities()
}

pub fn k_star(p: f64) -> usize {
    law(Simple, p).k_star()
}

pub(super) fn distributions() -> Table {
    Table::builder("theory.distribution", &DISTRIBUTION_P, |_| 0)
        .key("p", "1", |p| *p)
        .real("mean", "1", 3, "μ", |p| law(Simple, *p).mean())
        .computed_by(origin(Law::mean), &["mean"])
        .count("k_star", "k*", |p| k_star(*p) as u64)
        .computed_by(origin(Law::k_star), &["k_star"])
        .done()
}

/// Returns each p at which k* changes, from p = 0 on, and its value from there: Fig. 9 (a).
pub fn steps() -> Vec<(f64, usize)> {
    let leap = expect_known(jump::p_jump(Simple, VERTICES));
    let later = (leap.k_after..VERTICES - 1).map(|k| (jump::step(VERTICES, k), k + 1));
    [(0.0, 1), (leap.p, leap.k_after)].into_iter().chain(later).collect()
}

/// Returns μ(p) of simple circuits, finer where it rises: Fig. 9 (b).
pub fn means() -> Vec<(f64, f64)> {
    let grid = Grid::default().and(0..=400, 10_000).and(9..=200, 200).values();
    grid.into_iter().map(|p| (p, law(Simple, p).mean())).collect()
}

pub(super) fn mean() -> Table {
    let mut heights: Vec<usize> = steps().windows(2).map(|w| w[1].1 - w[0].1).collect();
    heights.sort_unstable_by(|a, b| b.cmp(a));
    let (grid, means): (Vec<f64>, Vec<_>) =
        means().into_iter().map(|(p, mean)| (p, Some(mean))).unzip();
    let p_at = |share: f64| last_rise(&grid, &means, share * VERTICES as f64);
    one_row("theory.mean", origin(steps))
        .count("largest_step", "of k*", |()| heights[0] as u64)
        .count("other_steps", "the second largest step of k*", |()| heights[1] as u64)
        .real("at_zero", "1", 1, "μ for p → 0", |()| law(Simple, 0.0).mean())
        .real("at_one", "1", 2, "μ at p = 1", |()| law(Simple, 1.0).mean())
        .computed_by(origin(Law::mean), &["at_zero", "at_one"])
        .real("p_tenth", "1", 3, "p at which μ is N/10", |()| p_at(0.1))
        .real("p_nine_tenths", "1", 2, "p at which μ is 9 N/10", |()| p_at(0.9))
        .computed_by(origin(last_rise), &["p_tenth", "p_nine_tenths"])
        .done()
}
