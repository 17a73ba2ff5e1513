//! Draws Fig. 12: the expected number of impacts, graph theory against simulation.

use super::encoding::{HIT, THEORY, gaps_axis};
use super::prelude::*;
use super::simulated::*;
use crate::experiments::Results;
use crate::params::VERTICES;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(5450);
    let n = results.number("sweep.run.gaps")? as usize;
    let threshold = printed_threshold();
    let panel = sheet.panel(MAIN, sigma_axis(), gaps_axis(n, 20.0))?;
    let panel = panel.outside(Outside::Cut);
    printed(&panel, 0.0)?;
    let simple = curve(results, "simple")?;
    panel.curve(THEORY.name, &simple, THEORY.line)?;
    let simulated = means(results)?;
    panel.markers(HIT.name, &simulated, HIT.mark)?;
    panel.label("simulation", reaches(&simulated, 0.3 * n as f64), (-2, 0), RED)?;
    panel.label(THEORY.name, reaches(&simple, 0.7 * n as f64), (2, 0), GREEN)?;
    if let Ok(from) = results.number("sweep.rise.half_height") {
        // Where both come to half of all gaps, an arrow as long as the theory is late in σ.
        let (to, level) = (results.number("theory.relation.sigma_half")?, n as f64 / 2.0);
        panel.area.draw(&arrow(vec![(from, level), (to, level)], Stroke::solid(INK, THIN)))?;
        let middle = (threshold + to) / 2.0;
        panel.label(&format!("+{}", short(to - from, 2)), (middle, level), (0, -1), INK)?;
        panel.label(&short(from, 4), (from, level), (-2, 0), INK)?;
        panel.label(&short(to, 4), (to, level), (1, 0), INK)?;
    }

    let description = describe!(
        "Expected number of impacts against σ: crosses for the simulation, {} at σ = {threshold}; a line for the graph theory with N = \
         {VERTICES}, {} there. The simulation rises earlier than the theory; an arrow shows by how much at half height. For large \
         σ the two come together.",
        at(&simulated, threshold),
        at(&simple, threshold),
    );
    Ok(sheet.finish("Simulation against graph theory", description))
}
