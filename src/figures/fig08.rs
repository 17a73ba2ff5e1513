//! Fig. 8 (a) to (d): the distribution of the number of different impacts at four p.

use super::prelude::*;
use crate::experiments::theory::Theory;

pub fn draw(theory: &Theory) -> Result<Figure, Error> {
    let sheet = Sheet::new(6750);
    let n = theory.vertices;
    let mut seen = Vec::new();
    for (i, distribution) in theory.distributions.iter().take(4).enumerate() {
        let top = largest(&distribution.probability);
        let x = Axis::linear(0.0, n as f64 + 1.0, 20.0, 2, "*k*");
        let y = upwards_from_zero(1.04 * top, "*P*(*X* = *k*)");
        let panel = sheet.panel(FOUR[i], x, y)?;
        let p = short(distribution.p, 3);
        let own = panel.series(&format!("probability at p = {p}"));
        own.columns("probability", &distribution.probability, Stroke::solid(GREEN, THIN))?;
        heading(&panel, LETTERS[i], &format!("*p* = {p}"))?;
        let (k_star, mean) = (distribution.k_star, short(distribution.mean, 3));
        let lines = [format!("*k*^{{∗}} = {k_star}"), format!("*μ* = {mean}")];
        // The words go where the columns are low.
        let side = if k_star > n / 2 { HPos::Left } else { HPos::Right };
        corner(&panel, side, &lines)?;
        seen.push(format!("{} p = {p}: mean {mean}", LETTERS[i]));
    }
    let description = format!(
        "Columns over k = 1 … {n}: the probability of k different impacts for simple circuits, N = {n}. From panel to panel \
         the weight moves from single impacts to nearly the whole system. {}.",
        seen.join("; ")
    );
    Ok(sheet.finish("fig08", "Distribution of the number of impacts", description))
}
