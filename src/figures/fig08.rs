//! Draws Fig. 8: the distribution of the number of different impacts at four p, in one panel.

use super::prelude::*;
use crate::experiments::theory::law::simple;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(5150);
    let mut sentences = Vec::new();
    let top = DISTRIBUTION_P.into_iter().map(|p| largest(&simple(p))).fold(0.0, f64::max);
    let x = Axis::linear(0.0, N as f64 + 1.0, 20.0, 4, "*k*");
    let y = Axis::up_to(top, "*P*(*X* = *k*)");
    let panel = sheet.panel(Frame::new(1150, 230, 8200, 4230), x, y)?;
    for (i, at) in DISTRIBUTION_P.into_iter().enumerate() {
        let cell = |column| results.number(&format!("theory.distribution[p={at}].{column}"));
        let (probability, k_star) = (simple(at), cell("k_star")?);
        let (letter, p, mean) = (LETTERS[i], short(at, 3), short(cell("mean")?, 3));
        let name = format!("probability at p = {p}");
        panel.columns(&name, &probability, Stroke::solid(GREEN, THIN))?;
        // Names stand to the left; near the last hump is the third, so a line leads to its name.
        let peak = largest(&probability);
        let (place, side) = match i {
            0 => ((3.0, peak), [(1, 0), (1, 3)]),
            3 => ((k_star, 1.6 * peak), [(0, -4), (0, -1)]),
            _ => ((k_star - 3.0, peak), [(-1, -4), (-1, -1)]),
        };
        if i == 3 {
            panel.guide("leader", &[(k_star, 1.05 * peak), place], Stroke::solid(INK, HAIR))?;
        }
        panel.label(&format!("{letter} *p* = {p}"), place, side[0], INK)?;
        panel.label(&format!("*k*^{{∗}} = {k_star}, *μ* = {mean}"), place, side[1], INK)?;
        sentences.push(format!("{letter} p = {p}: mean {mean}"));
    }
    let description = describe!(
        "Columns over k = 1 … {N}: the probability of k different impacts for simple circuits, N = {N}. With p \
         the weight moves from single impacts to the whole system. {}.",
        sentences.join("; ")
    );
    Ok(sheet.finish("Distribution of the number of impacts", description))
}
