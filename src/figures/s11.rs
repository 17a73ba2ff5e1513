//! Draws Fig. S11: the cost of an impact against the number of masses, counted and measured.

use super::prelude::*;
use super::rivals::{self, FINEST, Place, by_method};
use crate::experiments::{MEASURED, Results, SCALE};
use crate::params::{MethodName::*, Setting};

/// Where names stand in (a).
const COUNTED: [Place; 6] = [
    (Certified, FINEST, (0, -2)),
    (Sampled, FINEST, (2, 0)),
    (Advancement, FINEST, (2, 0)),
    (RungeKutta, FINEST, (2, 0)),
    (MoreauJean, FINEST, (2, -1)),
    (Verlet, FINEST, (2, 1)),
];

/// Where they stand in (b).
const TIMED: [Place; 6] = [
    (Certified, FINEST, (0, -2)),
    (Sampled, 0, (1, 2)),
    (Advancement, FINEST, (2, 0)),
    (RungeKutta, FINEST, (2, 0)),
    (MoreauJean, 0, (4, 0)),
    (Verlet, FINEST, (0, 2)),
];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (scale, measured) = (results.of(&SCALE)?, results.of(&MEASURED)?);
    let sheet = Sheet::new(7850);
    // Somewhat wider than the sizes, which would stand on the other axis.
    let masses = || Axis::decades(0, 5, 1, "number of masses *n*").between(7.0, 1.4e4);
    let y = Axis::decades_around(scale.iter().map(|row| row.2), 1, "evaluations per impact");
    let counted =
        sheet.lettered("(a)", Frame::new(1200, 430, 8250, 3330), masses().without_numbers(), y)?;
    let all = by_method(scale, |row| Some((row.0, (row.1 as f64, row.2, None))));
    rivals::draw(&counted, &all, &COUNTED)?;

    // The same chains and settings, on one thread.
    let timed = |row: &(Setting, usize, f64)| {
        let time = measured.size(row.0, row.1)?.microseconds_per_impact?;
        Some((row.0, (row.1 as f64, time, None)))
    };
    let times: Vec<_> = scale.iter().filter_map(timed).collect();
    let y = Axis::decades_around(times.iter().map(|at| at.1.1), 1, "µs per impact");
    let (x, y) = (masses(), y.column("time per impact (us)"));
    let clock = sheet.lettered("(b)", Frame::new(1200, 4050, 8250, 6950), x, y)?;
    rivals::draw(&clock, &by_method(scale, timed), &TIMED)?;
    let most = scale.iter().rfind(|row| row.0.method == Certified);
    let counted = most.map(|(_, n, work)| format!("{} at n = {n}", short(*work, 2)));
    let longest = times.iter().rfind(|at| at.0.method == Certified);
    let timed = longest.map(|(_, (n, time, _))| format!("{} at n = {n}", short(*time, 2)));
    let description = describe!(
        "Cost against the number of masses n, all axes logarithmic. (a) Evaluations per impact: this engine lowest and nearly level, \
         {}; Runge–Kutta grows with n. (b) Microseconds per impact, of this engine {}.",
        counted.unwrap_or("none".into()),
        timed.unwrap_or("none".into()),
    );
    Ok(sheet.finish("Cost of an impact against n", description))
}
