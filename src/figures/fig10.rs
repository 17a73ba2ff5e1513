//! Fig. 10: how the jump of the most likely number of impacts comes about.

use super::prelude::*;
use crate::experiments::theory::law::{f, k_star, simple, stages, zeros};
use crate::params::VERTICES as N;

/// What a row shows.
struct Stage {
    /// Points of f.
    f: Vec<(f64, f64)>,
    zeros: Option<[f64; 2]>,
    /// Φ/Γ at k = 1, 2, ….
    weights: Vec<f64>,
    k_star: usize,
}

pub fn draw() -> Result<Figure, Error> {
    let row = |p| Stage { f: f(p), zeros: zeros(p), weights: simple(p), k_star: k_star(p) };
    let rows = stages().map(row);
    let sheet = Sheet::new(850 + 2350 * rows.len() as u32);
    // Beyond this k nothing changes sign again.
    let last_zero = rows.iter().filter_map(|row| row.zeros).map(|z| z[1]).fold(20.0, f64::max);
    let shown = ((1.8 * last_zero / 10.0).ceil() * 10.0).min(N as f64);
    for (i, (row, p)) in rows.iter().zip(stages()).enumerate() {
        let edge = 550 + 2350 * i as i32;
        let last = i + 1 == rows.len();
        let k = || {
            let axis = Axis::linear(0.0, shown, 10.0, 2, "*k*");
            if last { axis } else { axis.bare() }
        };
        let letter = LETTERS[i].trim_matches(['(', ')']);
        let left = sheet.panel(Frame::new(1000, edge, 4000, edge + 1700), k(), signs(row))?;
        let left = left.file(&format!("{letter}-f"));
        let p = match i {
            0 => "*p* → 0".to_string(),
            1 => format!("*p* = *p*_{{crit}} = {}", short(p, 4)),
            _ => format!("*p* = {}", short(p, 4)),
        };
        left.note(
            &format!("{} {p}", LETTERS[i]),
            (0.0, left.y.hi),
            (60, -90),
            (SMALL, INK, HPos::Left, VPos::Bottom),
        )?;
        sign(&left, row)?;
        let columns = &row.weights[..row.weights.len().min(shown as usize)];
        let room = if i == 0 { 1.0 } else { 1.02 };
        let y = upwards_from_zero(room * largest(columns), "Φ_{*N*,*p*}(*k*) / Γ_{*N*,*p*}");
        let right = sheet.panel(Frame::new(5250, edge, 8250, edge + 1700), k(), y)?;
        let right = right.file(&format!("{letter}-phi"));
        weight(&right, row, columns)?;
        if let (0, Some(&height)) = (i, columns.first()) {
            // Once, where all else is low.
            let look = (SMALL, INK, HPos::Right, VPos::Top);
            right.note("height at *k* = 1", (right.x.hi, height), (-60, 110), look)?;
        }
    }
    let description = seen!(
        "Four rows for rising p, N = {N}, over k. Left, the function f, whose sign tells whether the weight Φ grows from k to \
         k + 1; right, Φ divided by its sum. Where f turns positive a second maximum grows, until it overtakes the first \
         column: the most likely numbers are {}.",
        rows.iter().map(|row| row.k_star.to_string()).collect::<Vec<_>>().join(", ")
    );
    Ok(sheet.finish("fig10", "The mechanism of the jump", description))
}

/// The axis of f: around zero, as high as its maximum.
fn signs(row: &Stage) -> Axis {
    let top = row.f.iter().map(|point| point.1).fold(0.0, f64::max);
    let (hi, step) = if top <= 1.0 {
        (1.0, 1.0)
    } else if top <= 2.0 {
        (2.0, 1.0)
    } else {
        let step = (top / 2.0).ceil();
        (2.0 * step, step)
    };
    Axis::linear(-3.0 * step, hi, step, 1, "*f*_{*N*,*p*}(*k*)")
}

fn sign(panel: &Panel, row: &Stage) -> Result<(), Error> {
    let zero = Stroke::solid(GREY, HAIR);
    panel.level("zero", 0.0, zero)?;
    panel.curve("f", &row.f, Stroke::solid(BLUE, LINE), Outside::Cut)?;
    if let Some(zeros) = row.zeros {
        let at: Vec<_> = zeros.iter().map(|&k| (k, 0.0)).collect();
        panel.marks(
            "zeros of f",
            &at,
            (Mark::Disc, 60, Stroke::solid(BLUE, HAIR)),
            Outside::Cut,
        )?;
        if zeros[0] < zeros[1] {
            // Where the curve is not: below the line inside the arch, above it outside.
            panel.note("*k*_{−}", at[0], (90, 110), (SMALL, INK, HPos::Left, VPos::Top))?;
            panel.note("*k*_{+}", at[1], (60, -110), (SMALL, INK, HPos::Left, VPos::Bottom))?;
        }
    }
    Ok(())
}

fn weight(panel: &Panel, row: &Stage, shown: &[f64]) -> Result<(), Error> {
    panel.columns("weight", shown, Stroke::solid(GREEN, THIN))?;
    let first = shown.first().copied().unwrap_or(0.0);
    let level = Stroke::dashed(INK, HAIR, Dash::Short);
    panel.guide("height at k = 1", &[(0.5, first), (panel.x.hi, first)], level)?;
    if let Some(&top) = shown.get(row.k_star.saturating_sub(1)) {
        let at = (row.k_star as f64, top);
        panel.marks(
            "most likely",
            &[at],
            (Mark::Disc, 75, Stroke::solid(RED, HAIR)),
            Outside::Refuse,
        )?;
        // Beside the first column, under the broken line; above the other columns.
        let (offset, v) =
            if row.k_star == 1 { ((130, 80), VPos::Top) } else { ((60, -110), VPos::Bottom) };
        let look = (SMALL, RED, HPos::Left, v);
        panel.note(&format!("*k*^{{∗}} = {}", row.k_star), at, offset, look)?;
    }
    Ok(())
}
