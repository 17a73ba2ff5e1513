//! Fig. 14: simple and higher-order distributions become alike as p grows.

use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::theory::higher::five;
use crate::experiments::theory::law::simple;
use crate::params::{CONVERGENCE_P, VERTICES as N};

const FRAMES: [Frame; 2] = [Frame::new(1080, 480, 4050, 2780), Frame::new(5230, 480, 8200, 2780)];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(4100);
    let line = Stroke::solid(GREEN, LINE);
    let higher = Stroke::dashed(BLUE, LINE, Dash::Long);
    let mut seen = Vec::new();
    for (i, at) in CONVERGENCE_P.into_iter().enumerate() {
        let (of_simple, total) = (simple(at), five(at));
        let x = Axis::linear(0.0, N as f64 + 1.0, 20.0, 2, "*k*");
        let y = upwards_from_zero(largest(&total).max(largest(&of_simple)), "*P*(*X* = *k*)");
        let panel = sheet.panel(FRAMES[i], x, y)?;
        let p = short(at, 3);
        heading(&panel, LETTERS[i], &format!("*p* = {p}"))?;
        panel.curve("simple circuits", &over_k(&of_simple), line, Outside::Refuse)?;
        panel.curve("five classes", &over_k(&total), higher, Outside::Refuse)?;
        let distance = results.number(&format!("theory.classes[p={at}].variation"))?;
        let distance = short(distance, 3);
        seen.push(format!("{} p = {p}: total variation distance {distance}", LETTERS[i]));
    }
    let entries = [Entry::line(line, "simple circuits"), Entry::line(higher, "with higher orders")];
    sheet.legend((1300, 3850), (SMALL, 400), (1, 3600), &entries)?;
    let description = seen!(
        "Probability of k different impacts, N = {N}, of simple circuits and with higher orders (broken line). The two curves \
         lie apart in (a) and nearly on each other in (b). {}.",
        seen.join("; ")
    );
    Ok(sheet.finish("fig14", "Simple and higher-order distributions converge", description))
}
