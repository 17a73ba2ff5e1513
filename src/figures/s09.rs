//! Fig. S9: the cost of an impact against the number of masses, counted and measured.

use super::prelude::*;
use super::rivals::{self, FINEST, Place, by_method, look};
use crate::experiments::Measured;
use crate::experiments::accuracy::scale::Scale as Costs;
use crate::experiments::measured::{Measurement, What};
use crate::params::MethodName::*;

const NAMES: [Place; 5] = [
    (Certified, FINEST, (0, -2), None),
    (Sampled, FINEST, (2, 0), None),
    (Advancement, FINEST, (2, 0), None),
    (RungeKutta, FINEST, (2, -1), None),
    (Verlet, FINEST, (2, 0), Some("Verlet, time stepping")),
];

/// The measured times of the engine with one chain on one thread.
fn of_engine(measured: &Measured) -> Vec<&Measurement> {
    measured.of(What::Engine).filter(|row| row.chains == 1 && row.note.is_empty()).collect()
}

pub fn draw(scale: &Costs, measured: &Measured) -> Result<Figure, Error> {
    let sheet = Sheet::new(6650);
    // Somewhat wider than the sizes, which would stand on the other axis.
    let masses = || Axis::decades(0, 5, 1, "number of masses *n*").between(7.0, 1.4e4);
    let work = scale.iter().map(|row| row.2);
    let y = Axis::decades_around(work, 1, "evaluations per impact");
    let counted =
        sheet.lettered("(a)", Frame::new(1200, 430, 8250, 3330), masses().without_numbers(), y)?;
    let all = by_method(scale, |row| Some((row.0.method, (row.1 as f64, row.2))));
    rivals::draw(&counted, &all, &NAMES)?;

    let rows = of_engine(measured);
    let times = rows.iter().filter_map(|row| row.microseconds_per_impact);
    let y = Axis::decades_around(times, 1, "µs per impact").label_1_2_5();
    let (x, y) = (masses(), y.column("time per impact (us)"));
    let clock = sheet.lettered("(b)", Frame::new(1200, 4050, 8250, 5750), x, y)?;
    let red = look(Certified);
    let line: Vec<_> =
        rows.iter().filter_map(|row| Some((row.n as f64, row.microseconds_per_impact?))).collect();
    clock.marked_curve("engine", &line, red.2, red)?;
    if let Some(last) = line.last() {
        clock.label("engine", *last, (0, -2), RED)?;
    }
    Ok(sheet.finish("Cost of an impact against n", description(scale, &rows)))
}

fn description(scale: &Costs, rows: &[&Measurement]) -> Description {
    let most = scale.iter().rfind(|row| row.0.method == Certified);
    let counted =
        most.map_or("none".into(), |(_, n, work)| format!("{} at n = {n}", short(*work, 2)));
    let last = rows.last().and_then(|row| Some((row.n, row.microseconds_per_impact?)));
    let timed = last.map_or("none".into(), |(n, time)| format!("{} at n = {n}", short(time, 2)));
    describe!(
        "Cost against the number of masses n, all axes logarithmic. (a) Evaluations per impact: this engine lowest and nearly level, \
         {counted}; Runge–Kutta grows with n. (b) Microseconds per impact of this engine, {timed}."
    )
}
