//! Fig. 15: as Fig. 12, with higher-order circuits.

use super::data::cells;
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::simulated::{
    CROSS, CROSS_HALF, at, count_axis, crosses, curve, last_sigma, means, means_file, sigma_axis,
};
use super::style::{BLUE, Dash, GREEN, LINE, Mark, SMALL, Stroke};
use super::{DataFile, Error, Figure};
use crate::experiments::sweep::Sweep;
use crate::experiments::theory::Theory;

/// Draws the figure.
pub fn draw(sweep: &Sweep, theory: &Theory, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(5350, note)?;
    let n = sweep.parameters.chain.gaps().max(theory.curve.vertices);
    let end = last_sigma(sweep);
    let panel = sheet.panel(
        Frame::new(1200, 260, 8150, 4450),
        sigma_axis(end),
        count_axis(n, "expected number of impacts"),
    )?;
    let green = Stroke::dashed(GREEN, LINE, Dash::Long);
    let blue = Stroke::solid(BLUE, LINE);
    let higher = curve(&theory.curve, end, |row| row.higher);
    panel.curve("theory, five classes", &higher, blue, Outside::Refuse)?;
    let simple = curve(&theory.curve, end, |row| row.simple);
    panel.curve("theory, simple circuits", &simple, green, Outside::Refuse)?;
    let simulated = means(sweep);
    crosses(&panel, "simulation", &simulated)?;
    sheet.legend(
        (4650, 2800),
        (SMALL, 400),
        &[
            Entry::mark(Mark::Cross, CROSS_HALF, CROSS, "simulation, mean of the kept"),
            Entry::line(blue, "with higher orders"),
            Entry::line(green, "simple circuits only"),
        ],
    )?;

    let mut data = DataFile::new(
        "fig15-theory.csv",
        &["N (1)", "sigma (d omega^2)", "mean_simple (1)", "mean_five_classes (1)"],
    );
    for row in theory.curve.rows.iter().filter(|row| row.sigma <= end) {
        data.row(cells![theory.curve.vertices, row.sigma, row.simple, row.higher]);
    }
    let description = format!(
        "Expected number of impacts against σ: crosses for the simulation, {} at σ = 0.12; lines for the theory with simple \
         circuits only, {} there, and with higher orders, {}. The higher orders rise a little earlier, far less than the \
         simulation does; beyond the rise the lines cannot be told apart.",
        at(&simulated, 0.12),
        at(&simple, 0.12),
        at(&higher, 0.12),
    );
    let files = vec![means_file("fig15-simulation.csv", sweep), data];
    Ok(sheet.finish("fig15", "Simulation against both theories", description, files))
}
