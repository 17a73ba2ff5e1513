//! Section 2: the simulation.

use super::Basis::{Exact, OurMeasure, PrintedDigit};
use super::row::{Error, Evidence, Row, measured, statistical};
use super::sec2_rare::{percolation, sticking, three_way, two_masses, walls_like_masses};
use super::{Finding, open};
use super::{Judgement, Statement, Text};
use crate::experiments::rise::{self, Counted};
use crate::experiments::sweep::{self, mode_half};
use crate::experiments::{BRANCHES, STARTS, SWEEP, TWO_MASSES};
use crate::params::Protocol;
use impact_numerics::statistics::Estimate;

pub const ROWS: &[Row] = &[
    measured("sec2_parameters", Exact, &[&SWEEP], parameters),
    statistical("sec2_few_below", OurMeasure, &[&SWEEP], few_below),
    statistical("sec2_rise_exists", OurMeasure, &[&SWEEP], rise_exists),
    statistical("sec2_half_height", PrintedDigit, &[&SWEEP], half_height).of("σ ≈ {}"),
    statistical("sec2_onset", PrintedDigit, &[&SWEEP], onset).of("σ ≈ {}"),
    measured("sec2_mode_rise", PrintedDigit, &[&SWEEP], mode_rise).of("σ ≈ {}"),
    statistical("sec2_three_way", OurMeasure, &[&SWEEP], three_way),
    measured("sec2_sticking", OurMeasure, &[&SWEEP], sticking),
    measured("sec2_two_masses", Exact, &[&TWO_MASSES], two_masses),
    measured("sec2_percolation", OurMeasure, &[&BRANCHES], percolation),
    statistical("sec2_walls_like_masses", PrintedDigit, &[&STARTS], walls_like_masses),
];

/// Number of gaps N of the swept chain.
pub(super) fn gaps(sweep: &Counted) -> f64 {
    sweep.ensemble.chain.gaps() as f64
}

fn parameters(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let chain = &sweep::main(e.results)?.ensemble.chain;
    let square = chain.forcing_frequency * chain.forcing_frequency;
    let pairs = [
        (chain.masses as f64, e.published.parameter("masses")?),
        (chain.spacing, e.published.parameter("spacing")?),
        (chain.natural_frequency, e.published.parameter("natural_frequency")?),
        (chain.restitution, e.published.parameter("restitution")?),
        (1.0, e.published.parameter("mass")?),
    ];
    let same_square =
        (square - e.published.parameter("forcing_frequency_squared")?).abs() <= 4.0 * f64::EPSILON;
    let (n, d, r) = (chain.masses, chain.spacing, chain.restitution);
    let reads = s.printed == format!("n = {n}, d = m = ω = {d}, Ω = √{}, r = {r}", square.round());
    Ok(Finding {
        ours: Text::words("n = ")
            .integer(chain.masses)
            .say(", d = ")
            .chosen(chain.spacing)
            .say(", ω = ")
            .chosen(chain.natural_frequency)
            .say(", Ω² = ")
            .significant(square, 1)
            .say(", r = ")
            .chosen(chain.restitution),
        tolerance: Text::words("none"),
        reason: "the same numbers",
        judgement: Judgement::Plain {
            agrees: reads && same_square && pairs.iter().all(|(ours, printed)| ours == printed),
        },
        note: Text::words(
            "The paper prints neither initial condition nor transient nor window; for these it refers \
             to Homer (1999).",
        ),
    })
}

/// Of small σ, the largest that is not above two thirds of the printed threshold.
pub(super) fn small<'a>(e: &'a Evidence) -> Result<Option<&'a rise::Row>, Error> {
    let threshold = e.published.statement("sec2_half_height")?.number()?;
    Ok(sweep::main(e.results)?.first().rows.iter().rev().find(|row| row.sigma < 0.67 * threshold))
}

/// All gaps over those that are very few.
pub(super) const VERY_FEW: f64 = 20.0;

/// The paper discards chains without impacts; that the mean of all is small is owed to those.
fn few_below(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = sweep::main(e.results)?;
    let Some(row) = small(e)? else {
        return Ok(open(Text::words("no row"), "The sweep has no row below the threshold."));
    };
    let at = Text::words("at σ = ").chosen(row.sigma);
    let found = row.mean.zip(row.mean_all);
    let Some((kept, all)) = found.and_then(|(kept, all)| kept.estimate().zip(all.estimate()))
    else {
        return Ok(open(at.say(" too few kept realisations"), "Of one chain no error is known."));
    };
    let limit = gaps(sweep) / VERY_FEW;
    let room = e.level.quantile;
    Ok(Finding {
        ours: at
            .say(" mean of the kept: ")
            .with_error(kept.value, kept.error)
            .say(", of all: ")
            .with_error(all.value, all.error),
        tolerance: Text::words("at most ").significant(limit, 2),
        reason: "ours: “very few” as a twentieth of all gaps, at two thirds of the printed threshold; and the \
                 statistical error at the level of the table",
        judgement: Judgement::Explained {
            agrees: kept.value <= limit + room * kept.error,
            holds: all.value <= limit + room * all.error,
        },
        note: Text::words("Judged by the mean of the kept, as the paper counts. Only ")
            .integer(row.kept)
            .say(" of ")
            .integer(row.ran)
            .say(
                " chains have impacts, but in these they have spread. With the others the mean is \
                 within the tolerance.",
            ),
    })
}

fn rise_exists(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let rise = &sweep::main(e.results)?.first().rise;
    let (Some(width), Some(half)) = (rise.kept_width, rise.half_height) else {
        return Ok(open(
            Text::words("no rise"),
            "The mean of the kept does not pass one and three quarters of all gaps.",
        ));
    };
    let share = width.value / half.value;
    let error =
        share * (square(width.error / width.value) + square(half.error / half.value)).sqrt();
    let note = Text::words("Judged by the mean of the kept.");
    Ok(Finding {
        ours: Text::words("a quarter to three quarters of all gaps within ")
            .with_error(share, error)
            .say(" of σ½"),
        tolerance: Text::words("at most half"),
        reason: "ours: a response in proportion to σ would take all of σ½; and the statistical \
                 error",
        judgement: Judgement::Plain { agrees: share <= 0.5 + e.level.quantile * error },
        note: match rise.width {
            Some(width) => note
                .say(" The mean of all rises from a tenth to nine tenths within Δσ = ")
                .with_error(width.value, width.error)
                .say("."),
            None => note,
        },
    })
}

fn square(x: f64) -> f64 {
    x * x
}

/// Whether an estimate rounds to a printed number, its statistical error allowed for.
fn rounds(e: &Evidence, s: &Statement, estimate: &Estimate) -> Result<bool, Error> {
    let [low, high] = s.rounding()?;
    let room = e.level.quantile * estimate.error;
    Ok(estimate.value >= low - room && estimate.value <= high + room)
}

pub(super) const LAST_DIGIT: &str =
    "half a unit of the last printed digit, and the statistical error at the level of the table";

fn half_unit(s: &Statement) -> Result<Text, Error> {
    let [low, high] = s.rounding()?;
    Ok(Text::words("± ").significant((high - low) / 2.0, 1))
}

fn half_height(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let sweep = sweep::main(e.results)?;
    let Some(half) = sweep.first().rise.half_height else {
        return Ok(open(Text::words("no rise"), "The mean does not pass half of all gaps."));
    };
    let Protocol { transient, window } = sweep.first().protocol;
    Ok(Finding {
        ours: Text::words("σ½ = ").with_error(half.value, half.error),
        tolerance: half_unit(s)?,
        reason: LAST_DIGIT,
        judgement: Judgement::Plain { agrees: rounds(e, s, &half)? },
        note: {
            let note = Text::words("Judged by the mean of the kept, with T = ")
                .integer(transient as usize)
                .say(", W = ")
                .integer(window as usize)
                .say(" and a start from rest; it moves with all three.");
            match sweep.first().rise.half_height_all {
                Some(all) => {
                    note.say(" The mean of all has ").with_error(all.value, all.error).say(".")
                }
                None => note,
            }
        },
    })
}

/// The first impacts come where a gap closes by itself, long before the rise is half way up.
fn onset(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let rise = &sweep::main(e.results)?.first().rise;
    let (Some(onset), Some(kept), Some(half)) = (rise.onset, rise.kept_half, rise.half_height)
    else {
        return Ok(open(
            Text::words("no onset"),
            "The mean does not pass a twentieth of all gaps.",
        ));
    };
    let predicted = e.number("theory.relation.sigma_kept_half")?;
    let near =
        (kept.value / predicted - 1.0).abs() <= 0.05 + e.level.quantile * kept.error / predicted;
    let holds = near && rounds(e, s, &half)?;
    Ok(Finding {
        ours: Text::words("σ = ").with_error(onset.value, onset.error),
        tolerance: half_unit(s)?,
        reason: LAST_DIGIT,
        judgement: Judgement::Explained { agrees: rounds(e, s, &onset)?, holds },
        note: Text::words(
            "The printed σ is that of half the height. Judged by the mean of all: where any chain is kept, the mean of \
             the kept is above a twentieth. Impacts begin where a gap first closes by itself, and spread at larger σ. \
             Half of the chains have impacts at σ = ",
        )
        .with_error(kept.value, kept.error)
        .say("; from the probability of such a gap after a start from rest follows ")
        .significant(predicted, 4)
        .say(
            ", within the 5 % that neighbouring gaps with a common mass and the finite time cost.",
        ),
    })
}

fn mode_rise(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let sweep = sweep::main(e.results)?;
    let Some([low, high]) = mode_half(sweep) else {
        return Ok(open(Text::words("no rise"), "The mode does not pass half of all gaps."));
    };
    let [from, to] = s.rounding()?;
    Ok(Finding {
        ours: Text::words("between σ = ").chosen(low).say(" and ").chosen(high),
        tolerance: half_unit(s)?,
        reason: "the two intervals have to meet: half a unit of the last printed digit, and the \
                 range of σ in which bootstrap intervals of the mode reach over half of all gaps",
        judgement: Judgement::Plain { agrees: low <= to && high >= from },
        note: Text::words(
            "The counts are spread so widely below the rise that their mode is not determined.",
        ),
    })
}
