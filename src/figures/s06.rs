//! Draws Fig. S6: the most likely number and its jump for many vertices.

use super::prelude::*;
use crate::experiments::theory::large;

/// The p N in (a): around the onset, where the sizes differ.
const RANGE: (f64, f64) = (0.9, 1.5);

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(8450);
    shares(&sheet)?;
    jumps(&sheet, results.table("theory.large")?)?;
    let description = describe!(
        "(a) The most likely number over N against p N: zero, a jump soon after p N = 1, then a curve; the larger N, the \
     smaller the jump. (b) Height of the jump against N, with the rule."
    );
    Ok(sheet.finish("The theory at large N", description))
}

fn shares(sheet: &Sheet) -> Drawn {
    let x = Axis::linear(RANGE.0, RANGE.1, 0.1, 2, "*p N*");
    let y = Axis::decades(-6, 0, 2, "*k*^{∗}/*N*").between(4e-7, 1.0);
    let panel = sheet.lettered("(a)", Frame::new(1150, 430, 8150, 3730), x, y)?.outside(Cut);
    // The ground on which all lie beyond their jumps, which end in discs.
    panel.curve("limit", &large::limit(), Stroke::solid(GREY, 2 * LINE + 8))?;
    for (place, vertices) in DRAWN_VERTICES.into_iter().enumerate() {
        let colour = ordered(place, DRAWN_VERTICES.len());
        let stroke = Stroke::solid(colour, LINE);
        // No value lies within the jump.
        let [before, after] = large::shares(vertices);
        let name = format!("N = {vertices}");
        panel.curve(&name, &before, stroke)?;
        panel.curve(&name, &after, stroke)?;
        let jump: Vec<_> = before.last().into_iter().chain(after.first()).copied().collect();
        panel.guide("jump", &jump, Stroke::dashed(colour, THIN, DOTTED))?;
        let disc = (Symbol::Disc, LARGE, Stroke::solid(colour, THIN));
        panel.unrecorded().markers(&name, &jump[1..], disc)?;
        let name = format!("*N* = {}", power_of_ten(vertices.ilog10() as i32));
        panel.label(&name, (RANGE.0, 1.0 / vertices as f64), (1, -1), colour)?;
    }
    panel.label("limit: max(0, 1 − 1/(*p N*))", (1.17, 1.0 - 1.0 / 1.17), (0, -3), GREY)
}

fn jumps(sheet: &Sheet, table: &Table) -> Drawn {
    let x = Axis::decades(1, 6, 1, "*N*").between(7.0, 1.4e6);
    let y = Axis::decades(-3, 0, 1, "*k*^{∗}/*N* at the jump");
    let panel = sheet.lettered("(b)", Frame::new(1150, 5250, 8150, 7550), x, y)?;
    let rule = table.curve(&[], "n", "rule")?;
    let rule: Vec<_> = rule.into_iter().map(|(n, k)| (n, k / n)).collect();
    panel.curve("rule", &rule, Stroke::solid(INK, THIN))?;
    let exact = table.curve(&[], "n", "share")?;
    panel.markers("exact", &exact, Look::MODE.mark)?;
    if let Some(place) = exact.get(4) {
        panel.label("exact", *place, (2, -1), PURPLE)?;
    }
    panel.label("*k*^{2} = 2*N*(ln *k* − 1)", (3e4, 0.0168), (-1, 1), INK)
}
