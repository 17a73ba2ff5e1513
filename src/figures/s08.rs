//! Draws Fig. S8: the difference of a mean by each method from that of the engine, with its
//! interval; methods are sorted by the time that they take.

use super::prelude::*;
use crate::experiments::accuracy::tables::{Compared, compared};
use crate::experiments::{BIAS, MEASURED, Results};
use crate::params::{Means, MethodName::Certified, Setting};
use impact_numerics::statistics::Estimate;

/// The differences in the panels, in per cent.
const RANGE: f64 = 60.0;

/// From one row to the next.
const ROW: i32 = 275;

/// The width of a decimal with its point.
const DECIMAL: i32 = 170;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (biases, measured) = (results.of(&BIAS)?, results.of(&MEASURED)?);
    let rows = compared(biases);
    let means = &biases.parameters.means;
    let height = |of: &Means| of.settings.len() as i32 * ROW;
    let sheet = Sheet::new(means.iter().map(|of| height(of) + 480).sum::<i32>() as u32 + 1500);
    let mut top = 1000;
    for (i, of) in means.iter().enumerate() {
        let chains = &of.chains;
        let time = |setting| {
            measured.thousand(measured.method(setting, chains.chain.masses, chains.sigma)?)
        };
        let mut found = Vec::new();
        for row in rows.iter().filter(|row| row.sigma == chains.sigma && row.share.is_some()) {
            found.extend(time(row.setting).map(|time| (time, row)));
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let frame = Frame::new(2450, top, 5350, top + height(of));
        top += height(of) + 480;
        let engine = Setting { method: Certified, value: 0.0, stop: 0.0 };
        let panel = rows_of(&sheet, frame, &found, time(engine), i + 1 == means.len())?;
        panel.heading(LETTERS[i], &format!("*σ* = {}, *T* = {}", chains.sigma, of.transient))?;
    }
    let style = words(SMALL, INK, HPos::Right, VPos::Bottom);
    let heads =
        [("difference (%)", 7250, 350), ("± 95 % half-width", 7250, 650), ("time (s)", 8250, 650)];
    for (name, right, base) in heads {
        sheet.area.draw_text(name, &style, (right, base))?;
    }
    let description = describe!(
        "Difference of the mean number of impacting gaps from the engine's, with 95 % intervals, at {} σ; rows are methods with a step or \
         tolerance, by rising time. {} of {} differences are clear (discs).",
        means.len(),
        rows.iter().filter(|row| row.is_clear()).count(),
        rows.len(),
    );
    Ok(sheet.finish("Error of a mean, by method", description))
}

/// Draws a row for the engine, if its time is known, and one for each method below it. Returns the
/// panel, whose data are times and differences.
fn rows_of(
    sheet: &Sheet,
    frame: Frame,
    found: &[(f64, &Compared)],
    engine: Option<f64>,
    is_last: bool,
) -> Result<Panel, Error> {
    let x = Axis::linear(-RANGE, RANGE, 20.0, 2, "difference from the engine’s mean (%)");
    let x = x.column("time of one core for a thousand chains (s)");
    let x = if is_last { x } else { x.without_numbers() };
    let y = Axis::linear(-0.6 - found.len() as f64, 0.6, 1.0, 1, "");
    let mut y = y.column("error of the mean (%)");
    y.ticks = vec![Tick { at: 0.0, label: Some("engine".into()) }];
    for setting in found.iter().map(|row| row.1.setting) {
        let name = format!("{}, {}", setting.method.title(), in_powers(setting.value));
        y.ticks.insert(0, Tick { at: -(y.ticks.len() as f64), label: Some(name) });
    }
    // A background for every second row.
    let height = f64::from(frame.bottom - frame.top) / (found.len() as f64 + 1.2);
    for row in (1..=found.len()).step_by(2) {
        let upper = frame.top + (height * (row as f64 + 0.1)) as i32;
        let ground = [(60, upper), (8340, upper + height as i32)];
        sheet.area.draw(&Rectangle::new(ground, PALE.mix(0.3).filled()))?;
    }
    let panel = sheet.panel(frame, x, y)?;
    panel.guide("engine", &[(0.0, panel.y.lo), (0.0, 0.0)], Stroke::solid(RED, THIN))?;
    let disc = (Symbol::Disc, LARGE + 12, Stroke::solid(RED, THIN));
    panel.unrecorded().markers("engine", &[(0.0, 0.0)], disc)?;
    let style = words(SMALL, INK, HPos::Right, VPos::Center);
    let decimals = |value: f64| usize::from(value < 9.95);
    // Writes a number so that its units digit ends at a place.
    let write = |before: &str, value: f64, decimals: usize, units: i32, row: f64| {
        let at = (units + decimals as i32 * DECIMAL, panel.area.map_coordinate(&(0.0, row)).1);
        sheet.area.draw_text(&(before.to_owned() + &number(value, decimals)), &style, at)
    };
    if let Some(time) = engine {
        write("", time, decimals(time), 8000, 0.0)?;
    }
    for (row, (time, compared)) in (1..).map(|i| -f64::from(i)).zip(found) {
        let Some(share) = compared.share else { continue };
        let interval = share.interval.map(|end| 100.0 * end);
        let (value, error) = (100.0 * share.value, 100.0 * share.error);
        let name = compared.setting.name();
        panel.record(&name, [(*time, Estimate { value, error, interval })]);
        let is_clear = compared.is_clear();
        let stroke = Stroke::solid(INK, if is_clear { LINE } else { HAIR });
        panel.guide(&name, &interval.map(|end| (end, row)), stroke)?;
        let symbol = if is_clear { Symbol::Disc } else { Symbol::Ring };
        if value.abs() < RANGE {
            let mark = (symbol, MEDIUM, Stroke::solid(INK, THIN));
            panel.unrecorded().markers("difference", &[(value, row)], mark)?;
        }
        for end in interval.into_iter().filter(|end| end.abs() > RANGE) {
            let ends = [0.85, 1.0].map(|share| (share * RANGE * end.signum(), row));
            panel.area.draw(&arrow(ends.to_vec(), stroke))?;
        }
        let half = interval[1] - value;
        write("", value, decimals(half), 6300, row)?;
        // A space is half as wide as a digit.
        let before = ["± ", "±   "][decimals(half)];
        write(before, half, decimals(half), 7000, row)?;
        write("", *time, decimals(*time), 8000, row)?;
    }
    Ok(panel)
}
