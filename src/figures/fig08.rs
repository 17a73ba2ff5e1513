//! Fig. 8 (a) to (d): the distribution of the number of different impacts at four p.

use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::theory::law::simple;
use crate::params::{DISTRIBUTION_P, VERTICES as N};

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(6750);
    let mut seen = Vec::new();
    for (i, at) in DISTRIBUTION_P.into_iter().enumerate() {
        let of = |column| results.number(&format!("theory.distribution[p={at}].{column}"));
        let (probability, k_star) = (simple(at), of("k_star")?);
        let top = largest(&probability);
        let x = Axis::linear(0.0, N as f64 + 1.0, 20.0, 2, "*k*");
        let y = upwards_from_zero(1.04 * top, "*P*(*X* = *k*)");
        let panel = sheet.panel(FOUR[i], x, y)?;
        let p = short(at, 3);
        panel.record(&format!("probability at p = {p}"), over_k(&probability));
        panel.quiet().columns("probability", &probability, Stroke::solid(GREEN, THIN))?;
        heading(&panel, LETTERS[i], &format!("*p* = {p}"))?;
        let mean = short(of("mean")?, 3);
        let lines = [format!("*k*^{{∗}} = {k_star}"), format!("*μ* = {mean}")];
        // The words go where the columns are low.
        let (side, x, dx) = match k_star > N as f64 / 2.0 {
            true => (HPos::Left, panel.x.lo, 140),
            false => (HPos::Right, panel.x.hi, 0),
        };
        for (line, dy) in lines.iter().zip([90, 420]) {
            panel.note(line, (x, panel.y.hi), (dx, dy), (SMALL, INK, side, VPos::Top))?;
        }
        seen.push(format!("{} p = {p}: mean {mean}", LETTERS[i]));
    }
    let description = seen!(
        "Columns over k = 1 … {N}: the probability of k different impacts for simple circuits, N = {N}. From panel to panel \
         the weight moves from single impacts to nearly the whole system. {}.",
        seen.join("; ")
    );
    Ok(sheet.finish("fig08", "Distribution of the number of impacts", description))
}
