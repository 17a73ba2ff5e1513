//! Section 8: a relation between σ and p.

use super::Basis::{OurMeasure, Rounding};
use super::row::{Error, Evidence, Row, difference, measured, statistical, theory};
use super::sec2;
use super::sec8_chains::{no_impact, restitution_ensures, restitution_omitted, threshold_shift};
use super::{Finding, open, rounding};
use super::{Judgement, Statement, Text};
use crate::experiments::rise::Counted;
use crate::experiments::sweep;
use crate::experiments::theory::beside::LARGE_SIGMA;
use crate::experiments::{BRANCHES, PROTOCOL, RESTITUTION, STARTS, SWEEP};
use crate::params::VERTICES;

pub const ROWS: &[Row] = &[
    measured("sec8_expected_jump", OurMeasure, &[&SWEEP], expected_jump),
    theory("sec8_separation", Rounding, |e, s| {
        let note =
            "Against the equations of motion solved by variation of constants, at five times.";
        difference(e, s, 1e-13, note)
    })
    .of("Eq. (19)"),
    statistical("sec8_no_impact", OurMeasure, &[&STARTS], no_impact)
        .of("1 − p = P(Y₀ + Y₁/|ω² − Ω²| < d)"),
    theory("sec8_amplitude", Rounding, |e, s| {
        difference(e, s, 1e-13, "Against √2 times the root mean square over a period.")
    })
    .of("Eq. (21)"),
    theory("sec8_densities", Rounding, |e, s| {
        difference(
            e,
            s,
            1e-12,
            "The probability of Y ≤ x at five x and three σ, against the integral of the two normal \
             densities over a disc; the second also at |ω² − Ω²| = 1/2.",
        )
    }),
    theory("sec8_eq25", Rounding, |e, _| {
        Ok(rounding(
            e.number("theory.relation.difference")?,
            1e-12,
            "Closed form against the double integral at five σ where the latter has digits left.",
        ))
    })
    .of("Eq. (25)"),
    theory("sec8_p_small", OurMeasure, p_small).of("extremely small for σ < {}"),
    measured("sec8_large_sigma", OurMeasure, &[&SWEEP], large_sigma),
    statistical(
        "sec8_threshold_shift",
        OurMeasure,
        &[&SWEEP, &PROTOCOL, &BRANCHES],
        threshold_shift,
    ),
    measured("sec8_mean_is_easier", OurMeasure, &[&SWEEP], mean_is_easier),
    statistical(
        "sec8_restitution_omitted",
        OurMeasure,
        &[&RESTITUTION, &STARTS, &PROTOCOL],
        restitution_omitted,
    ),
    measured("sec8_restitution_ensures", OurMeasure, &[&SWEEP, &RESTITUTION], restitution_ensures),
];

/// A jump stays in one step of the grid, however fine; a slope is shared by all. And weights in
/// proportion to p^k have a mean with the slope Var(X)/p.
fn expected_jump(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = sweep::main(e.results)?;
    let of = |column| e.number(&format!("sweep.beside_theory.{column}"));
    let (Ok(one), Ok(two), Ok(all)) =
        (of("largest_increase"), of("increase_of_two"), of("increase_of_all"))
    else {
        return Ok(open(Text::words("too few rows"), "The grid of σ is too coarse."));
    };
    let (difference, variance) =
        (e.number("theory.jump.slope")?, e.number("theory.jump.variance_over_p")?);
    let half = sec2::gaps(sweep) / 2.0;
    let ratio = two / one;
    Ok(Finding {
        ours: Text::words("largest step of the mean of the kept between neighbouring σ: ")
            .significant(one, 2)
            .say(" gaps; in the theory dμ/dp = ")
            .significant(difference, 4)
            .say(" at p_jump"),
        tolerance: Text::words("a step of at least ").significant(half, 3).say("; no finite slope"),
        reason: "ours: a jump is a step of half the height or more, and has no slope",
        judgement: Judgement::Explained {
            agrees: one >= half && !difference.is_finite(),
            holds: ratio > 1.5 && (difference / variance - 1.0).abs() < 1e-6,
        },
        note: Text::words(
            "Only the mode of the theory jumps. The simulated rise is steep but gradual: over two \
             steps of the grid the mean of the kept increases ",
        )
        .significant(ratio, 2)
        .say(" times as much as over one (a slope gives 2, a jump 1); the largest step of the mean of all is ")
        .significant(all, 2)
        .say(". The slope of μ is the variance of X over p, finite for every finite N."),
    })
}

fn p_small(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let (crit, jump) =
        (e.number("theory.relation.sigma_crit")?, e.number("theory.relation.sigma_jump")?);
    let printed = s.number()?;
    let [low, high] = s.rounding()?;
    let p = e.number(&format!("theory.gap[sigma={printed}].p"))?;
    Ok(Finding {
        ours: Text::words("p = ").significant(p, 3).say(" at σ = ").chosen(printed),
        tolerance: Text::words("below p_crit up to the σ that is printed, ± ")
            .significant((high - low) / 2.0, 1),
        reason: "ours: “extremely small” as below the first change of k*; and half a unit of the printed digit",
        judgement: Judgement::Plain { agrees: crit >= low },
        note: Text::words("p reaches p_crit at σ = ")
            .significant(crit, 4)
            .say(" and p_jump at ")
            .significant(jump, 4)
            .say(": within the rounding of the printed value, and below it."),
    })
}

fn large_sigma(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = sweep::main(e.results)?;
    let of = |column| e.number(&format!("sweep.beside_theory.{column}"));
    let (Ok(distance), Ok(at)) = (of("large_distance"), of("large_distance_at")) else {
        return Ok(open(Text::words("no row"), "The sweep has no row at large σ."));
    };
    let limit = sec2::gaps(sweep) / 10.0;
    let missed = sec2::gaps(sweep) - of("large_mean")?;
    let short = VERTICES as f64 - of("large_theory")?;
    Ok(Finding {
        ours: Text::words("largest distance from σ = ")
            .chosen(LARGE_SIGMA)
            .say(" on: ")
            .significant(distance, 2)
            .say(" gaps"),
        tolerance: Text::words("at most ").significant(limit, 3),
        reason: "ours: a tenth of all gaps",
        judgement: Judgement::Plain { agrees: distance <= limit },
        note: Text::words("Reached at σ = ")
            .chosen(at)
            .say(" (mean of the kept). The tolerance is generous: there the theory misses ")
            .significant(short, 2)
            .say(" of its ")
            .integer(VERTICES)
            .say(" vertices, the simulation ")
            .significant(missed, 2)
            .say(" of its ")
            .integer(sec2::gaps(sweep) as usize)
            .say(" gaps."),
    })
}

/// Width of the mode's bootstrap interval over that of the mean, in the rise: the median.
fn mode_over_mean(sweep: &Counted) -> Option<f64> {
    let rise = [sweep.first().rise.onset?.value, sweep.first().rise.half_height_all?.value];
    let rows = sweep.first().rows.iter().filter(|row| rise[0] <= row.sigma && row.sigma <= rise[1]);
    let mut ratios: Vec<f64> = rows
        .filter_map(|row| {
            let [low, high] = row.mode_interval?;
            let [from, to] = row.mean?.interval?;
            (to > from).then(|| (high - low) as f64 / (to - from))
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    (!ratios.is_empty()).then(|| ratios[ratios.len() / 2])
}

fn mean_is_easier(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let Some(ratio) = mode_over_mean(sweep::main(e.results)?) else {
        return Ok(open(Text::words("no interval"), "There are too few rows in the rise."));
    };
    Ok(Finding {
        ours: Text::words("the interval of the mode is ")
            .significant(ratio, 2)
            .say(" times as wide as that of the mean"),
        tolerance: Text::words("at least twice"),
        reason: "ours: “much easier” as at least four times fewer realisations",
        judgement: Judgement::Plain { agrees: ratio >= 2.0 },
        note: Text::words("Median over the rows from onset to half height."),
    })
}
