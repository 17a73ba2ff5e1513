//! Circuits of all orders, by draws: a word of length L is L draws with replacement, and its number of
//! different letters that of the draws (no Stirling numbers).

use super::model::{Known, Law, log_simple, over_simple};
use super::{Guard, Look, far, unless};
use pxfm::{f_exp, f_log, f_log1p};
use std::sync::Arc;

pub const GUARDS: &[Guard] = &[
    Guard { name: "jumps_of_orders", ids: &["orders.*"], find: jumps },
    Guard {
        name: "jump_of_all_orders",
        ids: &["all_p_jump", "all_k_after", "all_before_pole", "all_ends", "orders_pole"],
        find: jump,
    },
    Guard {
        name: "pole_below_p_crit",
        ids: &["orders_pole", "p_crit", "diverges_at_jump", "diverges_at_large_p"],
        find: pole,
    },
    Guard {
        name: "five_of_all_orders",
        ids: &["five_at_jump", "four_visits_of_third", "beyond_five", "whole_at_jump"],
        find: five,
    },
];

/// Higher orders than any that is added.
const MOST: usize = 10_000;

/// The Möbius function.
fn moebius(n: usize) -> f64 {
    let (mut rest, mut sign) = (n, 1.0);
    for prime in 2..=n {
        if rest.is_multiple_of(prime) {
            rest /= prime;
            if rest.is_multiple_of(prime) {
                return 0.0;
            }
            sign = -sign;
        }
    }
    sign
}

/// Weights of k = 1..=N of all primitive circuits with at most so many edges more than k; of all of them
/// for p N < 1.
fn weights(big_n: usize, p: f64, most: Option<usize>) -> Arc<Vec<f64>> {
    let most = most.map(|most| most.min(MOST));
    static KNOWN: Known<(usize, u64, Option<usize>), Arc<Vec<f64>>> = Known::new();
    KNOWN.get((big_n, p.to_bits(), most), || Arc::new(by_draws(big_n, p, most)))
}

/// Draws after which one of N letters is missing with a chance below e^−45 N.
fn enough(big_n: usize) -> usize {
    45 * big_n
}

fn by_draws(big_n: usize, p: f64, most: Option<usize>) -> Vec<f64> {
    let real = big_n as f64;
    let longest = most.map_or(enough(big_n), |most| big_n + most);
    let mut seen = vec![0.0; big_n + 1];
    seen[0] = 1.0;
    let mut weights = vec![0.0; big_n];
    // Of words repeated d times, (N p^d)^m/(d m) with m draws; for d ≥ 2 few draws matter.
    let powers: Vec<(usize, f64)> = (1..=60)
        .scan(1.0, |power, d| {
            *power *= p;
            Some((d, *power * real))
        })
        .filter(|(d, ratio)| moebius(*d) != 0.0 && *ratio > 1e-30)
        .collect();
    let mut terms: Vec<f64> = vec![1.0; powers.len()];
    for draws in 1..=longest {
        for k in (1..=big_n).rev() {
            seen[k] = (k as f64 * seen[k] + (big_n + 1 - k) as f64 * seen[k - 1]) / real;
        }
        seen[0] = 0.0;
        for ((d, ratio), term) in powers.iter().zip(&mut terms) {
            *term *= ratio;
            if *term < 1e-40 {
                continue;
            }
            let length = d * draws;
            let share = moebius(*d) * *term / length as f64;
            let shortest = most.map_or(1, |most| length.saturating_sub(most)).max(1);
            for k in shortest..=draws.min(big_n) {
                weights[k - 1] += share * seen[k];
            }
        }
    }
    // Longer words use all letters, and each length adds (N p)^L/L.
    let ratio = real * p;
    let (mut left, mut power) = (-f_log1p(-ratio), 1.0);
    for length in 1..=longest {
        power *= ratio;
        left -= power / length as f64;
    }
    // At most this much, so that a difference of rounding is not taken for a rest.
    let most_left = power * ratio / (1.0 - ratio);
    if most.is_none() && most_left > 1e-18 * weights[big_n - 1] {
        weights[big_n - 1] += left;
    }
    weights
}

/// With each order, the peak weighs as much as k = 1 where k* is said to jump.
fn jumps(look: Look<'_>) -> Option<String> {
    let theory = &look.results.theory;
    (0..theory.orders.jumps.len()).find_map(|i| {
        let [most, p, k] = ["e", "p", "k"].map(|name| look.number(&format!("orders.{name}{i}")));
        let (most, p, k) = (most?, p?, k?);
        if most < 0.0 {
            return Some(format!("orders.e{i} is {most}"));
        }
        level(&weights(theory.vertices, p, Some(most as usize)), k, &format!("orders.p{i}"))
    })
}

fn level(weights: &[f64], k: f64, name: &str) -> Option<String> {
    let peak = (2..=weights.len()).max_by(|a, b| weights[a - 1].total_cmp(&weights[b - 1]))?;
    far(&format!("the weight of the peak at {name}"), weights[peak - 1], weights[0])
        .or_else(|| far(&format!("the peak at {name}"), k, peak as f64))
}

/// The same with all orders, before the pole by the share that is given.
fn jump(look: Look<'_>) -> Option<String> {
    let big_n = look.results.theory.vertices;
    let (p, pole) = (look.number("all_p_jump")?, look.number("orders_pole")?);
    if !(p > 0.0 && p < pole && p * (big_n as f64) < 1.0) {
        return Some(format!("all orders jump at {p}, beyond the pole {pole}"));
    }
    let weights = weights(big_n, p, None);
    level(&weights, look.number("all_k_after")?, "all_p_jump")
        .or_else(|| far("all_p_jump", p, pole * (1.0 - look.number("all_before_pole")?)))
        .or_else(|| look.is("all_ends", weights[0] / weights.iter().sum::<f64>()))
}

/// N times the pole is one; p_crit, which the double zero of Eq. (12) fixes, lies above it. K p passes one
/// where the circuits with K different vertices are said to diverge.
fn pole(look: Look<'_>) -> Option<String> {
    let theory = &look.results.theory;
    let pole = look.number("orders_pole")?;
    let [crit, jump] = ["p_crit", "p_jump"].map(|id| look.number(id));
    let passes = |id: &str, p: f64| {
        let k = look.number(id)?;
        unless(k * p >= 1.0 && (k - 1.0) * p < 1.0, || {
            format!("K p does not pass one at {id} = {k}")
        })
    };
    far("N times the pole", pole * theory.vertices as f64, 1.0)
        .or_else(|| unless(pole < crit? && crit? < jump?, || "the pole is not below p_crit".into()))
        .or_else(|| passes("diverges_at_jump", jump?))
        .or_else(|| passes("diverges_at_large_p", theory.higher.last()?.p))
}

/// Weights of the five classes, by sequences, over those of all circuits, by draws: with k different
/// vertices, and altogether. Of circuits with three edges more the ways to visit are one vertex
/// four times, one three times and another twice, three twice.
fn five(look: Look<'_>) -> Option<String> {
    let theory = &look.results.theory;
    let big_n = theory.vertices;
    let classes: [&[usize]; 5] = [&[], &[2], &[3], &[4], &[2, 2]];
    let of_five = |k: usize, p: f64| classes.iter().map(|c| over_simple(c, k, p)).sum::<f64>();
    let at_k = |k: usize, p: f64| {
        if k == 0 || p * k as f64 >= 1.0 {
            return f64::NAN;
        }
        let simple = f_exp(log_simple(k, k) + k as f64 * f_log(p));
        of_five(k, p) * simple / weights(k, p, None)[k - 1]
    };
    let whole = |p: f64| {
        // Probabilities of five classes over that of k = 1, whose only circuit is its loop.
        let law = Law::new(big_n, p, true).whole();
        let loops = big_n as f64 * p;
        loops / law[0] / weights(big_n, p, None).iter().sum::<f64>()
    };
    let k = look.number("k_after_jump")? as usize;
    // Two kinds of visits can go to a pair of vertices in two ways.
    let third = [(1.0, &[4][..]), (2.0, &[3, 2]), (1.0, &[2, 2, 2])];
    let third = third.map(|(ways, class)| ways * over_simple(class, k, 1.0));
    look.are([
        ("five_at_jump", at_k(k, look.number("p_jump")?)),
        ("four_visits_of_third", third[0] / third.iter().sum::<f64>()),
        ("whole_at_jump", whole(look.number("all_p_jump")?)),
    ])
    .or_else(|| {
        let rest = 1.0 - look.number("beyond_five")?;
        far("the share that beyond_five leaves", rest, whole(theory.higher.first()?.p))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// N = 2 by hand: loops 2p; ab p², aab and abb p³, aaab, aabb and abbb p⁴.
    #[test]
    fn draws_count_circuits() {
        let p = 0.1;
        let found = by_draws(2, p, Some(2));
        assert!((found[0] - 2.0 * p).abs() < 1e-15);
        assert!((found[1] - (p * p + 2.0 * p * p * p + 3.0 * p * p * p * p)).abs() < 1e-15);
        // All of them: one less the product over circuits, as a logarithm.
        let all: f64 = by_draws(2, p, None).iter().sum();
        let product: f64 = (1..40)
            .map(|d| -moebius(d) / d as f64 * f_log1p(-2.0 * (0..d).fold(1.0, |w, _| w * p)))
            .sum();
        assert!((all - product).abs() < 1e-15 && (by_draws(1, p, None)[0] - p).abs() < 1e-18);
    }
}
