//! Draws Fig. 15: as Fig. 12, with higher orders, and their change, which the paper does not show.

use super::prelude::*;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(7900);
    let n = results.number("sweep.run.gaps")? as usize;
    let threshold = printed_threshold();
    let (x, y) = (sigma_axis().without_numbers(), gaps_axis(n, 20.0));
    let panel = sheet.lettered("(a)", MAIN, x, y)?.outside(Cut);
    let (simple, higher) = (theory_points(results, "simple")?, theory_points(results, "higher")?);
    panel.curve("simple circuits", &simple, Look::THEORY.line)?;
    panel.curve("five classes", &higher, Look::HIGHER.line)?;
    let simulation = simulated_points(results)?;
    draw_printed_threshold(&panel, 0.6 * n as f64)?;
    panel.markers(Look::ACTIVE.name, &simulation, Look::ACTIVE.mark)?;
    panel.label("simulation", first_point_above(&simulation, 0.3 * n as f64), (-2, 0), RED)?;
    // The two lines nearly coincide: each is named at its outer side.
    panel.label(Look::HIGHER.name, first_point_above(&higher, 0.06 * n as f64), (-2, 0), BLUE)?;
    panel.label(Look::THEORY.name, first_point_above(&simple, 0.4 * n as f64), (2, 0), GREEN)?;
    let change: Vec<_> =
        higher.iter().zip(&simple).map(|(more, less)| (more.0, more.1 - less.1)).collect();
    let most = change.iter().map(|point| point.1).fold(0.0, f64::max);
    let y = Axis::linear(0.0, 1.1 * most, 5.0, 5, "gaps added");
    let difference =
        sheet.lettered("(b)", Frame::new(1200, 5200, 8150, 7000), sigma_axis(), y)?.outside(Cut);
    difference.curve("difference of the theories", &change, Look::HIGHER.line)?;
    let (peak, _) = first_point_above(&change, most);
    difference.label("by the higher orders", (peak, 0.7 * most), (5, 0), BLUE)?;

    let description = describe!(
        "(a) Expected number of impacts against σ: crosses for the simulation, {} at σ = {threshold}; lines for the theory with simple \
         circuits only, {} there, and with higher orders, {}. (b) The higher orders add at most {} gaps, far less than the \
         simulation is ahead; beyond the rise the lines cannot be told apart.",
        value_in_words(&simulation, threshold),
        value_in_words(&simple, threshold),
        value_in_words(&higher, threshold),
        short(most, 3),
    );
    Ok(sheet.finish("Simulation against both theories", description))
}
