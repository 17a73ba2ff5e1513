//! Gives the figures of the simulations what they share: rows, axes and marks.

use super::encoding::SIGMA_LABEL;
use crate::experiments::Results;
use crate::experiments::theory::comparison;
use crate::params::printed_threshold;
use impact_numerics::statistics::Estimate;
use literate::figures::prelude::*;

/// Fewer active realisations have a mean that says more about them than about σ.
const LEAST_ACTIVE: f64 = 8.0;

/// Makes the axis of σ around the rise; the data files have all σ.
pub fn sigma_axis() -> Axis {
    Axis::linear(0.05, 0.25, 0.05, 5, SIGMA_LABEL)
}

/// Where the main panel of Figs. 2, 3, 12 and 15 stands.
pub const MAIN: Frame = Frame::new(1200, 430, 8150, 4430);

/// Draws a dotted line at the σ that the paper prints for the rise, from a height to the top.
pub fn draw_printed_threshold(panel: &Panel, from: f64) -> Drawn {
    let threshold = printed_threshold();
    let line = [(threshold, from), (threshold, panel.y.hi)];
    panel.guide("printed", &line, Stroke::dashed(INK, THIN, DOTTED))?;
    panel.label(&format!("paper: {threshold}"), line[1], (0, -1), INK)
}

/// Returns the mean over the active realisations against σ, where enough are active.
pub fn simulated(results: &Results) -> Result<Vec<(f64, Estimate)>, Error> {
    let rows = results.table("sweep.rows")?;
    let mut active = rows.curve(&[], "sigma", "kept")?;
    let realisations = results.number("sweep.run.realisations")?;
    active.retain(|(_, share)| share * realisations >= LEAST_ACTIVE);
    let mut means = rows.series(&[], "sigma", "mean")?;
    means.retain(|(sigma, _)| active.iter().any(|point| point.0 == *sigma));
    Ok(means)
}

/// The same without errors.
pub fn simulated_points(results: &Results) -> Result<Vec<(f64, f64)>, Error> {
    Ok(simulated(results)?.into_iter().map(|(sigma, mean)| (sigma, mean.value)).collect())
}

/// Returns a theory curve up to the largest σ of the main sweep.
pub fn theory_points(results: &Results, column: &str) -> Result<Vec<(f64, f64)>, Error> {
    let end = largest(&results.table("sweep.rows")?.distinct("sigma")?);
    let mut points = results.table("theory.curve")?.curve(&[], "sigma", column)?;
    points.retain(|(sigma, _)| *sigma <= end);
    Ok(points)
}

/// Returns the first point of a curve at or above some height, for its name.
pub fn first_point_above(points: &[(f64, f64)], height: f64) -> (f64, f64) {
    points.iter().find(|point| point.1 >= height).copied().unwrap_or((printed_threshold(), height))
}

/// Returns the value of a curve at some σ in words.
pub fn value_in_words(points: &[(f64, f64)], sigma: f64) -> String {
    comparison::interpolate(points, sigma).map_or("nothing".into(), |value| short(value, 3))
}
