//! Draws Fig. S11: the cost of an impact against the number of masses, counted and measured.

use super::prelude::*;
use super::rivals::{self, FINEST, Place, Point, by_method};
use crate::experiments::accuracy::scale::WorkPoint;
use crate::experiments::{MEASURED, SCALE};
use crate::params::MethodName::*;

/// Where names stand in (a).
const NAMES_IN_A: [Place; 6] = [
    Place { method: Certified, setting: FINEST, offset: (0, -2) },
    Place { method: Sampled, setting: FINEST, offset: (2, 0) },
    Place { method: Advancement, setting: FINEST, offset: (2, 0) },
    Place { method: RungeKutta, setting: FINEST, offset: (2, 0) },
    Place { method: MoreauJean, setting: FINEST, offset: (2, -1) },
    Place { method: Verlet, setting: FINEST, offset: (2, 1) },
];

/// Where they stand in (b).
const NAMES_IN_B: [Place; 6] = [
    Place { method: Certified, setting: FINEST, offset: (0, -2) },
    Place { method: Sampled, setting: 0, offset: (1, 2) },
    Place { method: Advancement, setting: FINEST, offset: (2, 0) },
    Place { method: RungeKutta, setting: FINEST, offset: (2, 0) },
    Place { method: MoreauJean, setting: 0, offset: (4, 0) },
    Place { method: Verlet, setting: FINEST, offset: (0, 2) },
];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (scale, measured) = (results.of(&SCALE)?, results.of(&MEASURED)?);
    let sheet = Sheet::new(7850);
    // Somewhat wider than the sizes, which would stand on the other axis.
    let masses = || Axis::decades(0, 5, 1, "number of masses *n*").between(7.0, 1.4e4);
    let point = |row: &WorkPoint, y: f64| {
        Some(Point { setting: row.setting, x: row.masses as f64, y, interval: None })
    };
    let work = |row: &WorkPoint| point(row, row.evaluations_per_impact?);
    let counts = scale.iter().filter_map(|row| row.evaluations_per_impact);
    let y = Axis::decades_around(counts, 1, "evaluations per impact");
    let x = masses().without_numbers();
    let work_panel = sheet.lettered("(a)", Frame::new(1200, 430, 8250, 3330), x, y)?;
    rivals::draw(&work_panel, &by_method(scale, work), &NAMES_IN_A)?;

    // The same chains and settings, on one thread.
    let time = |row: &WorkPoint| {
        point(row, measured.size(row.setting, row.masses)?.microseconds_per_impact?)
    };
    let times = scale.iter().filter_map(time).map(|point| point.y);
    let y = Axis::decades_around(times, 1, "µs per impact").column("time per impact (us)");
    let times_panel = sheet.lettered("(b)", Frame::new(1200, 4050, 8250, 6950), masses(), y)?;
    rivals::draw(&times_panel, &by_method(scale, time), &NAMES_IN_B)?;
    let largest_run = |point: &dyn Fn(&WorkPoint) -> Option<Point>| {
        let mut points = scale.iter().filter_map(point);
        let largest = points.rfind(|point| point.setting.method == Certified);
        largest.map_or("none".into(), |Point { x, y, .. }| format!("{} at n = {x}", short(y, 2)))
    };
    let description = describe!(
        "Cost against the number of masses n, all axes logarithmic. (a) Evaluations per impact: this engine lowest and nearly level, \
         {}; Runge–Kutta grows with n. (b) Microseconds per impact, of this engine {}.",
        largest_run(&work),
        largest_run(&time),
    );
    Ok(sheet.finish("Cost of an impact against n", description))
}
