//! Theory beside simulation: means from histograms, and from distributions by logarithms.

use super::model::{Column, mean_at};
use super::{Guard, Look, far, unless};
use crate::experiments::sweep::SweepRow;

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "theory_at_sigma",
        ids: &["compare.*", "theory_between", "sigma_between"],
        find: columns,
    },
    Guard {
        name: "distances_to_theory",
        ids: &["rms_*", "large_distance", "large_sigma"],
        find: distances,
    },
    Guard { name: "gap_of_half_heights", ids: &["sigma_gap", "sigma_half_theory"], find: gap },
    Guard {
        name: "change_by_higher_orders",
        ids: &["fig15_*", "relation_over_higher"],
        find: change,
    },
];

/// Theory as the curve has it: in a straight line between the points of its grid.
fn on_curve(look: Look<'_>, sigma: f64, column: Column) -> Option<f64> {
    let curve = &look.results.theory.curve;
    let after = curve.rows.iter().position(|row| row.sigma >= sigma)?.max(1);
    let (a, b) = (curve.rows.get(after - 1)?.sigma, curve.rows.get(after)?.sigma);
    let [low, high] = [a, b].map(|sigma| mean_at(curve.vertices, sigma, column));
    Some(((b - sigma) * low + (sigma - a) * high) / (b - a))
}

/// The theory beside a simulated mean is the mean of Eq. (9), or of Eq. (38), at the p of this σ.
fn columns(look: Look<'_>) -> Option<String> {
    let columns = [("simple", Column::Simple), ("higher", Column::Higher), ("rest", Column::Rest)];
    let lines = look.values.iter().filter_map(|value| {
        let line = value.id.strip_suffix("_sigma").filter(|line| line.starts_with("compare."))?;
        Some((line.to_string(), look.number(&value.id)?))
    });
    let mut cells = lines.flat_map(|(line, sigma)| {
        columns.map(|(name, column)| (format!("{line}_{name}"), sigma, column))
    });
    cells.find_map(|(id, sigma, column)| look.is(&id, on_curve(look, sigma, column)?)).or_else(
        || {
            look.is(
                "theory_between",
                on_curve(look, look.number("sigma_between")?, Column::Simple)?,
            )
        },
    )
}

fn simulated(row: &SweepRow) -> Option<f64> {
    let [n, sum] = totals(&row.counts, 1);
    (n > 0.0).then(|| sum / n)
}

/// The root of the mean square is that of the square of the mean and the variance of the differences;
/// the largest distance beyond a σ is reached and never passed.
fn distances(look: Look<'_>) -> Option<String> {
    let sweep = look.results.sweep().ok()?;
    let large = look.number("large_sigma")?;
    let differences = |column: Column, beyond: bool| -> Vec<f64> {
        let rows = sweep.rows.iter().filter(|row| (row.sigma >= large) == beyond);
        rows.filter_map(|row| Some(simulated(row)? - on_curve(look, row.sigma, column)?)).collect()
    };
    let root = |column: Column| {
        let all = differences(column, false);
        let n = all.len() as f64;
        let mean = all.iter().sum::<f64>() / n;
        let variance = all.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>() / n;
        (mean * mean + variance).sqrt()
    };
    let most = differences(Column::Simple, true).into_iter().map(f64::abs).fold(0.0, f64::max);
    look.are([
        ("rms_simple", root(Column::Simple)),
        ("rms_higher", root(Column::Higher)),
        ("rms_rest", root(Column::Rest)),
        ("large_distance", most),
    ])
}

/// From the simulated half height by the gap to where the theory's mean is half way.
fn gap(look: Look<'_>) -> Option<String> {
    let theory = &look.results.theory;
    let there = look.number("sweep.rise.half_height")? + look.number("sigma_gap")?;
    let mean = mean_at(theory.vertices, there, Column::Simple);
    far(
        "the mean at sigma_gap beyond the simulated half height",
        mean,
        0.5 * (theory.vertices as f64 + 1.0),
    )
}

/// Higher orders change the mean nowhere on the grid by more than where they are said to; they move the
/// half height by the shift, and the jump by as much less than another relation of p and σ as is said.
fn change(look: Look<'_>) -> Option<String> {
    let theory = &look.results.theory;
    let big_n = theory.curve.vertices;
    let change = |sigma: f64| {
        (mean_at(big_n, sigma, Column::Higher) - mean_at(big_n, sigma, Column::Simple)).abs()
    };
    let at = look.number("fig15_largest_at")?;
    // The curve is smooth: its neighbours on the grid tell whether this is the largest.
    let place = theory.curve.rows.iter().position(|row| row.sigma == at);
    let Some(place) = place.filter(|&i| i > 0 && i + 1 < theory.curve.rows.len()) else {
        return Some(format!("fig15_largest_at is {at}, which is no inner point of the curve"));
    };
    let beside = [place - 1, place + 1].map(|i| change(theory.curve.rows[i].sigma));
    let top = change(at);
    look.is("fig15_largest", top)
        .or_else(|| {
            unless(beside.iter().all(|b| *b <= top), || format!("no largest change at {at}"))
        })
        .or_else(|| {
            let there = theory.scalars.sigma_half - look.number("fig15_shift")?;
            let mean = mean_at(big_n, there, Column::Higher);
            far("the mean at fig15_shift before the half height", mean, 0.5 * (big_n as f64 + 1.0))
        })
        .or_else(|| {
            // From the jump by Eq. (25) back by a share of the way to that of a start from rest.
            let scalars = &theory.scalars;
            let way = (scalars.sigma_jump - scalars.sigma_jump_rest).abs();
            let step = way / look.number("relation_over_higher")?;
            let ends = [-1.0, 1.0].map(|side| super::model::p(scalars.sigma_jump + side * step));
            let near = ends.into_iter().map(|p| (p / scalars.higher_p_jump - 1.0).abs());
            let off = near.fold(f64::INFINITY, f64::min);
            unless(off <= super::ROUNDING, || "relation_over_higher leads to no jump".into())
        })
}

/// Number and sum of all counts from `from` on.
fn totals(counts: &[u32], from: usize) -> [f64; 2] {
    let own = counts.iter().enumerate().skip(from);
    own.fold([0.0, 0.0], |[n, sum], (k, &c)| [n + f64::from(c), sum + k as f64 * f64::from(c)])
}
