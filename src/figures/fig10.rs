//! Draws Fig. 10: how the jump of the most likely number of impacts comes about.

use super::prelude::*;
use crate::experiments::theory::jump::{f, stages, zeros};
use crate::experiments::theory::law::{k_star, simple, steps};

/// The p of the rows: those of [`stages`], in their order.
#[derive(Clone, Copy, PartialEq)]
enum Stage {
    Zero,
    Critical,
    Between,
    Jump,
}

const STAGES: [Stage; 4] = [Stage::Zero, Stage::Critical, Stage::Between, Stage::Jump];

pub fn draw() -> Result<Figure, Error> {
    // The first step of k* is its jump from 1.
    let (_, k_after_jump) = steps()[1];
    let sheet = Sheet::new(850 + 2350 * STAGES.len() as u32);
    // Beyond this k nothing changes sign again.
    let last_zero = stages().into_iter().filter_map(zeros).map(|z| z[1]).fold(20.0, f64::max);
    let last_k = ((1.8 * last_zero / 10.0).ceil() * 10.0).min(N as f64);
    for (i, (stage, p)) in STAGES.into_iter().zip(stages()).enumerate() {
        let edge = 550 + 2350 * i as i32;
        let k = || {
            let axis = Axis::linear(0.0, last_k, 10.0, 2, "*k*");
            if stage == Stage::Jump { axis } else { axis.without_numbers() }
        };
        let letter = LETTERS[i];
        let left = sheet.panel(Frame::new(1000, edge, 4000, edge + 1700), k(), axis_of_f(p))?;
        let heading = match stage {
            Stage::Zero => "*p* → 0".to_string(),
            Stage::Critical => format!("*p* = *p*_{{crit}} = {}", short(p, 4)),
            Stage::Between => format!("*p* = {}", short(p, 4)),
            Stage::Jump => format!("*p* = *p*_{{jump}} = {}", short(p, 4)),
        };
        left.heading(letter, &heading)?;
        left.set_suffix(&format!("{letter}-f"));
        draw_f(&left, p)?;
        let mut columns = simple(p);
        columns.truncate(last_k as usize);
        let room = if stage == Stage::Zero { 1.0 } else { 1.02 };
        let y = Axis::up_to(room * largest(&columns), "Φ_{*N*,*p*}(*k*) / Γ_{*N*,*p*}");
        let right = sheet.panel(Frame::new(5250, edge, 8250, edge + 1700), k(), y)?;
        right.set_suffix(&format!("{letter}-phi"));
        // At the jump two columns are the highest.
        let highest = if stage == Stage::Jump { vec![1, k_after_jump] } else { vec![k_star(p)] };
        draw_distribution(&right, &highest, &columns)?;
        if let (Stage::Zero, Some(&height)) = (stage, columns.first()) {
            // Named once, where all else is low.
            right.label("height at *k* = 1", (right.x.hi, height), (-1, 1), INK)?;
        }
    }

    let description = describe!(
        "Four rows for rising p, N = {N}, over k. Left f, whose sign tells whether the weight Φ grows from k to \
         k + 1; right, Φ divided by its sum. Where f turns positive a second maximum grows; in the last row it equals the first \
         column, and the most likely number jumps from 1 to {}.",
        k_after_jump
    );
    Ok(sheet.finish("The mechanism of the jump", description))
}

/// Makes the axis of f: around zero, as high as its maximum.
fn axis_of_f(p: f64) -> Axis {
    let top = f(p).iter().map(|point| point.1).fold(0.0, f64::max);
    let step = (top / 2.0).ceil().max(1.0);
    let hi = if top <= 1.0 { 1.0 } else { 2.0 * step };
    Axis::linear(-3.0 * step, hi, step, 1, "*f*_{*N*,*p*}(*k*)")
}

fn draw_f(panel: &Panel, p: f64) -> Drawn {
    let panel = panel.outside(Cut);
    panel.level("zero", 0.0, Stroke::solid(GREY, HAIR))?;
    panel.curve("f", &f(p), Stroke::solid(INK, LINE))?;
    let Some(zeros) = zeros(p) else {
        return panel.label("*f* < 0: no zero", (5.0, -1.0), (1, 0), INK);
    };
    let points = zeros.map(|k| (k, 0.0));
    panel.markers("zeros of f", &points, (Symbol::Disc, 60, Stroke::solid(INK, HAIR)))?;
    if zeros[0] == zeros[1] {
        return panel.label("double zero", points[0], (1, -1), INK);
    }
    // Clear of the curve: below the line inside the arch, above it outside.
    panel.label("*k*_{−}", points[0], (1, 1), INK)?;
    panel.label("*k*_{+}", points[1], (1, -1), INK)
}

/// Draws the columns, with a mark on each of the highest.
fn draw_distribution(panel: &Panel, highest: &[usize], columns: &[f64]) -> Drawn {
    panel.columns("weight", columns, Stroke::solid(GREEN, THIN))?;
    let first = columns.first().copied().unwrap_or(0.0);
    let level = Stroke::dashed(INK, HAIR, SHORT);
    panel.guide("height at k = 1", &[(0.5, first), (panel.x.hi, first)], level)?;
    for &k in highest {
        let point = (k as f64, columns[k - 1]);
        panel.markers("most likely", &[point], (Symbol::Disc, 75, Stroke::solid(PURPLE, HAIR)))?;
        // Next to the first column, under the broken line; above the other columns.
        match (k, highest.len()) {
            (1, 1) => panel.label("*k*^{∗} = 1", point, (2, 1), PURPLE)?,
            // The label of the other maximum names this one too.
            (1, _) => (),
            _ => panel.label(&format!("*k*^{{∗}} = 1 or {k}"), point, (1, -1), PURPLE)?,
        }
    }
    Ok(())
}
