//! How hot a running chain is.

use super::model;
use super::{Guard, Look, far, unless};
use crate::experiments::heat::{Heat, Warmth};
use crate::report::values::cell;

pub const GUARDS: &[Guard] = &[
    Guard { name: "heat_of_realisations", ids: &["heat.*", "heat_ratio_*"], find: sums },
    Guard { name: "heat_as_tabled", ids: &["heat_*"], find: tabled },
    Guard { name: "energy_kept_in_books", ids: &["heat_balance*"], find: balance },
    Guard { name: "heat_expected", ids: &["heat_expected", "heat_other_expected"], find: expected },
    Guard { name: "heat_with_friction", ids: &["heat_rate", "heat_*"], find: friction },
    Guard { name: "p_of_hot_chains", ids: &["heat.*"], find: p },
    Guard { name: "sigma_of_hot_jump", ids: &["sigma_jump_hot"], find: jump },
];

fn heat(look: Look<'_>) -> Option<&Heat> {
    look.results.heat.as_ref()
}

/// Means are those of the realisations, and ratios those of their sums; the ensembles are those
/// that were asked for.
fn sums(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    let ran = |rows: &[Warmth]| rows.iter().map(|row| row.row).collect::<Vec<_>>();
    let asked = [&heat.parameters.rows, &heat.parameters.ring];
    let uneven = unless([ran(&heat.rows), ran(&heat.ring)].each_ref() == asked, || {
        "other ensembles than asked for".into()
    });
    // A ring has no wall, and as many gaps as masses.
    let masses = heat.parameters.chain.masses as f64;
    let row = |row: &Warmth, gaps: f64| {
        let n = row.ratios.len() as f64;
        let ratio = |[above, below]: [f64; 2]| above / below;
        let total = |counts: &[u64]| counts.iter().sum::<u64>() as f64;
        far("a mean of the free parts", row.ratio?.value, row.ratios.iter().sum::<f64>() / n)
            .or_else(|| far("a mean count", row.count?.value, total(&row.counts) / n))
            .or_else(|| far("closing gaps", row.p_measured, total(&row.closing) / (n * gaps)))
            .or_else(|| look.is("heat_realisations", n + row.failed as f64))
            .or_else(|| far("heat of those hit", row.ratio_of_hit?.value, ratio(row.warmth_of_hit)))
            .or_else(|| far("a balance", row.balance?.value, ratio(row.work)))
    };
    uneven
        .or_else(|| heat.rows.iter().find_map(|own| row(own, masses + 1.0)))
        .or_else(|| heat.ring.iter().find_map(|own| row(own, masses)))
}

/// The text speaks of rows of the table.
fn tabled(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    let at = |letter: &str| {
        let named = |name: &str| format!("heat_{name}_{letter}");
        let sigma = look.number(&named("sigma"))?;
        let Some(row) = heat.rising().find(|row| row.row.sigma == sigma) else {
            return Some(format!("no row at sigma = {sigma}"));
        };
        let hit = || match letter {
            "a" => {
                let hit = row.warmth_of_hit[0] / row.warmth_of_hit[1];
                look.is("heat_hit", hit).or_else(|| look.is("heat_measured", row.p_measured))
            }
            _ => None,
        };
        look.is(&named("ratio"), row.ratios.iter().sum::<f64>() / row.ratios.len() as f64)
            .or_else(hit)
            .or_else(|| look.is(&named("friction"), row.expected_at_rate))
    };
    let other = || {
        let r = look.number("heat_other_restitution")?;
        let Some(row) = heat.others().find(|row| row.row.restitution == r) else {
            return Some(format!("no row at r = {r}"));
        };
        look.is("heat_other", row.ratios.iter().sum::<f64>() / row.ratios.len() as f64)
            .or_else(|| look.is("heat_other_sigma", row.row.sigma))
    };
    let head = |row: &Warmth| {
        let sigma = row.row.sigma;
        look.is(&cell("heat", sigma, "sigma"), sigma)
    };
    let lowest = || {
        let row = heat.rising().next()?;
        look.is("heat_lowest_sigma", row.row.sigma)
            .or_else(|| look.is("heat_lowest_hit", row.warmth_of_hit[0] / row.warmth_of_hit[1]))
    };
    heat.rising()
        .find_map(head)
        .or_else(lowest)
        .or_else(|| at("a"))
        .or_else(|| at("b"))
        .or_else(other)
}

/// What the free parts of a chain gain in the window is what impacts gave them, and what those of all chains
/// gain is what their balance is above one.
fn balance(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    let books = |row: &Warmth| {
        let off = row.imbalance?;
        unless(off.abs() <= super::ROUNDING, || {
            format!("energy is off by {off} of what impacts took at {:?}", row.row)
        })
    };
    let pooled = |rows: &[Warmth]| {
        let ratios: Vec<f64> = rows
            .iter()
            .filter(|row| row.work[1] > 0.0)
            .map(|row| row.work[0] / row.work[1])
            .collect();
        ratios.iter().rev().sum::<f64>() / ratios.len() as f64
    };
    let rows = || heat.rows.iter().chain(&heat.ring);
    rows().find_map(books).or_else(|| {
        look.are([("heat_balance", pooled(&heat.rows)), ("heat_balance_ring", pooled(&heat.ring))])
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

/// At the rate of impacts force gives what restitution takes, and two formulas are as far off as is said.
fn friction(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    let row = |row: &Warmth| {
        let r = row.row.restitution;
        let impacts = row.impacts.iter().sum::<u64>() as f64;
        let rate = 2.0 * impacts / (row.hit as f64 * heat.parameters.protocol.window);
        // ω = d = 1, Ω² = 2, (ω² − Ω²)² = 1: power and loss of a mass, both over σ².
        let lost = 2.0 * ((1.0 + r) * rate) * ((1.0 + r) * rate);
        let kept = 2.0 / (1.0 + lost);
        // Of a² + b² = x² + v²/ω² what friction leaves out of the forced motion has three quarters of 2 v².
        let speed = row.expected_at_rate - 0.75 * kept * lost + kept;
        far("a rate of impacts", row.rate, rate)
            .or_else(|| far("power and loss", (1.0 + r) * kept, 0.5 * (1.0 - r * r) * speed))
    };
    let off = |formula: fn(&Warmth) -> f64| {
        let found = |row: &Warmth| row.warmth_of_hit[0] / row.warmth_of_hit[1];
        let log = |row: &Warmth| pxfm::f_log(found(row)) - pxfm::f_log(formula(row));
        let square: f64 = heat.rows.iter().map(|row| log(row) * log(row)).sum();
        pxfm::f_exp((square / heat.rows.len() as f64).sqrt())
    };
    let sigma = look.number("heat_sigma_b")?;
    let high = heat.rising().find(|row| row.row.sigma == sigma)?;
    let r = look.number("heat_other_restitution")?;
    let other = heat.others().find(|row| row.row.restitution == r)?;
    heat.rows.iter().find_map(row).or_else(|| {
        look.are([
            ("heat_rate", high.rate),
            ("heat_other_friction", other.expected_at_rate),
            ("heat_rows", heat.rows.len() as f64),
            ("heat_factor", off(|row| row.expected)),
            ("heat_factor_friction", off(|row| row.expected_at_rate)),
        ])
    })
}

/// Probabilities of the table, by integrals.
fn p(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    heat.rows.iter().find_map(|row| {
        let sigma = row.row.sigma;
        let balanced =
            || far("p of a hot chain", row.p_balanced, model::p_heated(sigma, row.expected));
        far("p", row.p, model::p(sigma))
            .or_else(|| far("p from rest", row.p_rest, model::p_rest(sigma)))
            .or_else(balanced)
    })
}

/// p with the balanced variance is the p of the jump there.
fn jump(look: Look<'_>) -> Option<String> {
    let heat = heat(look)?;
    let ratio = heat.rows.first()?.expected;
    let p = model::p_heated(look.number("sigma_jump_hot")?, ratio);
    far("p at sigma_jump_hot", p, look.results.theory.scalars_walls.p_jump)
}
