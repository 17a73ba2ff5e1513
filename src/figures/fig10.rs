//! Fig. 10: how the jump of the most likely number of impacts comes about.

use super::prelude::*;
use crate::experiments::theory::law::{f, k_star, simple, stages, zeros};
use crate::params::VERTICES as N;

pub fn draw() -> Result<Figure, Error> {
    let rows = stages();
    let sheet = Sheet::new(850 + 2350 * rows.len() as u32);
    // Beyond this k nothing changes sign again.
    let last_zero = rows.into_iter().filter_map(zeros).map(|z| z[1]).fold(20.0, f64::max);
    let shown = ((1.8 * last_zero / 10.0).ceil() * 10.0).min(N as f64);
    for (i, at) in rows.into_iter().enumerate() {
        let edge = 550 + 2350 * i as i32;
        let last = i + 1 == rows.len();
        let k = || {
            let axis = Axis::linear(0.0, shown, 10.0, 2, "*k*");
            if last { axis } else { axis.bare() }
        };
        let letter = LETTERS[i].trim_matches(['(', ')']);
        let left = sheet.panel(Frame::new(1000, edge, 4000, edge + 1700), k(), signs(at))?;
        let left = left.file(&format!("{letter}-f"));
        let p = match i {
            0 => "*p* → 0".to_string(),
            1 => format!("*p* = *p*_{{crit}} = {}", short(at, 4)),
            _ => format!("*p* = {}", short(at, 4)),
        };
        let (words, look) = (format!("{} {p}", LETTERS[i]), (SMALL, INK, HPos::Left, VPos::Bottom));
        left.note(&words, (0.0, left.y.hi), (60, -90), look)?;
        sign(&left, at)?;
        let mut columns = simple(at);
        columns.truncate(shown as usize);
        let room = if i == 0 { 1.0 } else { 1.02 };
        let y = upwards_from_zero(room * largest(&columns), "Φ_{*N*,*p*}(*k*) / Γ_{*N*,*p*}");
        let right = sheet.panel(Frame::new(5250, edge, 8250, edge + 1700), k(), y)?;
        let right = right.file(&format!("{letter}-phi"));
        weight(&right, k_star(at), &columns)?;
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
        rows.map(|p| k_star(p).to_string()).join(", ")
    );
    Ok(sheet.finish("fig10", "The mechanism of the jump", description))
}

/// The axis of f: around zero, as high as its maximum.
fn signs(p: f64) -> Axis {
    let top = f(p).iter().map(|point| point.1).fold(0.0, f64::max);
    let step = (top / 2.0).ceil().max(1.0);
    let hi = if top <= 1.0 { 1.0 } else { 2.0 * step };
    Axis::linear(-3.0 * step, hi, step, 1, "*f*_{*N*,*p*}(*k*)")
}

fn sign(panel: &Panel, p: f64) -> Result<(), Error> {
    panel.level("zero", 0.0, Stroke::solid(GREY, HAIR))?;
    panel.curve("f", &f(p), Stroke::solid(BLUE, LINE), Outside::Cut)?;
    if let Some(zeros) = zeros(p) {
        let at = zeros.map(|k| (k, 0.0));
        let disc = (Mark::Disc, 60, Stroke::solid(BLUE, HAIR));
        panel.marks("zeros of f", &at, disc, Outside::Cut)?;
        if zeros[0] < zeros[1] {
            // Where the curve is not: below the line inside the arch, above it outside.
            panel.note("*k*_{−}", at[0], (90, 110), (SMALL, INK, HPos::Left, VPos::Top))?;
            panel.note("*k*_{+}", at[1], (60, -110), (SMALL, INK, HPos::Left, VPos::Bottom))?;
        }
    }
    Ok(())
}

fn weight(panel: &Panel, k_star: usize, shown: &[f64]) -> Result<(), Error> {
    panel.columns("weight", shown, Stroke::solid(GREEN, THIN))?;
    let first = shown.first().copied().unwrap_or(0.0);
    let level = Stroke::dashed(INK, HAIR, Dash::Short);
    panel.guide("height at k = 1", &[(0.5, first), (panel.x.hi, first)], level)?;
    if let Some(&top) = shown.get(k_star.saturating_sub(1)) {
        let at = (k_star as f64, top);
        let disc = (Mark::Disc, 75, Stroke::solid(RED, HAIR));
        panel.marks("most likely", &[at], disc, Outside::Refuse)?;
        // Beside the first column, under the broken line; above the other columns.
        let (offset, v) =
            if k_star == 1 { ((130, 80), VPos::Top) } else { ((60, -110), VPos::Bottom) };
        let look = (SMALL, RED, HPos::Left, v);
        panel.note(&format!("*k*^{{∗}} = {}", k_star), at, offset, look)?;
    }
    Ok(())
}
