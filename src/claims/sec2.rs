//! Section 2: the simulation.

use super::row::{Error, Evidence, Finding, Row, measured, open, statistical};
use super::sec2_rare::{sticking, three_way, two_masses, walls_like_masses};
use super::{Judgement, Statement, Text};
use crate::experiments::Need;
use crate::experiments::sweep::{Sweep, SweepRow};
use crate::numerics::statistics::Estimate;
use crate::params::Protocol;

/// The rows of this section.
pub const ROWS: &[Row] = &[
    measured("sec2_parameters", &[Need::Sweep], parameters),
    statistical("sec2_few_below", &[Need::Sweep], few_below),
    statistical("sec2_rise_exists", &[Need::Sweep], rise_exists),
    statistical("sec2_half_height", &[Need::Sweep], half_height),
    statistical("sec2_onset", &[Need::Sweep], onset),
    measured("sec2_mode_rise", &[Need::Sweep], mode_rise),
    statistical("sec2_protocols", &[Need::Protocol], protocols),
    statistical("sec2_half_height_second_seed", &[Need::Sweep, Need::SecondSeed], second_seed),
    statistical("sec2_curve_second_seed", &[Need::Sweep, Need::SecondSeed], second_curve),
    statistical("sec2_three_way", &[Need::Sweep, Need::Laws], three_way),
    measured("sec2_sticking", &[Need::Sweep], sticking),
    measured("sec2_two_masses", &[Need::TwoMasses], two_masses),
    statistical("sec2_walls_like_masses", &[Need::Starts], walls_like_masses),
];

/// Number of gaps N of the swept chain.
pub(super) fn gaps(sweep: &Sweep) -> f64 {
    sweep.parameters.chain.gaps() as f64
}

/// Mean over all that ran, and its standard error, from the counts of a row.
pub(crate) fn mean_all(row: &SweepRow) -> Option<[f64; 2]> {
    let ran: f64 = row.counts.iter().map(|&c| f64::from(c)).sum();
    let mean = row.mean_all?;
    let squares: f64 = (0_u32..)
        .zip(&row.counts)
        .map(|(k, &c)| f64::from(c) * (f64::from(k) - mean) * (f64::from(k) - mean))
        .sum();
    (ran > 1.0).then(|| [mean, (squares / (ran - 1.0) / ran).sqrt()])
}

fn parameters(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let chain = &e.results.sweep()?.parameters.chain;
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
            agrees: same_square && pairs.iter().all(|(ours, printed)| ours == printed),
        },
        note: Text::words("The paper prints neither initial condition nor transient nor window."),
    })
}

fn few_below(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = e.results.sweep()?;
    let threshold = e.published.statement("sec2_half_height")?.number()?;
    let below = sweep.rows.iter().rev().find(|row| row.sigma < 0.67 * threshold);
    let Some((row, [mean, error])) = below.and_then(|row| Some((row, mean_all(row)?))) else {
        return Ok(open(Text::words("no row"), "The sweep has no row below the threshold."));
    };
    let limit = gaps(sweep) / 100.0;
    Ok(Finding {
        ours: Text::words("mean of all at σ = ")
            .chosen(row.sigma)
            .say(": ")
            .with_error(mean, error),
        tolerance: Text::words("at most ").significant(limit, 2),
        reason: "ours: a hundredth of all gaps at two thirds of the printed threshold, and the \
                 statistical error at the level of the table",
        judgement: Judgement::Plain { agrees: mean <= limit + e.level.quantile * error },
        note: Text::words("Kept are ")
            .integer(row.kept)
            .say(" of ")
            .integer(row.realisations)
            .say(" realisations; they show ")
            .significant(row.mean_distinct.unwrap_or(0.0), 2)
            .say(" gaps on average."),
    })
}

fn rise_exists(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = e.results.sweep()?;
    let (Some(width), Some(half)) = (sweep.rise.width, sweep.rise.half_height_all) else {
        return Ok(open(Text::words("no rise"), "The mean does not pass nine tenths of all gaps."));
    };
    let share = width.value / half.value;
    let error =
        share * (square(width.error / width.value) + square(half.error / half.value)).sqrt();
    Ok(Finding {
        ours: Text::words("a tenth to nine tenths of all gaps within ")
            .with_error(share, error)
            .say(" of σ½"),
        tolerance: Text::words("at most half"),
        reason: "ours: a response in proportion to σ would take more than three times as much; and the \
                 statistical error",
        judgement: Judgement::Plain { agrees: share <= 0.5 + e.level.quantile * error },
        note: Text::words("Width ").with_error(width.value, width.error).say("."),
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
    let sweep = e.results.sweep()?;
    let Some(half) = sweep.rise.half_height else {
        return Ok(open(Text::words("no rise"), "The mean does not pass half of all gaps."));
    };
    let Protocol { transient, window } = sweep.parameters.protocol;
    Ok(Finding {
        ours: Text::words("σ½ = ").with_error(half.value, half.error),
        tolerance: half_unit(s)?,
        reason: LAST_DIGIT,
        judgement: Judgement::Plain { agrees: rounds(e, s, &half)? },
        note: Text::words("With T = ")
            .integer(transient as usize)
            .say(", W = ")
            .integer(window as usize)
            .say(" and a start from rest; it moves with all three."),
    })
}

/// The first impacts come where a gap closes by itself, long before the rise is half way up.
fn onset(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let rise = &e.results.sweep()?.rise;
    let (Some(onset), Some(kept)) = (rise.onset, rise.kept_half) else {
        return Ok(open(
            Text::words("no onset"),
            "The mean does not pass a twentieth of all gaps.",
        ));
    };
    let predicted = e.results.identities.sigma_kept_half;
    let holds =
        (kept.value / predicted - 1.0).abs() <= 0.05 + e.level.quantile * kept.error / predicted;
    Ok(Finding {
        ours: Text::words("σ = ").with_error(onset.value, onset.error),
        tolerance: half_unit(s)?,
        reason: LAST_DIGIT,
        judgement: Judgement::Explained { agrees: rounds(e, s, &onset)?, holds },
        note: Text::words(
            "Onset is not spreading: impacts begin where a gap first closes by itself. Half of \
             the chains have impacts at σ = ",
        )
        .with_error(kept.value, kept.error)
        .say("; from the probability of such a gap after a start from rest follows ")
        .significant(predicted, 4)
        .say(
            ", within the 5 % that neighbouring gaps with a common mass and the finite time cost.",
        ),
    })
}

/// Between which σ the mode passes half of all gaps: below the first it is surely under one half,
/// above the second surely over it, as far as its bootstrap intervals tell.
pub(crate) fn mode_half(sweep: &Sweep) -> Option<[f64; 2]> {
    let half = gaps(sweep) / 2.0;
    let intervals: Vec<(f64, [usize; 2])> =
        sweep.rows.iter().filter_map(|row| Some((row.sigma, row.mode_interval?))).collect();
    let low = intervals.iter().find(|(_, [_, top])| *top as f64 >= half)?;
    let high = intervals.iter().rev().find(|(_, [bottom, _])| (*bottom as f64) < half)?;
    Some([low.0, high.0])
}

fn mode_rise(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let sweep = e.results.sweep()?;
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

/// A property of the chain alone would not depend on how one looks; a waiting time falls with it.
fn protocols(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let map = e.results.protocol()?;
    let cells: Vec<(f64, f64, Estimate)> = map
        .cells
        .iter()
        .filter_map(|cell| Some((cell.transient, cell.window, cell.half_height?)))
        .collect();
    let printed = map.cells.iter().filter(|cell| cell.prints_as_published).count();
    let lowest = cells.iter().map(|(.., h)| h.value).fold(f64::INFINITY, f64::min);
    let highest = cells.iter().map(|(.., h)| h.value).fold(0.0, f64::max);
    let mut pairs = 0;
    let mut falling = 0;
    for (t, w, h) in &cells {
        for (t2, w2, later) in &cells {
            if (t2 > t && w2 == w) || (t2 == t && w2 > w) {
                pairs += 1;
                let room =
                    e.level.among(cells.len()) * (square(h.error) + square(later.error)).sqrt();
                falling += usize::from(later.value <= h.value + room);
            }
        }
    }
    Ok(Finding {
        ours: Text::default()
            .integer(printed)
            .say(" of ")
            .integer(map.cells.len())
            .say(" protocols print so; σ½ from ")
            .significant(lowest, 3)
            .say(" to ")
            .significant(highest, 3),
        tolerance: Text::words("every protocol"),
        reason: "a threshold of the chain would not depend on how long one looks",
        judgement: Judgement::Explained {
            agrees: printed == map.cells.len(),
            holds: pairs > 0 && falling == pairs && printed > 0,
        },
        note: Text::words(
            "σ½ is the force at which spreading takes as long as one waits, so it must fall with \
             both times: it does in ",
        )
        .integer(falling)
        .say(" of ")
        .integer(pairs)
        .say(" pairs of protocols, within their errors."),
    })
}

fn second_seed(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let first = e.results.sweep()?.rise.half_height;
    let (Some(first), Some(second)) = (first, e.results.second_seed()?.rise.half_height) else {
        return Ok(open(Text::words("no rise"), "One of the two means does not pass one half."));
    };
    let error = (square(first.error) + square(second.error)).sqrt();
    Ok(Finding {
        ours: Text::words("σ½ = ")
            .with_error(second.value, second.error)
            .say(" beside ")
            .with_error(first.value, first.error),
        tolerance: Text::words("± ").significant(e.level.quantile * error, 1),
        reason: "standard errors of both at the level of the table",
        judgement: Judgement::Plain {
            agrees: (second.value - first.value).abs() <= e.level.quantile * error,
        },
        note: Text::default(),
    })
}

/// Fewest kept realisations for a mean whose error is taken as normal.
const FEWEST: usize = 30;

/// The largest difference between the curves of two seeds, in standard errors, and the rows.
pub(crate) fn largest_between_seeds(first: &Sweep, second: &Sweep) -> Option<(f64, usize)> {
    let mut largest: Option<f64> = None;
    let mut rows = 0;
    for b in &second.rows {
        let Some(a) = first.rows.iter().find(|a| a.sigma == b.sigma) else { continue };
        if a.kept.min(b.kept) < FEWEST {
            continue;
        }
        let means = a.mean_distinct.zip(b.mean_distinct);
        let errors = a.standard_error.zip(b.standard_error);
        let (Some((m, n)), Some((s, t))) = (means, errors) else { continue };
        let error = (square(s) + square(t)).sqrt();
        if error > 0.0 {
            rows += 1;
            largest = Some(largest.unwrap_or(0.0).max((m - n).abs() / error));
        }
    }
    Some((largest?, rows))
}

fn second_curve(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let found = largest_between_seeds(e.results.sweep()?, e.results.second_seed()?);
    let Some((largest, rows)) = found else {
        return Ok(open(
            Text::words("too few kept realisations"),
            "With so few realisations no mean has a normal error.",
        ));
    };
    let limit = e.level.among(rows);
    Ok(Finding {
        ours: Text::default()
            .significant(largest, 2)
            .say(" standard errors, over ")
            .integer(rows)
            .say(" values of σ"),
        tolerance: Text::default().significant(limit, 3).say(" standard errors"),
        reason: "the level of the table, shared by all rows of the curve",
        judgement: Judgement::Plain { agrees: largest <= limit },
        note: Text::default(),
    })
}
