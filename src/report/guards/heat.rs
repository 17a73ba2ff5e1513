//! How hot a running chain is.

use super::model;
use super::{Guard, Look, far, unless};
use crate::experiments::heat::{Heat, Warmth};

pub const GUARDS: &[Guard] = &[
    Guard { name: "heat_of_realisations", ids: &["heat.*", "heat_ratio_*"], find: ratios },
    Guard { name: "energy_kept_in_books", ids: &["heat_balance_*", "heat_window"], find: balance },
    Guard {
        name: "heat_expected",
        ids: &["heat_expected", "heat_other_expected", "heat_share_*", "heat_hit_*"],
        find: expected,
    },
    Guard { name: "p_of_hot_chains", ids: &["heat.*", "heat_measured_*"], find: p },
    Guard { name: "sigma_of_hot_jump", ids: &["sigma_jump_hot"], find: jump },
    Guard { name: "heat_scores", ids: &["heat_score_*", "heat_scored"], find: scores },
];

fn heat(look: Look<'_>) -> Option<&Heat> {
    look.results.heat.as_ref()
}

/// The mean is that of the realisations, and a realisation with no mass that was hit is as it started.
fn ratios(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    heat.rows.iter().find_map(|row| {
        let n = row.ratios.len();
        let told = row.ratio?.value;
        let sum: f64 = row.ratios.iter().sum();
        let counts: u64 = row.counts.iter().sum();
        far("a mean of the free parts", told, sum / n as f64)
            .or_else(|| far("a mean count", row.count?.value, counts as f64 / n as f64))
            .or_else(|| look.is("heat_realisations", (n + row.failed) as f64))
    })
}

/// What the free parts of a chain gain in the window is what impacts gave them, and in a steady
/// state that is nothing: as much as chance and the rest of the warming allow.
fn balance(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    let protocol = heat.parameters.protocol;
    let kept = heat.rows.iter().find_map(|row| {
        let off = row.imbalance?;
        unless(off.abs() <= super::ROUNDING, || {
            format!("energy is off by {off} of what impacts took at {:?}", row.row)
        })
    });
    kept.or_else(|| {
        look.are([("heat_transient", protocol.transient), ("heat_window", protocol.window)])
    })
}

/// With ω = d = 1 and Ω² = 2 the expected variance is 2 (1 + r)/(1 − r) times that of the force.
fn expected(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    let of = |r: f64| 2.0 * (1.0 + r) / (1.0 - r);
    let rows = heat
        .rows
        .iter()
        .find_map(|row| far("the expected heat", row.expected, of(row.row.restitution)));
    let paper = look.published.parameter("restitution").ok()?;
    rows.or_else(|| look.is("heat_expected", of(paper)))
        .or_else(|| look.is("heat_other_expected", of(look.number("heat_other_restitution")?)))
}

/// Rows of the table: probabilities by integrals, and the measured share as what it is a share of.
fn p(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    heat.rows.iter().find_map(|row| {
        let sigma = row.row.sigma;
        let share = row.p_measured() * row.gaps as f64;
        far("p", row.p, model::p(sigma))
            .or_else(|| far("p from rest", row.p_rest, model::p_rest(sigma)))
            .or_else(|| {
                far("p of a hot chain", row.p_balanced, model::p_heated(sigma, row.expected))
            })
            .or_else(|| far("closing gaps", share, row.closing as f64))
    })
}

/// p with the balanced variance is the p of the jump there.
fn jump(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    let ratio = heat.rows.first()?.expected;
    let p = model::p_heated(look.number("sigma_jump_hot")?, ratio);
    far("p at sigma_jump_hot", p, look.results.theory.scalars_walls.p_jump)
}

/// Each score by means that were computed another way.
fn scores(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    let big_n = heat.parameters.chain.gaps();
    let rows: Vec<&Warmth> = heat.rising().collect();
    let score = |p: fn(&Warmth) -> f64| {
        let square = |row: &&Warmth| {
            let off =
                model::Law::new(big_n, p(row), false).mean() - row.count.map_or(0.0, |k| k.value);
            off * off
        };
        (rows.iter().map(square).sum::<f64>() / rows.len() as f64).sqrt()
    };
    look.are([
        ("heat_scored", rows.len() as f64),
        ("heat_score_p", score(|row| row.p)),
        ("heat_score_rest", score(|row| row.p_rest)),
        ("heat_score_balanced", score(|row| row.p_balanced)),
        ("heat_score_measured", score(Warmth::p_measured)),
    ])
}
