//! Draws Fig. 12: the expected number of impacts, graph theory against simulation.

use super::prelude::*;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(5450);
    let n = results.number("sweep.run.gaps")? as usize;
    let threshold = printed_threshold();
    let panel = sheet.panel(MAIN, sigma_axis(), gaps_axis(n, 20.0))?.outside(Cut);
    draw_printed_threshold(&panel, 0.0)?;
    let simple = theory_points(results, "simple")?;
    panel.curve(Look::THEORY.name, &simple, Look::THEORY.line)?;
    let simulation = simulated_points(results)?;
    panel.markers(Look::ACTIVE.name, &simulation, Look::ACTIVE.mark)?;
    panel.label("simulation", first_point_above(&simulation, 0.3 * n as f64), (-2, 0), RED)?;
    panel.label(Look::THEORY.name, first_point_above(&simple, 0.7 * n as f64), (2, 0), GREEN)?;
    if let Ok(from) = results.number("sweep.rise.half_height") {
        // Where both come to half of all N + 1 gaps, for the theory μ = (N + 1)/2: an arrow as
        // long as the theory is late in σ.
        let (to, level) = (results.number("theory.relation.sigma_half")?, n as f64 / 2.0);
        panel.area.draw(&arrow(vec![(from, level), (to, level)], Stroke::solid(INK, THIN)))?;
        // In the middle of what is right of the dotted line, which would cross the words.
        let middle = (threshold + to) / 2.0;
        panel.label(&format!("+{}", short(to - from, 2)), (middle, level), (0, -1), INK)?;
        panel.label(&short(from, 4), (from, level), (-2, 0), INK)?;
        panel.label(&short(to, 4), (to, level), (1, 0), INK)?;
    }

    let description = describe!(
        "Expected number of impacts against σ: crosses for the simulation, {} at σ = {threshold}; a line for the graph theory with N = \
         {VERTICES}, {} there. The simulation rises earlier than the theory; an arrow shows by how much at half height. For large \
         σ the two come together.",
        value_in_words(&simulation, threshold),
        value_in_words(&simple, threshold),
    );
    Ok(sheet.finish("Simulation against graph theory", description))
}
