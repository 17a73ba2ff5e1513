//! What the figures of the simulations share: their rows, axes and marks.

use super::FORCING;
use super::prelude::*;
use crate::experiments::rise::Counted;
use crate::experiments::theory::beside;
use literate::table::Table;

/// Line of the simulation's marks.
pub const CROSS: Stroke = Stroke::solid(RED, THIN);

/// The simulation's marks.
pub const CROSSES: Marker = (Mark::Cross, 56, CROSS);

/// The σ that the paper prints for the rise (Sec. 2).
pub const PRINTED: f64 = 0.12;

/// The axis of σ from zero to the sweep's end.
pub fn sigma_axis(end: f64) -> Axis {
    Axis::linear(0.0, end, 0.1, 2, FORCING)
}

/// Largest σ of a sweep.
pub fn last_sigma(sweep: &Counted) -> f64 {
    sweep.first().rows.last().map_or(0.4, |row| row.sigma)
}

/// An axis for counts of impacts up to `n` and a little above.
pub fn count_axis(n: usize, label: &str) -> Axis {
    Axis::linear(0.0, n as f64 * 1.05, 20.0, 2, label)
}

/// The rise enlarged from `low` on, in an inset where the main panel (of [`MAIN`]) is empty.
pub fn rise(sheet: &Sheet, low: f64, y: Axis) -> Result<Panel, Error> {
    let x = Axis::linear(low, 0.18, 0.02, 2, FORCING);
    sheet.inset(Frame::new(5050, 1150, 8050, 3350), x, y)
}

/// Where the main panel of Figs. 2, 12 and 15 stands; legends stand below it.
pub const MAIN: Frame = Frame::new(1200, 260, 8150, 4450);

/// The height of these figures, and of the first line of their legends.
pub const HEIGHTS: (u32, i32) = (6150, 5480);

/// A dotted line at the σ that the paper prints for the rise.
pub fn printed(panel: &Panel) -> Result<(), Error> {
    let guide = Stroke::dashed(INK, HAIR, Dash::Dotted);
    let line = [(PRINTED, panel.y.lo), (PRINTED, panel.y.hi)];
    panel.guide("printed", &line, guide)?;
    let look = (TINY, INK, HPos::Center, VPos::Bottom);
    panel.note("printed 0.12", line[1], (0, -70), look)
}

/// The mean of the kept against σ.
pub fn means(sweep: &Counted) -> Vec<(f64, f64)> {
    sweep.comparable().filter_map(|row| Some((row.sigma, row.mean?.value))).collect()
}

/// A theory curve up to `end`.
pub fn curve(table: &Table, end: f64, column: &str) -> Vec<(f64, f64)> {
    let mut points = table.points(&[], "sigma", column);
    points.retain(|(sigma, _)| *sigma <= end);
    points
}

/// The value of a curve at some σ in words.
pub fn at(points: &[(f64, f64)], sigma: f64) -> String {
    beside::at(points, sigma).map_or("nothing".into(), |value| short(value, 3))
}
