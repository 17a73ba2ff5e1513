//! Draws Fig. 14: simple and higher-order distributions become alike as p grows.

use super::prelude::*;
use crate::experiments::theory::higher::five;
use crate::experiments::theory::law::simple;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(6950);
    let mut sentences = Vec::new();
    let top = largest(&CONVERGENCE_P.map(|p| largest(&five(p)).max(largest(&simple(p)))));
    for (i, at) in CONVERGENCE_P.into_iter().enumerate() {
        let x = Axis::linear(0.0, N as f64 + 1.0, 20.0, 2, "*k*");
        let x = if i == 0 { x.without_numbers() } else { x };
        let y = Axis::up_to(top, "*P*(*X* = *k*)");
        let edge = 480 + 3100 * i as i32;
        let (frame, p) = (Frame::new(1200, edge, 8150, edge + 2450), short(at, 3));
        let panel = sheet.lettered(&format!("{} *p* = {p}", LETTERS[i]), frame, x, y)?;
        panel.set_suffix(LETTERS[i]);
        for (name, values, side, stroke) in [
            ("simple circuits", simple(at), -1, Look::THEORY.line),
            ("higher orders", five(at), 1, Look::HIGHER.line),
        ] {
            let (points, peak) = (over_k(&values), largest(&values));
            panel.curve(name, &points, stroke)?;
            let k_star = points.iter().find(|point| point.1 == peak).map_or(0.0, |point| point.0);
            // Each is named at its outer flank, near the peak.
            let mut flank = points.into_iter().filter(|point| point.1 >= 0.85 * peak);
            let at = if side < 0 { flank.next() } else { flank.next_back() }.unwrap_or_default();
            panel.label(name, at, (side, -5), stroke.colour)?;
            panel.label(&format!("*k*^{{∗}} = {k_star}"), at, (side, -1), stroke.colour)?;
        }
        let distance = short(results.number(&format!("theory.classes[p={at}].variation"))?, 3);
        sentences.push(format!("{} p = {p}: total variation distance {distance}", LETTERS[i]));
    }
    let description = describe!(
        "Probability of k different impacts, N = {N}, of simple circuits and with higher orders (broken line). The two curves \
         lie apart in (a) and nearly on each other in (b). {}.",
        sentences.join("; ")
    );
    Ok(sheet.finish("Simple and higher-order distributions converge", description))
}
