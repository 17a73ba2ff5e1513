//! The distribution and its jump, Secs. 6 and 7: identities, signs, zeros and slopes.

use super::{Cases, cases};
use impact_circuits::distribution::{Law, SampleSpace::Simple};
use impact_circuits::jump;
use impact_numerics::bisection;
use impact_numerics::scaled::Scaled;

/// The p of Figs. 8 to 14, and some beyond.
const GRID: [f64; 10] = [0.001, 0.005, 0.01, 0.012, 0.015, 0.02, 0.04, 0.1, 0.5, 1.0];

fn law(n: usize, p: f64) -> Law {
    Law::new(Simple, n, p).expect("N and p are in range")
}

/// Φ(k)/p for k = 1..=N.
fn weights(n: usize, p: f64) -> Vec<Scaled> {
    law(n, p).all_weights().collect()
}

fn p_crit(n: usize) -> f64 {
    jump::p_crit(n).expect("N is in range")
}

/// The largest of some numbers, zero at least.
fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, f64::max)
}

/// Eq. (9): largest distance of the sum of the probabilities from one.
pub(super) fn normalisation(n: usize) -> f64 {
    largest(GRID.map(|p| (law(n, p).probabilities().iter().sum::<f64>() - 1.0).abs()))
}

/// μ at neighbouring p of a grid of [0, 1].
pub(super) fn mean_rises(n: usize) -> Cases {
    let means: Vec<f64> = (0..=200).map(|i| law(n, f64::from(i) / 200.0).mean()).collect();
    cases(means.windows(2).map(|w| w[1] >= w[0]))
}

/// Eq. (11): sign of the difference of neighbouring weights against the sign of f.
pub(super) fn eq11(n: usize) -> Cases {
    cases(GRID.into_iter().flat_map(|p| {
        let weights = weights(n, p);
        (1..n).map(move |k| {
            let (here, next, f) = (weights[k - 1], weights[k], jump::f(n, p, k as f64));
            // A tie of the weights is a zero of f.
            (next > here) == (f > 0.0) && (next < here) == (f < 0.0)
        })
    }))
}

/// Eq. (13): |f(k±)| over the largest of its three terms.
pub(super) fn eq13(n: usize) -> f64 {
    let zeros = |p| jump::zeros(n, p).into_iter().flatten().map(move |k| (p, k));
    largest(GRID.into_iter().flat_map(zeros).map(|(p, k)| jump::f(n, p, k).abs() / size(n, p, k)))
}

/// Eqs. (14) and (15): relative deviation of f at the ends.
pub(super) fn ends(n: usize) -> f64 {
    let at = |p, k| jump::f(n, p, k);
    largest(
        GRID.into_iter().flat_map(|p| {
            [at(p, 0.0) + 1.0, at(p, n as f64) / (n as f64 + 1.0) + 1.0].map(f64::abs)
        }),
    )
}

/// Eqs. (16) and (17): signs, and the slope against a finite difference.
pub(super) fn slopes(n: usize) -> Cases {
    cases((1..n).flat_map(|k| {
        let k = k as f64;
        let none = jump::f(n, 0.0, k);
        // f is linear in p, so the difference over all of [0, 1] is the slope.
        let slope = jump::f(n, 1.0, k) - none;
        let positive = slope > 0.0 && (slope / (k * (n as f64 - k)) - 1.0).abs() < 1e-14;
        [none < 0.0 && none == -(k + 1.0), positive]
    }))
}

/// Eq. (18): the p at which the zeros of f appear. f has real zeros for k > 0 where its largest value, at
/// k = (N p − 1)/2p, is not negative.
pub(crate) fn touching(n: usize) -> f64 {
    let top = |p: f64| {
        let k = (n as f64 * p - 1.0) / (2.0 * p);
        k > 0.0 && jump::f(n, p, k) >= 0.0
    };
    bisection::bracket(1e-6, 1.0, top)[1]
}

/// k* at neighbouring p of a grid from just beyond the jump to one.
pub(super) fn monotone(n: usize) -> Cases {
    let from = jump::p_jump(Simple, n).map_or(1.0, |leap| leap.bracket[1]);
    let k_star = |i: i32| law(n, (from + (1.0 - from) * f64::from(i) / 1000.0).min(1.0)).k_star();
    let found: Vec<usize> = [1].into_iter().chain((0..=1000).map(k_star)).collect();
    cases(found.windows(2).map(|w| w[1] >= w[0]))
}

/// The size of the terms of f at k.
fn size(n: usize, p: f64, k: f64) -> f64 {
    largest([p * k * k, ((n as f64 * p - 1.0) * k).abs(), 1.0])
}

/// Eq. (12): f is even about the place of its largest value, (N p − 1)/2p: difference of both sides over the largest
/// of its terms.
pub(super) fn maximum(n: usize) -> f64 {
    largest(GRID.into_iter().flat_map(|p| {
        let top = (n as f64 * p - 1.0) / (2.0 * p);
        [0.5, 3.0, 40.0].map(|away| {
            let difference = jump::f(n, p, top + away) - jump::f(n, p, top - away);
            difference.abs() / size(n, p, top + away).max(size(n, p, top - away))
        })
    }))
}

/// p = ((1 − √(N + 1))/N)², N from 1 to 1000, where f has a double zero too, at k < 0.
pub(super) fn other_root() -> Cases {
    cases((1..=1000).map(|n| {
        let root = (1.0 - f64::from(n + 1).sqrt()) / f64::from(n);
        let p = root * root;
        let slope = f64::from(n) * p - 1.0;
        (slope * slope - 4.0 * p).abs() < 1e-13 && slope / (2.0 * p) < 0.0
    }))
}

/// The weights themselves around ⌈k₋⌉ and ⌈k₊⌉, at p from the first integer maximum to one; at the ends of 1..=N one
/// neighbour is enough.
pub(super) fn extrema(n: usize) -> Cases {
    let first = jump::first_local_maximum(n).map_or(1.0, |(_, [a, b])| a as f64 / b as f64);
    // At the first p itself a minimum and a maximum are level.
    cases((1..=200).flat_map(|i| {
        let p = (first * pxfm::f_exp(-pxfm::f_log(first) * f64::from(i) / 200.0)).min(1.0);
        let Some(zeros) = jump::zeros(n, p) else { return vec![false] };
        let weights = weights(n, p);
        let [low, high] = zeros.map(|k| (k.ceil() as usize).clamp(1, n));
        let around = |k: usize| [k - 1, k + 1].into_iter().filter(|&k| k >= 1 && k <= n);
        let above = around(low).map(|other| weights[other - 1] >= weights[low - 1]);
        let below = around(high).map(|other| weights[other - 1] <= weights[high - 1]);
        above.chain(below).collect()
    }))
}

/// At p_crit, with a double zero, f is −p (k − k_touch)²: Φ flattens there and falls on both sides. Distance of f from
/// it over the largest of its terms.
pub(super) fn inflexion(n: usize) -> f64 {
    let crit = p_crit(n);
    let touch = (n as f64 * crit - 1.0) / (2.0 * crit);
    largest((1..=n).map(|k| {
        let k = k as f64;
        let difference = jump::f(n, crit, k) + crit * (k - touch) * (k - touch);
        difference.abs() / size(n, crit, k)
    }))
}

/// Steps Φ(k) > Φ(k + 1) at every p of a grid from above 0 to p_crit, included.
pub(super) fn falling(n: usize) -> Cases {
    let at = |i: i32, k: usize| jump::f(n, p_crit(n) * f64::from(i) / 100.0, k as f64);
    cases((1..=100).flat_map(|i| (1..n).map(move |k| (i, k))).map(|(i, k)| at(i, k) < 0.0))
}

/// dμ/dp: Var(X)/p for weights in proportion to p^k, and by a central difference.
pub(crate) fn mean_slopes(n: usize, p: f64) -> [f64; 2] {
    let mean = law(n, p).mean();
    let variance: f64 = (1_u32..)
        .zip(law(n, p).probabilities())
        .map(|(k, q)| q * (f64::from(k) - mean) * (f64::from(k) - mean))
        .sum();
    let step = 1e-5 * p;
    [variance / p, (law(n, p + step).mean() - law(n, p - step).mean()) / (2.0 * step)]
}
