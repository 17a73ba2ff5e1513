//! Fig. S5: what becomes of the most likely number and of its jump for many vertices.

use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::theory::large;
use crate::params::DRAWN_VERTICES;
use literate::table::Table;

/// The p N in (a): around the onset, where the sizes differ.
const RANGE: (f64, f64) = (0.75, 2.25);

/// Colours of the numbers of vertices in (a).
const SIZES: [(Colour, Dash); 3] =
    [(ORANGE, Dash::Solid), (BLUE, Dash::Long), (GREEN, Dash::Alternate)];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(8450);
    shares(&sheet)?;
    jumps(&sheet, results.table("theory.large")?)?;
    let description = seen!(
        "(a) The most likely number over N against p N: zero, a jump soon after p N = 1, then a curve; the larger N, the \
     smaller the jump. (b) Height of the jump against N, with the rule."
    );
    Ok(sheet.finish("s05", "The theory at large N", description))
}

/// A power of ten as the figures write it.
fn power(vertices: usize) -> String {
    format!("10^{{{}}}", vertices.ilog10())
}

fn shares(sheet: &Sheet) -> Result<(), Error> {
    let x = Axis::linear(RANGE.0, RANGE.1, 0.25, 5, "*p N*");
    let y = Axis::linear(0.0, 0.6, 0.1, 2, "*k*^{∗}/*N*");
    let panel = sheet.lettered(LETTERS[0], Frame::new(1150, 430, 8150, 3730), x, y)?;
    let mut entries = Vec::new();
    for (vertices, (colour, dash)) in DRAWN_VERTICES.into_iter().zip(SIZES) {
        let stroke = Stroke::dashed(colour, LINE, dash);
        // No value lies within the jump.
        let [before, after] = large::shares(vertices);
        let name = format!("N = {vertices}");
        panel.curve(&name, &before, stroke, Outside::Cut)?;
        panel.curve(&name, &after, stroke, Outside::Cut)?;
        let jump: Vec<_> = before.last().into_iter().chain(after.first()).copied().collect();
        panel.guide("jump", &jump, Stroke::dashed(colour, THIN, Dash::Dotted))?;
        entries.push(Entry::line(stroke, &format!("*N* = {}", power(vertices))));
    }
    let limit = large::limit();
    let stroke = Stroke::dashed(INK, THIN, Dash::Short);
    panel.curve("limit", &limit, stroke, Outside::Cut)?;
    entries.push(Entry::line(stroke, "max(0, 1 − 1/(*p N*))"));
    sheet.legend((5500, 2350), (SMALL, 370), (9, 0), &entries)
}

fn jumps(sheet: &Sheet, table: &Table) -> Result<(), Error> {
    let x = Axis::decades(1, 6, 1, "*N*");
    let y = Axis::decades(-3, 0, 1, "*k*^{∗}/*N* at the jump");
    let panel = sheet.lettered(LETTERS[1], Frame::new(1150, 5250, 8150, 7550), x, y)?;
    let rule = table.points(&[], "n", "rule");
    let rule: Vec<_> = rule.into_iter().map(|(n, k)| (n, k / n)).collect();
    let line = Stroke::solid(INK, THIN);
    panel.curve("rule", &rule, line, Outside::Refuse)?;
    let exact = table.points(&[], "n", "share");
    let disc = (Mark::Disc, 55, Stroke::solid(GREEN, THIN));
    panel.marks("exact", &exact, disc, Outside::Refuse)?;
    let entries = [Entry::mark(disc, "exact"), Entry::line(line, "*k*^{2} = 2*N*(ln *k* − 1)")];
    sheet.legend((5200, 5650), (SMALL, 370), (9, 0), &entries)
}
