//! Draws Fig. 14: simple and higher-order distributions become alike as p grows.

use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::theory::higher::five;
use crate::experiments::theory::law::simple;
use crate::params::{CONVERGENCE_P, VERTICES as N};

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(3450);
    let line = Stroke::solid(GREEN, LINE);
    let broken = Stroke::dashed(BLUE, LINE, LONG);
    let mut seen = Vec::new();
    let top = largest(&CONVERGENCE_P.map(|p| largest(&five(p)).max(largest(&simple(p)))));
    for (i, at) in CONVERGENCE_P.into_iter().enumerate() {
        let (simple, higher) = (simple(at), five(at));
        let x = Axis::linear(0.0, N as f64 + 1.0, 20.0, 2, "*k*");
        let y = Axis::up_to(top, "*P*(*X* = *k*)");
        let left = 1080 + 4150 * i as i32;
        let panel = sheet.panel(Frame::new(left, 480, left + 2970, 2580), x, y)?;
        let p = short(at, 3);
        panel.heading(LETTERS[i], &format!("*p* = {p}"))?;
        panel.curve("simple circuits", &over_k(&simple), line)?;
        panel.curve("five classes", &over_k(&higher), broken)?;
        let peak = |values: &[f64]| {
            let highest = |a: &(f64, f64), b: &(f64, f64)| a.1.total_cmp(&b.1);
            over_k(values).into_iter().max_by(highest).unwrap_or_default()
        };
        let (simple, higher) = (peak(&simple), peak(&higher));
        let name = |name, peak: (f64, f64)| format!("{name}: *k*^{{∗}} = {}", peak.0);
        panel.label(&name("simple", simple), (0.0, simple.1), (1, [-5, 1][i]), GREEN)?;
        panel.label(&name("higher", higher), (panel.x.hi, higher.1), (-1, -1), BLUE)?;
        let distance = results.number(&format!("theory.classes[p={at}].variation"))?;
        let distance = short(distance, 3);
        seen.push(format!("{} p = {p}: total variation distance {distance}", LETTERS[i]));
    }
    let description = describe!(
        "Probability of k different impacts, N = {N}, of simple circuits and with higher orders (broken line). The two curves \
         lie apart in (a) and nearly on each other in (b). {}.",
        seen.join("; ")
    );
    Ok(sheet.finish("Simple and higher-order distributions converge", description))
}
