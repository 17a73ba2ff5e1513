//! Sec. 8: the relation of p and σ, by integrals of the densities.

use super::model::{self, Column};
use super::{Guard, Look, far};
use crate::experiments::theory::Scalars;

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "p_by_integral",
        ids: &[
            "p_012",
            "p_015",
            "p_rest_012",
            "p_rest_ratio",
            "self_closing",
            "overlap_share",
            "overlap_sigma",
        ],
        find: p,
    },
    Guard {
        name: "kept_by_integral",
        ids: &[
            "kept_predicted_a",
            "kept_predicted_b",
            "kept_half_predicted",
            "kept_onset_predicted",
        ],
        find: kept,
    },
    Guard {
        name: "sigmas_of_jumps",
        ids: &["sigma_jump", "sigma_jump_walls", "sigma_jump_rest"],
        find: jumps,
    },
    Guard { name: "sigmas_of_half", ids: &["sigma_half_theory", "sigma_half_rest"], find: halves },
];

/// The threshold that the paper prints, and where it says that p is small.
fn printed(look: Look<'_>) -> Option<[f64; 2]> {
    let number = |id: &str| look.published.statement(id).ok()?.number().ok();
    Some([number("sec2_half_height")?, number("sec8_p_small")?])
}

/// Probabilities at printed σ are integrals of Eqs. (22) and (23), of a mean over the phase for a start
/// from rest, and of a normal tail for the starts that overlap.
fn p(look: Look<'_>) -> Option<String> {
    let [threshold, small] = printed(look)?;
    let (p, rest) = (model::p(threshold), model::p_rest(threshold));
    let gaps = look.published.parameter("masses").ok()? + 1.0;
    let overlapped = |sigma: f64| 0.5 * model::both_tails(0.5 / sigma) / model::p(sigma);
    look.are([
        ("p_012", p),
        ("p_015", model::p(small)),
        ("p_rest_012", rest),
        ("p_rest_ratio", rest / p),
        ("self_closing", gaps * rest),
    ])
    .or_else(|| look.is("overlap_share", overlapped(look.number("overlap_sigma")?)))
}

/// A chain has an impact if one of its gaps closes by itself: of N gaps with the probability of a start
/// from rest, as if they were independent.
fn kept(look: Look<'_>) -> Option<String> {
    let gaps = look.published.parameter("masses").ok()? + 1.0;
    let any = |sigma: f64| model::any(model::p_rest(sigma), gaps);
    let at = |sigma: &str, share: &str| look.is(share, any(look.number(sigma)?));
    at("sweep.rows[sigma=0.12].sigma", "kept_predicted_a")
        .or_else(|| at("sweep.rows[sigma=0.1].sigma", "kept_predicted_b"))
        .or_else(|| {
            let share = |id: &str, share: f64| {
                far(&format!("the share at {id}"), any(look.number(id)?), share)
            };
            share("kept_half_predicted", 0.5).or_else(|| share("kept_onset_predicted", 0.05))
        })
}

/// p at the σ of a jump is the p of the jump.
fn jumps(look: Look<'_>) -> Option<String> {
    let theory = &look.results.theory;
    let at = |id: &str, p: fn(f64) -> f64, scalars: &Scalars| {
        far(&format!("p at {id}"), p(look.number(id)?), scalars.p_jump)
    };
    at("sigma_jump", model::p, &theory.scalars)
        .or_else(|| at("sigma_jump_walls", model::p, &theory.scalars_walls))
        .or_else(|| at("sigma_jump_rest", model::p_rest, &theory.scalars))
}

/// μ at the half height of the theory is half way between 1 and N.
fn halves(look: Look<'_>) -> Option<String> {
    let big_n = look.results.theory.vertices;
    let at = |id: &str, column: Column| {
        let mean = model::mean_at(big_n, look.number(id)?, column);
        far(&format!("the mean at {id}"), mean, 0.5 * (big_n as f64 + 1.0))
    };
    at("sigma_half_theory", Column::Simple).or_else(|| at("sigma_half_rest", Column::Rest))
}
