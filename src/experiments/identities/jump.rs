//! The distribution and its jump, Secs. 6 and 7: identities, signs, zeros and slopes.

use super::Cases;
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::{Error, jump};
use impact_numerics::bisection;

/// The p of Figs. 8 to 14, and some beyond.
const GRID: [f64; 10] = [0.001, 0.005, 0.01, 0.012, 0.015, 0.02, 0.04, 0.1, 0.5, 1.0];

pub(super) fn normalisation(n: usize) -> Result<f64, Error> {
    let mut largest = 0.0_f64;
    for p in GRID {
        let sum: f64 = Law::new(SampleSpace::Simple, n, p)?.probabilities().iter().sum();
        largest = largest.max((sum - 1.0).abs());
    }
    Ok(largest)
}

pub(super) fn eq11(n: usize) -> Result<Cases, Error> {
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

pub(super) fn eq13(n: usize) -> f64 {
    let mut largest = 0.0_f64;
    for p in GRID {
        for k in jump::zeros(n, p).into_iter().flatten() {
            largest = largest.max(jump::f(n, p, k).abs() / size(n, p, k));
        }
    }
    largest
}

pub(super) fn ends(n: usize) -> f64 {
    let at = |p, k| jump::f(n, p, k);
    GRID.into_iter()
        .flat_map(|p| [at(p, 0.0) + 1.0, at(p, n as f64) / (n as f64 + 1.0) + 1.0])
        .fold(0.0, |a, b| a.max(b.abs()))
}

pub(super) fn slopes(n: usize) -> Cases {
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

pub(crate) fn touching(n: usize) -> f64 {
    // f has real zeros for k > 0 where its largest value, at k = (N p − 1)/2p, is not negative.
    let top = |p: f64| {
        let k = (n as f64 * p - 1.0) / (2.0 * p);
        k > 0.0 && jump::f(n, p, k) >= 0.0
    };
    bisection::bracket(1e-6, 1.0, top)[1]
}

pub(super) fn monotone(n: usize, from: f64) -> Result<Cases, Error> {
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

/// The size of the terms of f at k.
fn size(n: usize, p: f64, k: f64) -> f64 {
    [p * k * k, (n as f64 * p - 1.0) * k, 1.0].iter().fold(0.0, |a, b| b.abs().max(a))
}

/// A parabola is even about the place of its largest value.
pub(super) fn maximum(n: usize) -> f64 {
    let mut largest = 0.0_f64;
    for p in GRID {
        let top = (n as f64 * p - 1.0) / (2.0 * p);
        for away in [0.5, 3.0, 40.0] {
            let difference = jump::f(n, p, top + away) - jump::f(n, p, top - away);
            let terms = size(n, p, top + away).max(size(n, p, top - away));
            largest = largest.max(difference.abs() / terms);
        }
    }
    largest
}

/// p = ((1 − √(N + 1))/N)², where f has a double zero too.
pub(super) fn other_root() -> Cases {
    let mut cases = Cases::default();
    for n in 1..=1000 {
        let root = (1.0 - f64::from(n + 1).sqrt()) / f64::from(n);
        let p = root * root;
        let slope = f64::from(n) * p - 1.0;
        let touches = (slope * slope - 4.0 * p).abs() < 1e-13;
        cases.see(touches && slope / (2.0 * p) < 0.0);
    }
    cases
}

/// The weights themselves around ⌈k₋⌉ and ⌈k₊⌉; at the ends of 1..=N one neighbour is enough.
pub(super) fn extrema(n: usize) -> Result<Cases, Error> {
    let mut cases = Cases::default();
    let first = jump::first_local_maximum(n).map_or(1.0, |(_, [a, b])| a as f64 / b as f64);
    // At the first p itself a minimum and a maximum are level.
    for i in 1..=200 {
        let p = first * pxfm::f_exp(-pxfm::f_log(first) * f64::from(i) / 200.0);
        let law = Law::new(SampleSpace::Simple, n, p.min(1.0))?;
        let Some(zeros) = jump::zeros(n, p.min(1.0)) else {
            cases.see(false);
            continue;
        };
        let [low, high] = zeros.map(|k| (k.ceil() as usize).clamp(1, n));
        let neighbours = |k: usize| [k - 1, k + 1].into_iter().filter(|&k| k >= 1 && k <= n);
        for other in neighbours(low) {
            cases.see(law.weight(other)? >= law.weight(low)?);
        }
        for other in neighbours(high) {
            cases.see(law.weight(other)? <= law.weight(high)?);
        }
    }
    Ok(cases)
}

/// With a double zero f is −p (k − k_touch)²: Φ flattens there and falls on both sides.
pub(super) fn inflexion(n: usize, crit: f64) -> f64 {
    let touch = (n as f64 * crit - 1.0) / (2.0 * crit);
    (1..=n).fold(0.0, |largest: f64, k| {
        let k = k as f64;
        let difference = jump::f(n, crit, k) + crit * (k - touch) * (k - touch);
        largest.max(difference.abs() / size(n, crit, k))
    })
}

pub(super) fn falling(n: usize, crit: f64) -> Cases {
    let mut cases = Cases::default();
    for i in 1..=100 {
        for k in 1..n {
            cases.see(jump::f(n, crit * f64::from(i) / 100.0, k as f64) < 0.0);
        }
    }
    cases
}

/// dμ/dp = Var(X)/p for weights in proportion to p^k, and by a central difference.
pub(super) fn mean_slopes(n: usize, p: f64) -> Result<[f64; 2], Error> {
    let law = Law::new(SampleSpace::Simple, n, p)?;
    let mean = law.mean();
    let variance: f64 = (1_u32..)
        .zip(law.probabilities())
        .map(|(k, q)| q * (f64::from(k) - mean) * (f64::from(k) - mean))
        .sum();
    let step = 1e-5 * p;
    let at = |p| Ok::<_, Error>(Law::new(SampleSpace::Simple, n, p)?.mean());
    Ok([variance / p, (at(p + step)? - at(p - step)?) / (2.0 * step)])
}
