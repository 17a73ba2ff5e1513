//! Fig. 15: as Fig. 12, with higher-order circuits.

use super::prelude::*;
use super::simulated::*;
use crate::experiments::{Results, sweep};
use crate::params::VERTICES;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (sweep, theory) = (sweep::main(results)?, results.table("theory.curve")?);
    let sheet = Sheet::new(HEIGHTS.0);
    let n = sweep.ensemble.chain.gaps().max(VERTICES);
    let end = last_sigma(sweep);
    let panel = sheet.panel(MAIN, sigma_axis(end), count_axis(n, "expected number of impacts"))?;
    let green = Stroke::solid(GREEN, LINE);
    let blue = Stroke::dashed(BLUE, LINE, Dash::Long);
    let simple = curve(theory, end, "simple");
    panel.curve("theory, simple circuits", &simple, green, Outside::Refuse)?;
    let higher = curve(theory, end, "higher");
    panel.curve("theory, five classes", &higher, blue, Outside::Refuse)?;
    let simulated = means(sweep);
    panel.marks("simulation", &simulated, CROSSES, Outside::Refuse)?;
    // What the orders change, since the two lines nearly coincide.
    let change: Vec<_> =
        higher.iter().zip(&simple).map(|(more, less)| (more.0, more.1 - less.1)).collect();
    let most = change.iter().map(|point| point.1).fold(0.0, f64::max);
    let y = Axis::linear(0.0, 1.1 * most, 5.0, 5, "difference");
    let near = rise(&sheet, 0.13, y)?.file("-inset");
    near.curve("difference of the theories", &change, Stroke::solid(INK, LINE), Outside::Cut)?;
    let entries = [
        Entry::mark(CROSSES, "simulation, mean of the kept"),
        Entry::line(Stroke::solid(INK, LINE), "difference of the two (inset)"),
        Entry::line(blue, "with higher orders"),
        Entry::line(green, "simple circuits only"),
    ];
    sheet.legend((1200, HEIGHTS.1), (SMALL, 380), (2, 3900), &entries)?;

    let description = seen!(
        "Expected number of impacts against σ: crosses for the simulation, {} at σ = {PRINTED}; lines for the theory with simple \
         circuits only, {} there, and with higher orders, {}. The higher orders rise a little earlier, far less than the \
         simulation does, by at most {} gaps (inset); beyond the rise the lines cannot be told apart.",
        at(&simulated, PRINTED),
        at(&simple, PRINTED),
        at(&higher, PRINTED),
        short(most, 3),
    );
    Ok(sheet.finish("fig15", "Simulation against both theories", description))
}
