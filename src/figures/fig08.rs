//! Fig. 8 (a) to (d): the distribution of the number of different impacts at four p.

use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::theory::law::simple;
use crate::params::{DISTRIBUTION_P, VERTICES as N};

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(6750);
    let mut seen = Vec::new();
    let top = DISTRIBUTION_P.into_iter().map(|p| largest(&simple(p))).fold(0.0, f64::max);
    for (i, at) in DISTRIBUTION_P.into_iter().enumerate() {
        let cell = |column| results.number(&format!("theory.distribution[p={at}].{column}"));
        let (probability, k_star) = (simple(at), cell("k_star")?);
        let x = Axis::linear(0.0, N as f64 + 1.0, 20.0, 2, "*k*");
        let panel = sheet.panel(FOUR[i], x, upwards_from_zero(top, "*P*(*X* = *k*)"))?;
        let (p, mean) = (short(at, 3), short(cell("mean")?, 3));
        panel.record(&format!("probability at p = {p}"), over_k(&probability));
        panel.unrecorded().columns("probability", &probability, Stroke::solid(GREEN, THIN))?;
        panel.heading(LETTERS[i], &format!("*p* = {p}, *μ* = {mean}"))?;
        let side = if k_star == 1.0 { (2, 0) } else { (0, -1) };
        let peak = (k_star, largest(&probability));
        panel.label(&format!("*k*^{{∗}} = {k_star}"), peak, side, INK)?;
        seen.push(format!("{} p = {p}: mean {mean}", LETTERS[i]));
    }
    let description = describe!(
        "Columns over k = 1 … {N}, on one scale: the probability of k different impacts for simple circuits, N = {N}. From panel to \
         panel the weight moves from single impacts to the whole system. {}.",
        seen.join("; ")
    );
    Ok(sheet.finish("Distribution of the number of impacts", description))
}
