//! The theory for many vertices, by logarithms of the gamma function and by ratios of Eq. (10).

use super::model::{self, Known, log_simple};
use super::{Guard, Look, far, unless};
use crate::experiments::theory::{LargeJump, PoissonCell};
use pxfm::{f_exp, f_log};

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "jump_at_large_n",
        ids: &["large_n", "large_k_jump", "large_share", "small_share", "large_p_n"],
        find: jump,
    },
    Guard { name: "bounds_of_large_jumps", ids: &["large_k_jump"], find: bounds },
    Guard { name: "rule_of_large_jumps", ids: &["large_rule"], find: rule },
    Guard { name: "limit_of_mode", ids: &["large_n"], find: limit },
    Guard { name: "sigma_of_large_jump", ids: &["large_sigma_jump"], find: sigma },
    Guard {
        name: "distances_from_poisson",
        ids: &["poisson.*", "large_mean_at", "large_mean_gap"],
        find: poisson,
    },
    Guard { name: "distances_are_bounded", ids: &["poisson.d*", "poisson.l*"], find: bounded },
];

/// More vertices than any theory here is for.
const MOST: usize = 100_000_000;

/// The jump as the results have it, with the numbers that the text shows in their place.
fn shown(look: Look<'_>) -> Option<LargeJump> {
    let last = *look.results.theory.large.jumps.last()?;
    Some(LargeJump {
        vertices: look.number("large_n")? as usize,
        k_after: look.number("large_k_jump")? as usize,
        p_n: look.number("large_p_n")?,
        share: look.number("large_share")?,
        rule: look.number("large_rule"),
        ..last
    })
}

/// At p_jump circuits of k* and of one vertex weigh the same, by logarithms, and k* is where Eq. (12) changes its
/// sign: p k (N − k) > k + 1 below it, and not at it.
fn jump(look: Look<'_>) -> Option<String> {
    let LargeJump { vertices, k_after: k, p_n, share, .. } = shown(look)?;
    let big_n = vertices as f64;
    if !(2..=vertices).contains(&k) || vertices > MOST {
        return Some(format!("the jump leads to {k} of {vertices} vertices"));
    }
    let log_p = (log_simple(vertices, 1) - log_simple(vertices, k)) / (k - 1) as f64;
    let rises = |k: usize| p_n / big_n * (k * (vertices - k)) as f64 > (k + 1) as f64;
    far("large_p_n", p_n, big_n * f_exp(log_p))
        .or_else(|| {
            unless(rises(k - 1) && !rises(k), || format!("{k} is no peak at N = {vertices}"))
        })
        .or_else(|| far("large_share", share * big_n, k as f64))
        .or_else(|| {
            let theory = &look.results.theory;
            let small = look.number("small_share")? * theory.vertices as f64;
            far("small_share times N", small, theory.scalars.k_after_jump as f64)
        })
}

/// With ψ(k) = ln k − 1, every jump has k (k − 1) ≥ 2 (N − k)(ψ(k) + 1/k), and for m = k − 1
/// m (m − 1) ≤ 2 N (ψ(m) + 3/(2m)): Φ(j) = Φ(1) comes later for j = k ± 1. No constant is chosen.
fn bounds(look: Look<'_>) -> Option<String> {
    let psi = |k: f64| f_log(k) - 1.0;
    let jumps = look.results.theory.large.jumps.iter().copied();
    jumps.chain(shown(look)).find_map(|own| {
        let (big_n, k) = (own.vertices as f64, own.k_after as f64);
        let m = k - 1.0;
        let low = k * m >= 2.0 * (big_n - k) * (psi(k) + 1.0 / k);
        let high = m * (m - 1.0) <= 2.0 * big_n * (psi(m) + 1.5 / m);
        unless(low && high, || format!("a jump to {k} at N = {big_n} is out of its bounds"))
    })
}

/// The rule is the root of h(k) = k² − 2 N (ln k − 1), and k* is near it: its bounds leave h(k*) between
/// −2 k (ln k − 1) and 3 k + 3 N/(k − 1), and the slope of h, 2 k − 2 N/k, rises.
fn rule(look: Look<'_>) -> Option<String> {
    let jumps = look.results.theory.large.jumps.iter().copied();
    jumps.chain(shown(look)).find_map(|own| {
        let (big_n, k) = (own.vertices as f64, own.k_after as f64);
        let root = own.rule?;
        let width = (2.0 * k * (f_log(k) - 1.0)).max(3.0 * k + 3.0 * big_n / (k - 1.0));
        let slope = 2.0 * (k.min(root) - big_n / k.min(root));
        far("the square of a rule", root * root, 2.0 * big_n * (f_log(root) - 1.0)).or_else(|| {
            let near = slope > 0.0 && (root - k).abs() * slope <= width;
            unless(near, || format!("the rule {root} is too far from {k} at N = {big_n}"))
        })
    })
}

/// Beyond the jump k* = ⌈k₊⌉ and N − k₊ = (1 + 1/k₊)/p, so k* is N − 1/p but for less than one above and
/// 1/(p (k* − 1)) below; before it k* = 1.
fn limit(look: Look<'_>) -> Option<String> {
    let large = &look.results.theory.large;
    large.shares.iter().find_map(|own| {
        let big_n = own.vertices as f64;
        let jump = large.jumps.iter().find(|jump| jump.vertices == own.vertices)?;
        own.rows.iter().enumerate().find_map(|(i, row)| {
            let (k, x) = (row.y * big_n, row.x);
            let before =
                x < jump.p_n || (x == jump.p_n && own.rows[i + 1..].iter().any(|r| r.x == x));
            if before {
                return far("k* before the jump", k, 1.0);
            }
            let middle = big_n - big_n / x;
            let slack = super::ROUNDING * big_n;
            let inside = k < middle + 1.0 + slack && k > middle - big_n / (x * (k - 1.0)) - slack;
            unless(inside, || format!("k* is {k} at p N = {x}, N = {big_n}"))
        })
    })
}

/// The relation of p and σ, as an integral, has p_jump at this σ.
fn sigma(look: Look<'_>) -> Option<String> {
    let last = shown(look)?;
    let p = model::p(look.number("large_sigma_jump")?);
    far("p at large_sigma_jump", p, last.p_n / last.vertices as f64)
}

/// Distance of N − X from a Poisson variable with mean 1/p, and N − 1/p − μ: Eq. (10) by its ratios
/// p (N − k) k/(k + 1), a Poisson law by its own, each outwards from its peak.
fn distances(big_n: usize, p_n: f64) -> [f64; 2] {
    // A number that is wrong may be anything.
    if !(p_n > 1.0 && p_n <= big_n as f64) {
        return [f64::NAN; 2];
    }
    static KNOWN: Known<(usize, u64), [f64; 2]> = Known::new();
    KNOWN.get((big_n, p_n.to_bits()), || {
        let real = big_n as f64;
        let (p, mean) = (p_n / real, real / p_n);
        let middle = (real - mean).max(1.0) as usize;
        let reach = (12.0 * mean.sqrt()) as usize + 60;
        let (from, to) = (middle.saturating_sub(reach).max(1), (middle + reach).min(big_n));
        let own =
            outwards(from, to, middle, |k| p * (big_n - k) as f64 * k as f64 / (k + 1) as f64);
        // J = N − k rises as k falls; J may be N or more.
        let lowest = big_n - to;
        let poisson =
            outwards(lowest, big_n - from + reach, big_n - middle, |j| mean / (j + 1) as f64);
        let of = |k: usize| poisson.get(big_n - k - lowest).copied().unwrap_or(0.0);
        let mut apart = 0.0;
        let mut left = 0.0;
        for (k, own) in (from..=to).zip(&own) {
            apart += (own - of(k)).abs();
            left += own * ((big_n - k) as f64 - mean);
        }
        let beyond: f64 = poisson.iter().skip(big_n - from - lowest + 1).sum();
        [0.5 * (apart + beyond), left]
    })
}

/// Probabilities on a range from the ratios of neighbours.
fn outwards(from: usize, to: usize, middle: usize, ratio: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut weights = vec![1.0; to - from + 1];
    for place in middle + 1..=to {
        weights[place - from] = weights[place - 1 - from] * ratio(place - 1);
    }
    for place in (from..middle).rev() {
        weights[place - from] = weights[place + 1 - from] / ratio(place);
    }
    let total: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= total);
    weights
}

/// The printed distances, their limits and the quoted mean.
fn poisson(look: Look<'_>) -> Option<String> {
    let large = &look.results.theory.large;
    let mut cells = large
        .poisson
        .iter()
        .enumerate()
        .flat_map(|(i, row)| (0..row.cells.len()).map(move |j| (i, j)));
    cells
        .find_map(|(i, j)| {
            let p_n = look.number(&format!("poisson.c{i}"))?;
            let big_n = look.number(&format!("poisson.n{j}"))?;
            let [distance, _] = distances(big_n as usize, p_n);
            look.is(&format!("poisson.d{i}_{j}"), distance)
        })
        .or_else(|| {
            let at = look.number("large_mean_at")?;
            let [_, gap] = distances(look.number("large_n")? as usize, at);
            // A mean of deviations, each known to rounding of N.
            let room = super::ROUNDING * look.number("large_n")?.sqrt();
            let found = look.number("large_mean_gap")?;
            unless((found - gap).abs() <= room, || format!("large_mean_gap is {found}, not {gap}"))
        })
}

/// No distance is above its bound by the moments of X, each falls with N, and √N times them goes to the
/// limit ½ E|Z| √c/(c − 1) for a standard normal Z: the differences from it fall with N as well.
fn bounded(look: Look<'_>) -> Option<String> {
    look.results.theory.large.poisson.iter().enumerate().find_map(|(i, row)| {
        let limit = look.number(&format!("poisson.l{i}"))?;
        let c = row.p_n;
        let half_normal = (2.0 / std::f64::consts::PI).sqrt();
        let off = |cell: &PoissonCell| {
            (cell.variation * (cell.vertices as f64).sqrt() / limit - 1.0).abs()
        };
        let falls = row.cells.windows(2).all(|w| w[1].variation < w[0].variation);
        let nears = row.cells.windows(2).all(|w| off(&w[1]) < off(&w[0]));
        let below = row.cells.iter().all(|cell| cell.variation <= cell.bound);
        far(&format!("poisson.l{i}"), limit, 0.5 * half_normal * c.sqrt() / (c - 1.0)).or_else(
            || {
                unless(falls && nears && below, || {
                    format!("distances at p N = {c} do not fall as they must")
                })
            },
        )
    })
}
