//! The theory for many vertices: Fig. S6.

use super::Point;
use super::jump::sigma_of;
use crate::params::{DRAWN_VERTICES, Grid, LARGE_VERTICES};
use impact_circuits::distribution::SampleSpace;
use impact_circuits::large::{jump_rule, limit_share};
use impact_circuits::{Error, jump};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// What becomes of Secs. 6 and 7 as N grows with p N held fixed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Large {
    /// The jump of k* at several N, rising.
    pub jumps: Vec<LargeJump>,
    /// k*/N against p N.
    pub shares: Vec<LargeShares>,
    /// The limit of k*/N against p N.
    pub limit: Vec<Point>,
    /// σ at which p(σ) is p_jump of the largest N.
    pub sigma_jump: f64,
}

/// The jump for one N.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LargeJump {
    /// Number of vertices N.
    pub vertices: usize,
    /// p_jump.
    pub p: f64,
    /// N p_jump.
    pub p_n: f64,
    /// k* just after it.
    pub k_after: usize,
    /// k*/N just after it.
    pub share: f64,
    /// The root of k² = 2 N (ln k − 1), for N > e³.
    pub rule: Option<f64>,
}

/// k*/N against p N for one N.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LargeShares {
    /// Number of vertices N.
    pub vertices: usize,
    /// The points; at the jump there are two.
    pub rows: Vec<Point>,
}

/// So many steps of k* between two values of p N are drawn one by one.
const FEW: usize = 3;

/// Values of p N that are drawn.
fn drawn() -> Vec<f64> {
    Grid::default().and(0, 500, 1, 200).values()
}

/// All of it.
pub fn large() -> Result<Large, Error> {
    let jumps = LARGE_VERTICES.into_par_iter().map(jump_at).collect::<Result<Vec<_>, _>>()?;
    let sigma_jump = jumps.last().map_or(0.0, |last| sigma_of(last.p));
    let known = jumps.iter().filter(|jump| DRAWN_VERTICES.contains(&jump.vertices));
    let limit = drawn().into_iter().map(|x| Point { x, y: limit_share(x) });
    Ok(Large { shares: known.map(shares).collect(), jumps, limit: limit.collect(), sigma_jump })
}

fn jump_at(vertices: usize) -> Result<LargeJump, Error> {
    let found = jump::p_jump(SampleSpace::Simple, vertices)?;
    Ok(LargeJump {
        vertices,
        p: found.p,
        p_n: found.p * vertices as f64,
        k_after: found.k_after,
        share: found.k_after as f64 / vertices as f64,
        rule: jump_rule(vertices),
    })
}

/// k* is 1 up to the jump and the local maximum beyond it, since Φ(k)/Φ(1) rises with p.
fn shares(found: &LargeJump) -> LargeShares {
    let big_n = found.vertices as f64;
    let point = |x: f64, k: usize| Point { x, y: k as f64 / big_n };
    let (before, after): (Vec<f64>, Vec<f64>) = drawn().into_iter().partition(|x| *x <= found.p_n);
    let mut rows: Vec<Point> = before.into_iter().map(|x| point(x, 1)).collect();
    rows.extend([point(found.p_n, 1), point(found.p_n, found.k_after)]);
    let mut level = found.k_after;
    for x in after {
        let k = jump::local_maximum(found.vertices, x / big_n).max(found.k_after);
        // Few steps are drawn as steps; where there are many they cannot be seen.
        if k - level <= FEW {
            let steps = (level..k).map(|k| (big_n * jump::step(found.vertices, k), k));
            rows.extend(steps.flat_map(|(x, k)| [point(x, k), point(x, k + 1)]));
        }
        rows.push(point(x, k));
        level = k;
    }
    LargeShares { vertices: found.vertices, rows }
}
