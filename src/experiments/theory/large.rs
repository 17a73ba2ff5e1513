//! Computes the theory for many vertices, with p N held fixed as N grows: Fig. S6.

use super::basics::*;
use impact_circuits::jump::{jump_rule, limit_share};

/// At most this many steps of k* between two values of p N are drawn one by one.
const FEW: usize = 3;

fn drawn() -> Vec<f64> {
    Grid::default().and(0..=500, 200).values()
}

pub(super) fn large() -> Table {
    let jump = |vertices| (vertices as f64, expect_known(p_jump(Simple, vertices)));
    let jumps: Vec<(f64, Jump)> = params::LARGE_VERTICES.into_par_iter().map(jump).collect();
    Table::builder("theory.large", &jumps, |_| 0)
        .key("n", "1", |(n, _)| *n)
        .real("vertices", "1", 1, "N", |(n, _)| *n)
        .real("share", "1", 2, "k*/N after the jump", |(n, jump)| jump.k_after as f64 / n)
        .computed_by(origin(p_jump), &["share"])
        .real("rule", "1", 4, "root of k² = 2 N (ln k − 1)", |(n, _)| jump_rule(*n as usize))
        .computed_by(origin(jump_rule), &["rule"])
        .done()
}

pub fn limit() -> Vec<(f64, f64)> {
    drawn().into_iter().map(|x| (x, limit_share(x))).collect()
}

/// Returns k*/N against p N: 1 before the jump, the local maximum beyond.
pub fn shares(vertices: usize) -> [Vec<(f64, f64)>; 2] {
    let leap = expect_known(p_jump(Simple, vertices));
    let (big_n, at) = (vertices as f64, leap.p * vertices as f64);
    let point = |x: f64, k: usize| (x, k as f64 / big_n);
    let (before, after): (Vec<f64>, Vec<f64>) = drawn().into_iter().partition(|x| *x <= at);
    let before = before.into_iter().chain([at]).map(|x| point(x, 1)).collect();
    let (mut level, mut rows) = (leap.k_after, vec![point(at, leap.k_after)]);
    for x in after {
        let k = jump::local_maximum(vertices, x / big_n).max(leap.k_after);
        // A few steps are drawn as steps; many would not be visible.
        if k - level <= FEW {
            let steps = (level..k).map(|k| (big_n * jump::step(vertices, k), k));
            rows.extend(steps.flat_map(|(x, k)| [point(x, k), point(x, k + 1)]));
        }
        rows.push(point(x, k));
        level = k;
    }
    [before, rows]
}
