//! Draws Fig. S9: the cost of an impact against the number of masses, counted and measured.

use super::prelude::*;
use super::rivals::{self, FINEST, Place, by_method, look};
use crate::experiments::measured::What;
use crate::experiments::{MEASURED, Results, SCALE};
use crate::params::MethodName::*;

const NAMES: [Place; 5] = [
    (Certified, FINEST, (0, -2), None),
    (Sampled, FINEST, (2, 0), None),
    (Advancement, FINEST, (2, 0), None),
    (RungeKutta, FINEST, (2, -1), None),
    (Verlet, FINEST, (2, 0), Some("Verlet, time stepping")),
];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (scale, measured) = (results.of(&SCALE)?, results.of(&MEASURED)?);
    let sheet = Sheet::new(6650);
    // Somewhat wider than the sizes, which would stand on the other axis.
    let masses = || Axis::decades(0, 5, 1, "number of masses *n*").between(7.0, 1.4e4);
    let y = Axis::decades_around(scale.iter().map(|row| row.2), 1, "evaluations per impact");
    let counted =
        sheet.lettered("(a)", Frame::new(1200, 430, 8250, 3330), masses().without_numbers(), y)?;
    let all = by_method(scale, |row| Some((row.0.method, (row.1 as f64, row.2))));
    rivals::draw(&counted, &all, &NAMES)?;

    // The engine with one chain on one thread.
    let alone = measured.of(What::Engine).filter(|row| row.chains == 1 && row.note.is_empty());
    let line = alone.filter_map(|row| Some((row.n as f64, row.microseconds_per_impact?)));
    let line: Vec<_> = line.collect();
    let times = line.iter().map(|point| point.1);
    let y = Axis::decades_around(times, 1, "µs per impact").label_1_2_5();
    let (x, y) = (masses(), y.column("time per impact (us)"));
    let clock = sheet.lettered("(b)", Frame::new(1200, 4050, 8250, 5750), x, y)?;
    let red = look(Certified);
    clock.marked_curve("engine", &line, red.2, red)?;
    if let Some(last) = line.last() {
        clock.label("engine", *last, (0, -2), RED)?;
    }
    let most = scale.iter().rfind(|row| row.0.method == Certified);
    let counted = most.map(|(_, n, work)| format!("{} at n = {n}", short(*work, 2)));
    let timed = line.last().map(|(n, time)| format!("{} at n = {n}", short(*time, 2)));
    let description = describe!(
        "Cost against the number of masses n, all axes logarithmic. (a) Evaluations per impact: this engine lowest and nearly level, \
         {}; Runge–Kutta grows with n. (b) Microseconds per impact of this engine, {}.",
        counted.unwrap_or("none".into()),
        timed.unwrap_or("none".into()),
    );
    Ok(sheet.finish("Cost of an impact against n", description))
}
