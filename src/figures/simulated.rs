//! Gives the figures of the simulations what they share: rows, axes and marks.

use super::prelude::*;
use crate::experiments::theory::comparison;
use crate::experiments::{Results, sweep};
pub use crate::params::printed_threshold;

/// The label of an axis of σ.
pub const FORCING: &str = "*σ* (*d ω*^{2})";

/// Marks of the simulation.
pub const CROSSES: Marker = (Symbol::Cross, 56, Stroke::solid(RED, THIN));

/// Bars of intervals, which stay behind the marks.
pub const INTERVAL: Stroke = Stroke::solid(GREY, 30);

/// Makes the axis of σ around the rise; the data files have all σ.
pub fn sigma_axis() -> Axis {
    Axis::linear(0.05, 0.25, 0.05, 5, FORCING)
}

/// An axis for counts of impacts up to `n` and a little above.
pub fn count_axis(n: usize, label: &str) -> Axis {
    Axis::linear(0.0, n as f64 * 1.05, 20.0, 2, label)
}

/// Where the main panel of Figs. 2, 3, 12 and 15 stands.
pub const MAIN: Frame = Frame::new(1200, 430, 8150, 4430);

/// A dotted line at the σ that the paper prints for the rise, from a height to the top.
pub fn printed(panel: &Panel, from: f64) -> Drawn {
    let printed = printed_threshold();
    let line = [(printed, from), (printed, panel.y.hi)];
    panel.guide("printed", &line, Stroke::dashed(INK, THIN, DOTTED))?;
    panel.label(&format!("paper: {printed}"), line[1], (0, -1), INK)
}

/// Mean over the realisations with an impact against σ. The mean of a single one is drawn, though
/// it has no error and so no cell.
pub fn means(results: &Results) -> Result<Vec<(f64, f64)>, Error> {
    let rows = sweep::main(results)?.comparable();
    Ok(rows.filter_map(|row| Some((row.sigma, row.mean?.value))).collect())
}

/// A theory curve up to the largest σ of the main sweep.
pub fn curve(results: &Results, column: &str) -> Result<Vec<(f64, f64)>, Error> {
    let end = sweep::main(results)?.first().rows.last().map_or(0.0, |row| row.sigma);
    let mut points = results.table("theory.curve")?.curve(&[], "sigma", column)?;
    points.retain(|(sigma, _)| *sigma <= end);
    Ok(points)
}

/// The first point of a curve at or above some height, for its name.
pub fn reaches(points: &[(f64, f64)], height: f64) -> (f64, f64) {
    points.iter().find(|point| point.1 >= height).copied().unwrap_or((printed_threshold(), height))
}

/// The value of a curve at some σ in words.
pub fn at(points: &[(f64, f64)], sigma: f64) -> String {
    comparison::interpolate(points, sigma).map_or("nothing".into(), |value| short(value, 3))
}
