//! Section 8: a relation between σ and p.

use super::row::{Error, Evidence, Finding, Row, exact, measured, open, rounding, statistical};
use super::sec2;
use super::{Judgement, Statement, Text};
use crate::experiments::Need;
use crate::experiments::sweep::Sweep;
use crate::experiments::theory::{Curve, CurveRow};

/// The rows of this section.
pub const ROWS: &[Row] = &[
    measured("sec8_expected_jump", &[Need::Sweep], expected_jump),
    statistical("sec8_no_impact", &[Need::Sweep], no_impact),
    exact("sec8_densities", |e, _| {
        Ok(rounding(e.results.identities.densities, 1e-12, "By quadrature at three values of σ."))
    }),
    exact("sec8_eq25", |e, _| {
        Ok(rounding(
            e.results.identities.eq25,
            1e-12,
            "Closed form against the double integral at five σ where the latter has digits left.",
        ))
    }),
    exact("sec8_p_small", p_small),
    measured("sec8_large_sigma", &[Need::Sweep], large_sigma),
    statistical("sec8_threshold_shift", &[Need::Sweep, Need::Starts], threshold_shift),
    measured("sec8_mean_is_easier", &[Need::Sweep], mean_is_easier),
];

/// The largest increase of the mean over all within one and within two steps of the grid, in
/// gaps, with the σ at which the single step begins; over the finest part of the grid.
pub(crate) fn increases(sweep: &Sweep) -> Option<[f64; 3]> {
    let points: Vec<(f64, f64)> =
        sweep.rows.iter().filter_map(|row| Some((row.sigma, row.mean_all?))).collect();
    let finest = points.windows(2).map(|w| w[1].0 - w[0].0).fold(f64::INFINITY, f64::min);
    let fine = |step: f64| step < 1.01 * finest;
    let mut found: Option<[f64; 3]> = None;
    for w in points.windows(3) {
        let [(x, a), (y, b), (z, c)] = [w[0], w[1], w[2]];
        if fine(y - x) && fine(z - y) {
            let [one, two, at] = found.unwrap_or([0.0, 0.0, x]);
            let at = if b - a > one { x } else { at };
            found = Some([one.max(b - a).max(c - b), two.max(c - a), at]);
        }
    }
    found
}

/// A jump stays in one step of the grid, however fine; a slope is shared by all.
fn expected_jump(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = e.results.sweep()?;
    let Some([one, two, _]) = increases(sweep) else {
        return Ok(open(Text::words("too few rows"), "The grid of σ is too coarse."));
    };
    let half = sec2::gaps(sweep) / 2.0;
    let ratio = two / one;
    Ok(Finding {
        ours: Text::words("largest step between neighbouring σ: ").significant(one, 2).say(" gaps"),
        tolerance: Text::words("at least ").significant(half, 3),
        reason: "ours: a jump is a step of half the height or more",
        judgement: Judgement::Explained { agrees: one >= half, holds: ratio > 1.5 },
        note: Text::words(
            "The rise is steep but gradual: over two steps of the grid the mean increases ",
        )
        .significant(ratio, 2)
        .say(" times as much as over one; a slope would give 2, a jump 1."),
    })
}

fn no_impact(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = e.results.sweep()?;
    let nucleation = &e.results.identities.nucleation;
    let (mut rows, mut above, mut worst) = (0, 0, f64::INFINITY);
    for row in &sweep.rows {
        let Some(predicted) = nucleation.iter().find(|n| n.sigma == row.sigma) else { continue };
        let ran = (row.realisations - row.rejected - row.failed) as f64;
        if ran == 0.0 {
            continue;
        }
        rows += 1;
        let kept = row.kept as f64 / ran;
        let p = predicted.any_rest;
        let error = (p * (1.0 - p) / ran).sqrt();
        // One realisation of room where the binomial is far from normal.
        above += usize::from(kept > p + e.level.among(sweep.rows.len()) * error + 1.0 / ran);
        if p > 0.3 && p < 0.999 {
            worst = worst.min(kept / p);
        }
    }
    if !worst.is_finite() {
        return Ok(open(Text::words("no row"), "No row lies in the range that tells."));
    }
    Ok(Finding {
        ours: Text::words("kept chains exceed the estimate at ")
            .integer(above)
            .say(" of ")
            .integer(rows)
            .say(" σ; they are at least ")
            .significant(worst, 2)
            .say(" of it where it is above 0.3"),
        tolerance: Text::words("none above; at least two thirds"),
        reason: "the estimate takes gaps as independent and time as infinite; the statistical \
                 error is shared by all rows",
        judgement: Judgement::Plain { agrees: above == 0 && worst > 0.667 },
        note: Text::words(
            "The estimate is 1 − (1 − p_rest)^N, with the amplitudes of a start from rest in the \
             condition of Eq. (20).",
        ),
    })
}

fn p_small(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let theory = &e.results.theory;
    let (p, scalars) = (theory.slips.p_at_015, &theory.scalars);
    let printed = s.number()?;
    Ok(Finding {
        ours: Text::words("p = ").significant(p, 3).say(" at σ = ").chosen(printed),
        tolerance: Text::words("below p_crit"),
        reason: "too small for the theory to show anything: below the first change of k*",
        judgement: Judgement::Explained {
            agrees: p < scalars.p_crit,
            holds: scalars.sigma_crit < scalars.sigma_jump
                && scalars.sigma_jump < printed
                && p > scalars.p_jump,
        },
        note: Text::words("p reaches p_crit at σ = ")
            .significant(scalars.sigma_crit, 4)
            .say(" and p_jump at ")
            .significant(scalars.sigma_jump, 4)
            .say(", both below the printed value; it is steep, and small only well below them."),
    })
}

/// A column of a theory curve at any σ in its range, linear between its rows.
pub(crate) fn at(curve: &Curve, sigma: f64, column: fn(&CurveRow) -> f64) -> Option<f64> {
    let w = curve.rows.windows(2).find(|w| w[0].sigma <= sigma && sigma <= w[1].sigma)?;
    let share = (sigma - w[0].sigma) / (w[1].sigma - w[0].sigma);
    Some(column(&w[0]) + share * (column(&w[1]) - column(&w[0])))
}

/// From here on σ is called large (ours).
pub(crate) const LARGE_SIGMA: f64 = 0.2;

/// Largest distance of theory and simulation at large σ, in gaps, and where.
pub(crate) fn largest_distance(sweep: &Sweep, curve: &Curve) -> Option<[f64; 2]> {
    let rows = sweep.rows.iter().filter(|row| row.sigma >= LARGE_SIGMA);
    let distances = rows.filter_map(|row| {
        let theory = at(curve, row.sigma, |r| r.simple)?;
        Some([(row.mean_distinct? - theory).abs(), row.sigma])
    });
    distances.fold(None, |most: Option<[f64; 2]>, one| match most {
        Some(most) if most[0] >= one[0] => Some(most),
        _ => Some(one),
    })
}

fn large_sigma(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = e.results.sweep()?;
    let Some([distance, at]) = largest_distance(sweep, &e.results.theory.curve) else {
        return Ok(open(Text::words("no row"), "The sweep has no row at large σ."));
    };
    let limit = sec2::gaps(sweep) / 10.0;
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
            .say("; both curves must approach the number of gaps."),
    })
}

/// How much of the distance between theory and simulation the start explains: half heights from
/// rest, from random free parts, and of the theory.
pub(crate) fn share_of_start(rest: f64, random: f64, theory: f64) -> f64 {
    (random - rest) / (theory - rest)
}

fn threshold_shift(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = e.results.sweep()?;
    let starts = e.results.starts()?;
    let half = |name| starts.variant(name).and_then(|variant| variant.rise.half_height_all);
    let (Some(simulated), Some(rest), Some(random)) =
        (sweep.rise.half_height, half("rest"), half("random"))
    else {
        return Ok(open(Text::words("no rise"), "A mean does not pass half of all gaps."));
    };
    let scalars = &e.results.theory.scalars;
    let share = share_of_start(rest.value, random.value, scalars.sigma_half);
    let error = (random.error * random.error + rest.error * rest.error).sqrt()
        / (scalars.sigma_half - rest.value);
    let [low, high] = e.published.statement("sec2_half_height")?.rounding()?;
    let distance = scalars.sigma_half - simulated.value;
    Ok(Finding {
        ours: Text::words("half height of the theory at σ = ")
            .significant(scalars.sigma_half, 4)
            .say(", of the simulation at ")
            .with_error(simulated.value, simulated.error),
        tolerance: Text::words("± ").significant((high - low) / 2.0, 1),
        reason: "half a unit of the last digit in which the paper prints the threshold",
        judgement: Judgement::Explained {
            agrees: distance.abs() <= (high - low) / 2.0,
            holds: share > 0.5 - e.level.quantile * error && share < 1.0 + e.level.quantile * error,
        },
        note: Text::words(
            "Eq. (25) assumes random free parts. Simulated with them the half height is ",
        )
        .with_error(random.value, random.error)
        .say(": the start alone explains ")
        .with_error(share, error)
        .say(" of the difference, and the explanation asks for more than half."),
    })
}

/// Width of the mode's bootstrap interval over that of the mean, in the rise: the median.
pub(crate) fn mode_over_mean(sweep: &Sweep) -> Option<f64> {
    let rise = [sweep.rise.onset?.value, sweep.rise.half_height_all?.value];
    let rows = sweep.rows.iter().filter(|row| rise[0] <= row.sigma && row.sigma <= rise[1]);
    let mut ratios: Vec<f64> = rows
        .filter_map(|row| {
            let [low, high] = row.mode_interval?;
            let [from, to] = row.mean_interval?;
            (to > from).then(|| (high - low) as f64 / (to - from))
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    (!ratios.is_empty()).then(|| ratios[ratios.len() / 2])
}

fn mean_is_easier(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let Some(ratio) = mode_over_mean(e.results.sweep()?) else {
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
