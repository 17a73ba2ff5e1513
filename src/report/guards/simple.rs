//! Secs. 5 to 7: simple circuits, their distribution and its jump, by logarithms.

use super::model::{Law, log_simple};
use super::{Guard, Look, far, unless};
use crate::params::{CONVERGENCE_P, DISTRIBUTION_P, HIGHER_P};
use pxfm::f_exp;

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "probabilities_printed",
        ids: &[
            "paper.fig8_p_*",
            "paper.fig13_p_*",
            "paper.fig14_p_*",
            "paper.vertices",
            "paper.graph_masses",
        ],
        find: printed,
    },
    Guard { name: "means_of_fig8", ids: &["mu_fig8_*", "mu_zero"], find: means },
    Guard { name: "levels_of_mean", ids: &["p_tenth", "p_nine_tenths"], find: levels },
    Guard {
        name: "shares_of_lengths",
        ids: &["fig7_share", "fig7_from", "fig7_peak", "eq8_exceptions"],
        find: lengths,
    },
    Guard { name: "double_zero", ids: &["p_crit", "p_crit_walls", "k_touch"], find: double_zero },
    Guard {
        name: "equal_weights_at_jump",
        ids: &["p_jump", "k_before_jump", "k_after_jump", "jump_after_crit"],
        find: jump,
    },
    Guard { name: "steps_of_mode", ids: &["fig9_large_step", "fig9_other_steps"], find: steps },
    Guard { name: "first_maximum", ids: &["first_maximum_*"], find: first_maximum },
];

/// What is computed for a figure of the paper is computed for the p that the paper names there, and
/// for its N.
fn printed(look: Look<'_>) -> Option<String> {
    let theory = &look.results.theory;
    let panels = |name: &'static str, letters: &'static str| {
        letters.chars().map(move |letter| format!("paper.{name}_p_{letter}"))
    };
    // Panels (a) and (b) of Fig. 13 have one p.
    let ids = panels("fig8", "abcd").chain(panels("fig13", "acd")).chain(panels("fig14", "ab"));
    let chosen = DISTRIBUTION_P.iter().chain(&HIGHER_P).chain(&CONVERGENCE_P);
    let graph = look.results.identities.graph_vertices;
    let mut pairs = ids.zip(chosen);
    pairs
        .find_map(|(id, p)| look.is(&id, *p))
        .or_else(|| look.is("paper.vertices", theory.vertices as f64))
        .or_else(|| look.is("paper.graph_masses", graph as f64 - 1.0))
}

/// μ is the mean of Eq. (9), and goes to one with p: loops at single vertices are left.
fn means(look: Look<'_>) -> Option<String> {
    let theory = &look.results.theory;
    let panels = ["a", "b", "c", "d"].into_iter().zip(&theory.distributions);
    let mut panels = panels.map(|(panel, found)| {
        (format!("mu_fig8_{panel}"), Law::new(theory.vertices, found.p, false).mean())
    });
    let tiny = ROOM_OF_LIMIT / theory.vertices as f64;
    panels
        .find_map(|(id, mean)| look.is(&id, mean))
        .or_else(|| look.is("mu_zero", Law::new(theory.vertices, tiny, false).mean()))
}

/// A p times N at which Eq. (9) is at its limit, up to what [`far`] allows.
const ROOM_OF_LIMIT: f64 = 1e-11;

/// μ passes a level where it is said to, to the last printed digit: it is lower one unit before, and
/// higher one unit later.
fn levels(look: Look<'_>) -> Option<String> {
    let big_n = look.results.theory.vertices;
    [("p_tenth", 0.1), ("p_nine_tenths", 0.9)].into_iter().find_map(|(id, share)| {
        let value = look.values.get(id)?;
        let p = look.number(id)?;
        let unit = crate::report::values::last_digit(value)?;
        let share_at = |p: f64| Law::new(big_n, p, false).mean() / big_n as f64;
        unless(share_at(p - unit) < share && share < share_at(p + unit), || {
            format!("the mean does not pass {share} N at {id} = {p}")
        })
    })
}

/// Shares of lengths among all simple circuits, and the lengths that are more than a tenth as frequent
/// as N, from logarithms of N!/(k (N − k)!).
fn lengths(look: Look<'_>) -> Option<String> {
    let big_n = look.results.theory.vertices;
    let longest = log_simple(big_n, big_n);
    let ratios: Vec<f64> = (1..=big_n).map(|k| f_exp(log_simple(big_n, k) - longest)).collect();
    let from = look.number("fig7_from")? as usize;
    let near: f64 = ratios.iter().skip(from.saturating_sub(1)).sum();
    let peak = (0..big_n).max_by(|a, b| ratios[*a].total_cmp(&ratios[*b]))? + 1;
    look.are([
        ("fig7_share", near / ratios.iter().sum::<f64>()),
        ("fig7_peak", peak as f64),
        ("eq8_exceptions", ratios[..big_n - 1].iter().filter(|ratio| **ratio > 0.1).count() as f64),
    ])
}

/// f(k) = p k (N − k) − (k + 1) has a double zero where its discriminant (N p − 1)² − 4 p is zero,
/// and there k = 1/√p.
fn double_zero(look: Look<'_>) -> Option<String> {
    let big_n = look.results.theory.vertices as f64;
    let zero = |id: &str, big_n: f64| {
        let p = look.number(id)?;
        let linear = big_n * p - 1.0;
        far(&format!("(N p − 1)² at {id}"), linear * linear, 4.0 * p)
    };
    zero("p_crit", big_n).or_else(|| zero("p_crit_walls", big_n + 1.0)).or_else(|| {
        far(
            "k² p at the double zero",
            square(look.number("k_touch")?) * look.number("p_crit")?,
            1.0,
        )
    })
}

/// At the jump the weight of the longest peak is that of k = 1; just before it k* is still the lower
/// of the two; and the jump comes later than p_crit by the share that is given.
fn jump(look: Look<'_>) -> Option<String> {
    let big_n = look.results.theory.vertices;
    let p = look.number("p_jump")?;
    let law = Law::new(big_n, p, false);
    let (weights, peak) = (law.whole(), law.peak(2));
    let before = Law::new(big_n, p * (1.0 - JUST_BEFORE), false).peak(1);
    far("the weight of the peak at p_jump", weights[peak - 1], weights[0])
        .or_else(|| look.are([("k_after_jump", peak as f64), ("k_before_jump", before as f64)]))
        .or_else(|| {
            let later = look.number("p_crit")? * (1.0 + look.number("jump_after_crit")?);
            let weights = Law::new(big_n, later, false).whole();
            far("the weight of the peak beyond p_crit", weights[peak - 1], weights[0])
        })
}

/// Relative distance below p_jump at which k* is taken: far above rounding.
const JUST_BEFORE: f64 = 1e-6;

/// The heights of all steps of k* add up to what lies between k* at p → 0 and at p = 1; the large one
/// leads from before the jump to after it.
fn steps(look: Look<'_>) -> Option<String> {
    let steps = &look.results.theory.most_likely.steps;
    let big_n = look.results.theory.vertices;
    let last = Law::new(big_n, 1.0, false).peak(1) as f64;
    let small = (steps.len() as f64 - 2.0) * look.number("fig9_other_steps")?;
    let large = Law::new(big_n, look.number("p_jump")?, false).peak(2) as f64 - 1.0;
    look.is("fig9_large_step", large)
        .or_else(|| far("k* at p = 1", 1.0 + look.number("fig9_large_step")? + small, last))
}

/// Φ(k) = Φ(k + 1) where p k (N − k) = k + 1: no integer k > 1 has this at a smaller p, and its own is
/// the fraction that is given, in lowest terms.
fn first_maximum(look: Look<'_>) -> Option<String> {
    let big_n = look.results.theory.vertices as u64;
    let ids = ["numerator", "denominator", "k", "k_next", "p"];
    let [a, b, k, next, p] =
        ids.map(|id| look.number(&format!("first_maximum_{id}")).unwrap_or(0.0));
    let of = |k: u64| (k + 1) as f64 / (k * (big_n - k)) as f64;
    let least = (2..big_n).min_by(|a, b| of(*a).total_cmp(&of(*b)))?;
    let common = |mut a: u64, mut b: u64| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let lowest = common(a as u64, b as u64) == 1;
    far("first_maximum_k", k, least as f64)
        .or_else(|| far("first_maximum_p", p, of(least)))
        .or_else(|| far("the fraction of first_maximum_p", a / b, of(least)))
        .or_else(|| far("first_maximum_k_next", next, least as f64 + 1.0))
        .or_else(|| unless(lowest, || format!("{a}/{b} is not in lowest terms")))
}

fn square(x: f64) -> f64 {
    x * x
}
