//! Fig. 9: (a) the most likely and (b) the expected number of impacts against p.

use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::theory::law::{means, steps};
use crate::params::VERTICES as N;

/// Largest p of the insets.
const SMALL_P: f64 = 0.04;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(9600);
    let top = (N as f64 / 20.0).ceil() * 20.0;
    let labels = ["*k*^{∗}", "*μ*"];
    let mut panels = Vec::new();
    for (i, edge) in [(0, 430), (1, 5130)] {
        let y = |low: f64| Axis::linear(low, top, 20.0, 2, labels[i]);
        let x = |end: f64, step: f64| Axis::linear(0.0, end, step, 2, "*p*");
        let frame = Frame::new(1150, edge, 8150, edge + 3450);
        let panel = sheet.lettered(LETTERS[i], frame, x(1.0, 0.2), y(0.0))?;
        // The levels at one are seen above the axis.
        let frame = Frame::new(3300, edge + 460, 7700, edge + 2450);
        let inset = sheet.inset(frame, x(SMALL_P, 0.01), y(-6.0))?;
        panels.push((panel, inset));
    }
    let p_jump = results.number("theory.jump.p_jump")?;
    let jump = results.number("theory.jump.k_after")?;
    for panel in [&panels[0].0, &panels[0].1] {
        most_likely([p_jump, jump], panel)?;
    }
    let inset = &panels[0].1;
    let look = |mark| (mark, 50, Stroke::solid(GREEN, THIN));
    inset.marks("before the jump", &[(p_jump, 1.0)], look(Mark::Disc), Outside::Refuse)?;
    inset.marks("after the jump", &[(p_jump, jump)], look(Mark::Ring), Outside::Refuse)?;
    let note = format!("from 1 to {jump} at *p* = {}", short(p_jump, 4));
    inset.note(&note, (p_jump, jump / 2.0), (110, 0), (TINY, INK, HPos::Left, VPos::Center))?;

    let [mean, fine] = means();
    let stroke = Stroke::solid(GREEN, LINE);
    panels[1].0.curve("mean", &mean, stroke, Outside::Refuse)?;
    let inset = panels[1].1.clone().file("b-inset");
    inset.curve("mean, small p", &fine, stroke, Outside::Cut)?;
    inset.level("limit 1", 1.0, Stroke::dashed(GREY, HAIR, Dash::Short))?;
    let look = (TINY, INK, HPos::Right, VPos::Bottom);
    inset.note("*μ* → 1 as *p* → 0", (SMALL_P, 1.0), (-60, -90), look)?;

    let description = seen!(
        "Against the edge probability p, for N = {N}, with insets for small p: (a) the most likely number of impacts is 1 up \
         to p = {}, jumps there to {jump} and climbs on in steps of one; (b) the expected number rises from 1 without a jump \
         and levels off towards {N}.",
        short(p_jump, 4),
    );
    Ok(sheet.finish("fig09", "Most likely and expected number of impacts", description))
}

/// k* as a staircase; its jump from 1 is dotted, because no value lies between.
fn most_likely([jump, first]: [f64; 2], panel: &Panel) -> Result<(), Error> {
    let solid = Stroke::solid(GREEN, LINE);
    let mut stairs: Vec<(f64, f64)> = Vec::new();
    for (p, k_star) in steps().into_iter().filter(|(_, k_star)| *k_star > 1) {
        stairs.extend(stairs.last().map(|before| (p, before.1)));
        stairs.push((p, k_star as f64));
    }
    stairs.extend(stairs.last().map(|last| (1.0, last.1)));
    panel.curve("most likely number, 1", &[(0.0, 1.0), (jump, 1.0)], solid, Outside::Cut)?;
    panel.curve("most likely number", &stairs, solid, Outside::Cut)?;
    let dotted = Stroke::dashed(GREEN, THIN, Dash::Dotted);
    panel.guide("jump", &[(jump, 1.0), (jump, first)], dotted)
}
