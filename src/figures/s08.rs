//! Fig. S8: the error of a mean against the time that it takes, by every method.

use super::prelude::*;
use super::rivals::{self, FINEST, Place, by_method, look};
use crate::experiments::Measured;
use crate::experiments::accuracy::bias::Biases;
use crate::experiments::accuracy::tables::{Compared, compared};
use crate::params::MethodName::{self, *};
use crate::params::Setting;
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::Estimate;

/// Errors below this many standard errors are drawn as bounds: among all points, one exceeds two
/// standard errors by chance.
const CLEAR: f64 = 3.0;

/// Standard errors from the value up to such a bound.
const BOUND: f64 = 2.0;

const NAMES: [Place; 6] = [
    (Verlet, 0, (-2, 0), None),
    (Advancement, FINEST, (0, 5), None),
    (Sampled, 0, (0, 4), None),
    (RungeKutta, 0, (-1, -1), None),
    (MoreauJean, 0, (1, -1), None),
    (Penalty, 0, (2, -1), None),
];

pub fn draw(biases: &Biases, measured: &Measured) -> Result<Figure, Error> {
    const HEIGHT: i32 = 2950;
    let sheet = Sheet::new(11_400);
    let rows = compared(biases);
    let last = biases.parameters.chains.len() - 1;
    for (i, chains) in biases.parameters.chains.iter().enumerate() {
        let top = 430 + i as i32 * (HEIGHT + 420);
        let x = Axis::decades(0, 2, 1, "seconds of one core for a thousand chains")
            .between(0.8, 200.0)
            .column("time of one core for a thousand chains (s)");
        let x = if i == last { x } else { x.without_numbers() };
        let y = Axis::decades(-1, 2, 1, "error of the mean (%)").between(0.2, 400.0);
        let y = if i == last / 2 {
            y
        } else {
            Axis { label: String::new(), ..y.column("error of the mean (%)") }
        };
        let frame = Frame::new(1150, top, 8250, top + HEIGHT);
        let panel = sheet.lettered(LETTERS[i], frame, x, y)?;
        let corner = (panel.x.hi, panel.y.hi);
        panel.label(&format!("*σ* = {}", chains.sigma), corner, (-1, -1), INK)?;
        let time = |setting: Setting| {
            measured.method(setting, chains.chain.masses, chains.sigma)?.thousand()
        };
        let engine = Setting { method: Certified, value: 0.0 };
        if let Some(at) = time(engine).filter(|at| panel.x.contains(*at)) {
            panel.guide("engine", &[(at, panel.y.lo), (at, panel.y.hi)], look(Certified).2)?;
            panel.label_nearby("engine", (at, panel.y.hi), (1, 1), RED)?;
        }
        let all = rows.iter().filter(|row| row.sigma == chains.sigma);
        let all: Vec<&Compared> = all.collect();
        let found =
            by_method(&all, |row| Some((row.setting.method, (time(row.setting)?, row.share?))));
        let mut curves = Vec::new();
        for (method, found) in found {
            curves.push((method, shown(&panel, method, &found)?));
        }
        if i == 0 {
            panel.label("black: clear errors", (panel.x.hi, panel.y.lo), (-1, -6), INK)?;
            panel.label_nearby("grey: upper bounds", (panel.x.hi, panel.y.lo), (-1, -1), GREY)?;
        }
        rivals::names(&panel, &curves, &NAMES)?;
    }
    Ok(sheet.finish("Error of a mean against its time", description(biases, &rows)))
}

/// Draws the settings of a method: an error with its standard error, or an arrow down from where it
/// may be at most. Returns where they stand.
fn shown(
    panel: &Panel,
    method: MethodName,
    found: &[(f64, Estimate)],
) -> Result<Vec<(f64, f64)>, Error> {
    let (mark, size, grey) = look(method);
    let title = method.title();
    let percent = |bias: &Estimate| with_error(100.0 * bias.value, 100.0 * bias.error);
    let found: Vec<_> = found.iter().map(|(x, bias)| (*x, percent(bias))).collect();
    panel.record(title, found.iter().copied());
    let panel = panel.unrecorded();
    let clear = |bias: &Estimate| bias.value.abs() > CLEAR * bias.error;
    let height =
        |bias: &Estimate| bias.value.abs() + if clear(bias) { 0.0 } else { BOUND * bias.error };
    let places: Vec<_> = found.iter().map(|(x, bias)| (*x, height(bias))).collect();
    for (setting, ((x, y), (_, bias))) in places.iter().zip(&found).enumerate() {
        // The first is the coarse one.
        let size = size + if setting == 0 { 22 } else { -8 };
        let stroke = if clear(bias) { Stroke { colour: INK, ..grey } } else { grey };
        if clear(bias) {
            let bar = [(*x, y - bias.error, y + bias.error)];
            panel.bars(title, &bar, 0, stroke, Outside::Edge)?;
        } else {
            panel.area.draw(&arrow(vec![(*x, *y), (*x, 0.5 * y)], stroke))?;
        }
        panel.markers(title, &[(*x, *y)], (mark, size, stroke), Outside::Edge)?;
    }
    Ok(places)
}

fn description(biases: &Biases, rows: &[Compared]) -> Description {
    let clear = |row: &&Compared| row.share.is_some_and(|off| off.value.abs() > CLEAR * off.error);
    describe!(
        "Error of the mean number of impacting gaps against time, a panel for each of {} σ, the engine as a line at the left: {} of \
         {} points are clear errors, the others upper bounds.",
        biases.parameters.chains.len(),
        rows.iter().filter(clear).count(),
        rows.len(),
    )
}
