//! Draws Fig. 10: how the jump of the most likely number of impacts comes about.

use super::prelude::*;
use crate::experiments::theory::jump::{f, stages, zeros};
use crate::experiments::theory::law::{k_star, simple, steps};
use crate::params::VERTICES as N;

pub fn draw() -> Result<Figure, Error> {
    let rows = stages();
    let sheet = Sheet::new(850 + 2350 * rows.len() as u32);
    // Beyond this k nothing changes sign again.
    let last_zero = rows.into_iter().filter_map(zeros).map(|z| z[1]).fold(20.0, f64::max);
    let shown = ((1.8 * last_zero / 10.0).ceil() * 10.0).min(N as f64);
    for (i, at) in rows.into_iter().enumerate() {
        let edge = 550 + 2350 * i as i32;
        let k = || {
            let axis = Axis::linear(0.0, shown, 10.0, 2, "*k*");
            if i + 1 == rows.len() { axis } else { axis.without_numbers() }
        };
        let letter = LETTERS[i];
        let left = sheet.panel(Frame::new(1000, edge, 4000, edge + 1700), k(), signs(at))?;
        let p = match i {
            0 => "*p* → 0".to_string(),
            1 => format!("*p* = *p*_{{crit}} = {}", short(at, 4)),
            3 => format!("*p* = *p*_{{jump}} = {}", short(at, 4)),
            _ => format!("*p* = {}", short(at, 4)),
        };
        left.heading(letter, &p)?;
        left.set_suffix(&format!("{letter}-f"));
        sign(&left, at)?;
        let mut columns = simple(at);
        columns.truncate(shown as usize);
        let room = if i == 0 { 1.0 } else { 1.02 };
        let y = Axis::up_to(room * largest(&columns), "Φ_{*N*,*p*}(*k*) / Γ_{*N*,*p*}");
        let right = sheet.panel(Frame::new(5250, edge, 8250, edge + 1700), k(), y)?;
        right.set_suffix(&format!("{letter}-phi"));
        // At the jump two columns are the highest.
        let (jump, after) = steps()[1];
        let highest = if at == jump { vec![1, after] } else { vec![k_star(at)] };
        weight(&right, &highest, &columns)?;
        if let (0, Some(&height)) = (i, columns.first()) {
            // Named once, where all else is low.
            right.label("height at *k* = 1", (right.x.hi, height), (-1, 1), INK)?;
        }
    }
    let description = describe!(
        "Four rows for rising p, N = {N}, over k. Left f, whose sign tells whether the weight Φ grows from k to \
         k + 1; right, Φ divided by its sum. Where f turns positive a second maximum grows; in the last row it equals the first \
         column, and the most likely number jumps from 1 to {}.",
        steps()[1].1
    );
    Ok(sheet.finish("The mechanism of the jump", description))
}

/// The axis of f: around zero, as high as its maximum.
fn signs(p: f64) -> Axis {
    let top = f(p).iter().map(|point| point.1).fold(0.0, f64::max);
    let step = (top / 2.0).ceil().max(1.0);
    let hi = if top <= 1.0 { 1.0 } else { 2.0 * step };
    Axis::linear(-3.0 * step, hi, step, 1, "*f*_{*N*,*p*}(*k*)")
}

fn sign(panel: &Panel, p: f64) -> Drawn {
    let panel = panel.outside(Outside::Cut);
    panel.level("zero", 0.0, Stroke::solid(GREY, HAIR))?;
    panel.curve("f", &f(p), Stroke::solid(INK, LINE))?;
    let Some(zeros) = zeros(p) else {
        return panel.label("*f* < 0: no zero", (5.0, -1.0), (1, 0), INK);
    };
    let at = zeros.map(|k| (k, 0.0));
    panel.markers("zeros of f", &at, (Symbol::Disc, 60, Stroke::solid(INK, HAIR)))?;
    if zeros[0] == zeros[1] {
        return panel.label("double zero", at[0], (1, -1), INK);
    }
    // Clear of the curve: below the line inside the arch, above it outside.
    panel.label("*k*_{−}", at[0], (1, 1), INK)?;
    panel.label("*k*_{+}", at[1], (1, -1), INK)
}

fn weight(panel: &Panel, highest: &[usize], shown: &[f64]) -> Drawn {
    panel.columns("weight", shown, Stroke::solid(GREEN, THIN))?;
    let first = shown.first().copied().unwrap_or(0.0);
    let level = Stroke::dashed(INK, HAIR, SHORT);
    panel.guide("height at k = 1", &[(0.5, first), (panel.x.hi, first)], level)?;
    for &k in highest {
        let at = (k as f64, shown[k - 1]);
        panel.markers("most likely", &[at], (Symbol::Disc, 75, Stroke::solid(PURPLE, HAIR)))?;
        // Next to the first column, under the broken line; above the other columns.
        match (k, highest.len()) {
            (1, 1) => panel.label("*k*^{∗} = 1", at, (2, 1), PURPLE)?,
            (1, _) => (),
            _ => panel.label(&format!("*k*^{{∗}} = 1 or {k}"), at, (1, -1), PURPLE)?,
        }
    }
    Ok(())
}
