//! Draws Fig. 2: the most likely number of impacts against σ, simulated.

use super::prelude::*;
use super::simulated::*;
use crate::experiments::ensembles::Counted;

pub fn draw(sweep: &Counted) -> Result<Figure, Error> {
    let sheet = Sheet::new(5450);
    let n = sweep.ensemble.chain.gaps();
    let threshold = printed_threshold();
    // With room above the data for the printed value.
    let y = Axis::linear(0.0, 1.15 * n as f64, 20.0, 2, "most likely number of impacts");
    let panel = sheet.panel(MAIN, sigma_axis(), y)?.outside(Outside::Cut);
    let intervals = sweep.comparable().filter_map(|row| {
        let [low, high] = row.mode_interval?;
        (low < high).then_some((row.sigma, low as f64, high as f64))
    });
    let intervals: Vec<_> = intervals.collect();
    let modes: Vec<_> =
        sweep.comparable().filter_map(|row| Some((row.sigma, row.mode? as f64))).collect();
    panel.bars("mode", &intervals, 40, INTERVAL)?;
    printed(&panel, 1.03 * n as f64)?;
    panel.markers("mode", &modes, CROSSES)?;
    panel.label("most likely number", (panel.x.hi, n as f64), (-1, 3), RED)?;
    let last = intervals.last().map_or(threshold, |bar| bar.0);
    panel.label("its 95 % interval", (last, 0.7 * n as f64), (3, 0), GREY)?;

    let description = describe!(
        "Most likely number of different gaps that impact against σ, simulated with {} masses; grey bars are 95 % \
         bootstrap intervals. Below the rise the mode is small and badly determined, beyond it nearly all {n} gaps \
         impact. A dotted mark above the data stands at the printed σ = {threshold}.",
        sweep.ensemble.chain.masses
    );
    Ok(sheet.finish("Most likely number of impacts", description))
}
