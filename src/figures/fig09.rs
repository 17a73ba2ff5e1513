//! Draws Fig. 9: (a) the most likely and (b) the expected number of impacts against p.

use super::prelude::*;
use crate::experiments::theory::law::{means, steps};

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(7950);
    let top = (N as f64 / 20.0).ceil() * 20.0;
    // From below zero, so that the values at one are above the axis.
    let y = |label: &str| Axis::linear(-4.0, top, 20.0, 2, label);
    let p = || Axis::decades(-3, 0, 1, "*p*");
    let (frame, x) = (Frame::new(1150, 430, 8150, 3430), p().without_numbers());
    let mode = sheet.lettered("(a)", frame, x, y("most likely number *k*^{∗}"))?;
    let frame = Frame::new(1150, 4130, 8150, 7130);
    let mean = sheet.lettered("(b)", frame, p(), y("mean number *μ*"))?.outside(Cut);

    let p_jump = results.number("theory.jump.p_jump")?;
    let jump = results.number("theory.jump.k_after")?;
    most_likely([p_jump, jump], &mode)?;
    let jump_label = format!("from 1 to {jump} at *p* = {}", short(p_jump, 4));
    mode.label(&jump_label, (p_jump, jump / 2.0), (2, 0), INK)?;
    mean.curve("mean", &means(), Look::THEORY.line)?;
    mean.label("*μ* → 1 as *p* → 0", (mean.x.lo, 1.0), (3, -2), INK)?;

    let description = describe!(
        "Against the edge probability p on a logarithmic axis, for N = {N}: (a) the most likely number of impacts is 1 up \
         to p = {}, jumps there to {jump} and climbs on in steps of one; (b) the expected number rises from 1 without a jump \
         and levels off towards {N}.",
        short(p_jump, 4),
    );
    Ok(sheet.finish("Most likely and expected number of impacts", description))
}

/// k* as a staircase; its jump from 1 is dotted, because no value lies between.
fn most_likely([p_jump, jump]: [f64; 2], panel: &Panel) -> Drawn {
    let mut stairs: Vec<(f64, f64)> = Vec::new();
    for (p, k_star) in steps().into_iter().filter(|(_, k_star)| *k_star > 1) {
        stairs.extend(stairs.last().map(|before| (p, before.1)));
        stairs.push((p, k_star as f64));
    }
    stairs.extend(stairs.last().map(|last| (1.0, last.1)));
    panel.curve("most likely number, 1", &[(panel.x.lo, 1.0), (p_jump, 1.0)], Look::MODE.line)?;
    panel.curve("most likely number", &stairs, Look::MODE.line)?;
    panel.guide("jump", &[(p_jump, 1.0), (p_jump, jump)], Stroke::dashed(PURPLE, THIN, DOTTED))?;
    let look = |mark| (mark, 50, Stroke::solid(PURPLE, THIN));
    panel.markers("before the jump", &[(p_jump, 1.0)], look(Symbol::Disc))?;
    panel.markers("after the jump", &[(p_jump, jump)], look(Symbol::Ring))
}
