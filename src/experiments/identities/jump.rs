//! Checks the distribution and its jump, Secs. 6 and 7: identities, signs, zeros and slopes.

use crate::experiments::theory::basics::*;
use crate::experiments::theory::jump::top;
use crate::experiments::theory::law::law;
use impact_numerics::scaled::Scaled;

/// The p of Figs. 8 to 14, and some beyond.
const GRID: [f64; 10] = [0.001, 0.005, 0.01, 0.012, 0.015, 0.02, 0.04, 0.1, 0.5, 1.0];

const N: f64 = VERTICES as f64;

fn simple(p: f64) -> Law {
    law(Simple, p)
}

/// Returns Φ(k)/p for k = 1..=N.
fn weights(p: f64) -> Vec<Scaled> {
    simple(p).all_weights().collect()
}

fn f(p: f64, k: f64) -> f64 {
    jump::f(VERTICES, p, k)
}

fn size(p: f64, k: f64) -> f64 {
    largest([p * k * k, ((N * p - 1.0) * k).abs(), 1.0])
}

pub(super) fn mean_rises() -> Cases {
    let means: Vec<f64> = (0..=200).map(|i| simple(f64::from(i) / 200.0).mean()).collect();
    cases(means.windows(2).map(|w| w[1] >= w[0]))
}

/// Compares the sign of the difference of neighbouring weights with the sign of f, Eq. (11).
pub(super) fn eq11() -> Cases {
    let mut agree = Vec::new();
    for p in GRID {
        for (pair, k) in weights(p).windows(2).zip(1_u32..) {
            agree.push(pair[1].partial_cmp(&pair[0]) == f(p, k.into()).partial_cmp(&0.0));
        }
    }
    cases(agree)
}

/// Returns |f(k±)| over the largest of its three terms, Eq. (13).
pub(super) fn eq13() -> f64 {
    let zeros = |p| jump::zeros(VERTICES, p).into_iter().flatten().map(move |k| (p, k));
    largest(GRID.into_iter().flat_map(zeros).map(|(p, k)| f(p, k).abs() / size(p, k)))
}

/// Checks the signs in Eqs. (16) and (17), and the slope by a difference: f is linear in p.
pub(super) fn slopes() -> Cases {
    let mut agree = Vec::new();
    for k in (1..VERTICES).map(|k| k as f64) {
        let slope = f(1.0, k) - f(0.0, k);
        agree.push(f(0.0, k) == -(k + 1.0));
        agree.push(slope > 0.0 && (slope / (k * (N - k)) - 1.0).abs() < 1e-14);
    }
    cases(agree)
}

pub(super) fn monotone() -> Cases {
    let from = expect_known(jump::p_jump(Simple, VERTICES)).bracket[1];
    let p = |i: i32| (from + (1.0 - from) * f64::from(i) / 1000.0).min(1.0);
    let modes = Vec::from_iter([1].into_iter().chain((0..=1000).map(|i| simple(p(i)).k_star())));
    cases(modes.windows(2).map(|w| w[1] >= w[0]))
}

/// Returns the difference of f on both sides of its maximum, relative; zero by Eq. (12).
pub(super) fn maximum() -> f64 {
    let pairs = |p| [0.5, 3.0, 40.0].map(|away| (p, top(p) + away, top(p) - away));
    let off = |(p, a, b)| (f(p, a) - f(p, b)).abs() / size(p, a).max(size(p, b));
    largest(GRID.into_iter().flat_map(pairs).map(off))
}

/// Checks that f has another double zero, at p = ((1 − √(N + 1))/N)² and k < 0, for N = 1..=1000.
pub(super) fn other_root() -> Cases {
    cases((1..=1000).map(f64::from).map(|n| {
        let root = (1.0 - (n + 1.0).sqrt()) / n;
        let (p, slope) = (root * root, n * root * root - 1.0);
        (slope * slope - 4.0 * p).abs() < 1e-13 && slope / (2.0 * p) < 0.0
    }))
}

/// Compares the weights at ⌈k₋⌉ and ⌈k₊⌉ with their neighbours in 1..=N, at p up to one.
pub(super) fn extrema() -> Cases {
    let first = jump::first_local_maximum(VERTICES).map_or(1.0, |(_, [a, b])| a as f64 / b as f64);
    let mut agree = Vec::new();
    // At the first p itself a minimum and a maximum are level.
    for i in 1..=200 {
        let p = (first * pxfm::f_exp(-pxfm::f_log(first) * f64::from(i) / 200.0)).min(1.0);
        let (weights, zeros) = (weights(p), jump::zeros(VERTICES, p).expect("f has zeros there"));
        let [low, high] = zeros.map(|k| (k.ceil() as usize).clamp(1, VERTICES) - 1);
        for step in [-1, 1] {
            let near = |at: usize| weights.get(at.checked_add_signed(step)?);
            agree.extend(near(low).map(|weight| *weight >= weights[low]));
            agree.extend(near(high).map(|weight| *weight <= weights[high]));
        }
    }
    cases(agree)
}

/// Returns the relative distance of f at p_crit from −p (k − k_touch)², with a double zero.
pub(super) fn inflexion() -> f64 {
    let p = expect_known(jump::p_crit(VERTICES));
    let off = |k: f64| (f(p, k) + p * (k - top(p)) * (k - top(p))).abs() / size(p, k);
    largest((1..=VERTICES).map(|k| off(k as f64)))
}

/// Checks that f is positive at some p ≤ 1 for each k between the ends, Eq. (17).
pub(super) fn through_zero() -> Cases {
    cases((1..VERTICES).map(|k| f(1.0, k as f64) > 0.0))
}

/// Checks that Φ(k) > Φ(k + 1) at every p of a grid from above 0 to p_crit, included.
pub(super) fn falling() -> Cases {
    let crit = expect_known(jump::p_crit(VERTICES));
    let steps = (1..=100).flat_map(|i| (1..VERTICES).map(move |k| (f64::from(i), k as f64)));
    cases(steps.map(|(i, k)| f(crit * i / 100.0, k) < 0.0))
}
