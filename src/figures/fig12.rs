//! Fig. 12: the expected number of impacts, graph theory against simulation.

use super::prelude::*;
use super::simulated::*;
use crate::experiments::{Results, sweep};
use crate::params::VERTICES;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (sweep, theory) = (sweep::main(results)?, results.table("theory.curve")?);
    let sheet = Sheet::new(HEIGHTS.0);
    let n = sweep.ensemble.chain.gaps().max(VERTICES + 1);
    let end = last_sigma(sweep);
    let panel = sheet.panel(MAIN, sigma_axis(end), count_axis(n, "expected number of impacts"))?;
    let (main, thin) = (Stroke::solid(GREEN, LINE), Stroke::solid(GREEN, THIN / 2));
    let walls = curve(theory, end, "walls");
    panel.curve("theory, N = n + 1", &walls, thin, Outside::Refuse)?;
    let simple = curve(theory, end, "simple");
    panel.curve("theory", &simple, main, Outside::Refuse)?;
    let simulated = means(sweep);
    panel.marks("simulation", &simulated, CROSSES, Outside::Refuse)?;
    let (big_n, big_n_walls) = (VERTICES, VERTICES + 1);
    let near = rise(&sheet, 0.08, count_axis(n, "impacts"))?;
    printed(&near)?;
    near.curve("theory, N = n + 1, near the rise", &walls, thin, Outside::Cut)?;
    near.curve("theory, near the rise", &simple, main, Outside::Cut)?;
    near.marks("simulation, near the rise", &simulated, CROSSES, Outside::Cut)?;
    if let Some(half) = sweep.first().rise.half_height {
        let theory = results.number("theory.relation.sigma_half")?;
        lag(&sheet, &near, [half.value, theory], n as f64 / 2.0)?;
    }
    let entry = [Entry::mark(CROSSES, "simulation, mean of the kept")];
    sheet.legend((1200, HEIGHTS.1), (SMALL, 380), (9, 0), &entry)?;
    let entry = |stroke, n| Entry::line(stroke, &format!("graph theory, *N* = {n}"));
    let entries = [entry(main, big_n), entry(thin, big_n_walls)];
    sheet.legend((5100, HEIGHTS.1), (SMALL, 380), (9, 0), &entries)?;

    let description = seen!(
        "Expected number of impacts against σ: crosses for the simulation, {} at σ = {PRINTED}; a line for the graph theory with N = \
         {big_n}, {} there, and a thin one for N = {big_n_walls} beside it. The simulation rises earlier than the theory (enlarged in \
         an inset); for large σ the two come together.",
        at(&simulated, PRINTED),
        at(&simple, PRINTED),
    );
    Ok(sheet.finish("fig12", "Simulation against graph theory", description))
}

/// Where both come to half of all gaps, and how much later in σ the theory does, as an arrow with its length.
fn lag(sheet: &Sheet, near: &Panel, [from, to]: [f64; 2], level: f64) -> Result<(), Error> {
    sheet.free().arrow(vec![near.at(from, level), near.at(to, level)], Stroke::solid(INK, THIN));
    let look = (TINY, INK, HPos::Center, VPos::Bottom);
    near.note(&short(to - from, 2), ((from + to) / 2.0, level), (60, -70), look)?;
    // The first is not beside the line at the printed σ, which has another value.
    let look = |side, v| (TINY, INK, side, v);
    near.note(&short(from, 4), (from, level), (-60, -70), look(HPos::Right, VPos::Bottom))?;
    near.note(&short(to, 4), (to, level), (70, 60), look(HPos::Left, VPos::Top))
}
