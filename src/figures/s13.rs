//! Fig. S13: how long a run is true, against its work, its error and its time.

use plotters::style::text_anchor::{HPos, VPos};

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::data::cells;
use super::panel::{Frame, Panel};
use super::rivals::{
    Timed, by_method, decades_around, entries, entries_of_others, look, look_of, name, others,
    timed,
};
use super::series::Outside;
use super::sheet::Sheet;
use super::style::{Dash, GREY, INK, LINE, PALE, SMALL, Stroke, TINY};
use super::{DataFile, Error, Figure};
use crate::experiments::Measured;
use crate::experiments::accuracy::race::{DISPLACED, Entry, Race};
use crate::params::MethodName;

/// The rounding of doubles, 2⁻⁵³.
const ROUNDING: f64 = f64::EPSILON / 2.0;

/// Time after which an error ε has grown to [`DISPLACED`]: ln(10⁻³/ε)/λ, with λ and its error.
fn allowed(race: &Race, log10_error: f64) -> Option<[f64; 3]> {
    let growth = race.growth.growth?;
    let folds = (log(DISPLACED) - log10_error).max(0.0) * std::f64::consts::LN_10;
    Some([growth.interval[1], growth.value, growth.interval[0]].map(|rate| folds / rate))
}

/// Draws the figure.
pub fn draw(race: &Race, measured: &Measured, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(9950, note)?;
    let top = (race.parameters.until / 50.0).ceil() * 50.0;
    let time = |label: &str| Axis::linear(0.0, top, if top > 60.0 { 50.0 } else { 10.0 }, 1, label);
    let costs = race.entries.iter().filter_map(|entry| entry.evaluations_per_impact);
    let by_cost = sheet.panel(
        Frame::new(1100, 430, 8150, 3500),
        decades_around(costs, 1, "evaluations per impact"),
        time("horizon *t*"),
    )?;
    by_cost.letter(LETTERS[0])?;
    let by_error = sheet.panel(
        Frame::new(1100, 4900, 4300, 7350),
        Axis::decades(-16, 0, 4, "error of the next impact"),
        time("horizon *t*"),
    )?;
    by_error.letter(LETTERS[1])?;

    let points = |place: &dyn Fn(&Entry) -> Option<f64>| {
        by_method(&race.entries, |e| e.setting, |e| Some((place(e)?, e.horizon?[0])))
    };
    chaos(&by_error, race)?;
    let ceiling = allowed(race, log(ROUNDING));
    if let Some([_, ceiling, _]) = ceiling.filter(|c| c[1] < top) {
        let line = Stroke::dashed(GREY, LINE, Dash::Short);
        let across = [(by_cost.x.lo, ceiling), (by_cost.x.hi, ceiling)];
        by_cost.curve("what chaos allows to doubles", &across, line, Outside::Refuse)?;
        let look = (TINY, INK, HPos::Right, VPos::Bottom);
        by_cost.note("what chaos allows to doubles", (by_cost.x.hi, ceiling), (0, -70), look)?;
    }
    let by_work = |e: &Entry| e.evaluations_per_impact.map(log);
    let by_median = |e: &Entry| e.segments.errors.map(|errors| log(errors[0].max(1e-16)));
    for (panel, place) in
        [(&by_cost, &by_work as &dyn Fn(&Entry) -> Option<f64>), (&by_error, &by_median)]
    {
        let bars = by_method(&race.entries, |e| e.setting, |e| Some((place(e)?, e.horizon?[1])));
        for ((method, points), (_, errors)) in points(place).iter().zip(bars) {
            let look = look(*method);
            let bars: Vec<_> = points
                .iter()
                .zip(errors)
                .map(|(p, e)| (p.0, (p.1 - e.1).max(0.0), (p.1 + e.1).min(top)))
                .collect();
            panel.bars(name(*method), &bars, 0, look.line())?;
            if std::ptr::eq(panel, &by_cost) {
                panel.curve(name(*method), points, look.line(), Outside::Refuse)?;
            }
            panel.marks(name(*method), points, look.marker(), Outside::Refuse)?;
        }
    }
    let present = points(&by_work);
    let programs = timed(measured);
    let mut legend = entries(|method| present.iter().any(|(m, _)| *m == method));
    legend.extend(entries_of_others(&others(&programs)));
    for (i, column) in legend.chunks(4).enumerate() {
        sheet.legend((500 + 2650 * i as i32, 8600), (SMALL, 370), column)?;
    }
    let masses = race.parameters.chain.masses;
    let files = vec![table(race), clock(&sheet, measured, masses, top)?];
    Ok(sheet.finish("s13", "How long a run is true", description(race), files))
}

/// The line that chaos allows, with the band of λ's interval.
fn chaos(panel: &Panel, race: &Race) -> Result<(), Error> {
    let at = |x: f64| allowed(race, x).map(|t| (x, t));
    let grid: Vec<_> = (0..=64).filter_map(|i| at(-16.0 + 0.25 * f64::from(i))).collect();
    let cut = |t: f64| t.min(panel.y.hi);
    let below = grid.iter().map(|(x, t)| (*x, cut(t[0])));
    let above = grid.iter().rev().map(|(x, t)| (*x, cut(t[2])));
    panel.area("interval of the growth", &below.chain(above).collect::<Vec<_>>(), PALE, 100)?;
    let line: Vec<_> = grid.iter().map(|(x, t)| (*x, t[1])).collect();
    let stroke = Stroke::dashed(GREY, LINE, Dash::Short);
    panel.curve("what chaos allows", &line, stroke, Outside::Cut)
}

/// Panel (c): the horizon of programs on one chain against the time they take, as measured.
fn clock(sheet: &Sheet, measured: &Measured, masses: usize, top: f64) -> Result<DataFile, Error> {
    let mut file = DataFile::new(
        "s13-measured.csv",
        &[
            "program",
            "version (text)",
            "settings (text)",
            "microseconds_per_impact (us)",
            "horizon (1/omega)",
            "impacts_compared (1)",
        ],
    );
    let compared = |row: &Timed| row.masses as usize == masses && row.horizon.is_some();
    let rows: Vec<Timed> = timed(measured).into_iter().filter(compared).collect();
    let panel = sheet.panel(
        Frame::new(5300, 4900, 8150, 7350),
        decades_around(rows.iter().map(|row| row.microseconds), 1, "measured µs per impact"),
        Axis::linear(0.0, top, if top > 60.0 { 50.0 } else { 10.0 }, 1, ""),
    )?;
    panel.letter(LETTERS[2])?;
    let others = others(&rows);
    for row in &rows {
        let horizon = row.horizon.unwrap_or(0.0);
        let point = [(log(row.microseconds), horizon.min(top))];
        panel.marks(&row.name, &point, look_of(row, &others).marker(), Outside::Refuse)?;
        file.row(cells![
            row.name.as_str(),
            row.version.as_str(),
            row.settings.as_str(),
            row.microseconds,
            horizon,
            row.compared
        ]);
    }
    Ok(file)
}

fn description(race: &Race) -> String {
    let growth = race.growth.growth.map_or("unknown".into(), |g| short(g.value, 3));
    format!(
        "Time up to which a run has every impact right, mean of {} chains with n = {} and σ = {}: (a) against evaluations per \
         impact, (b) against the median error of one impact, with the line that the growth λ = {growth} allows, (c) against \
         measured time, on one chain.",
        race.impacts.len(),
        race.parameters.chain.masses,
        race.parameters.sigma,
    )
}

fn table(race: &Race) -> DataFile {
    let mut file = DataFile::new(
        "s13.csv",
        &[
            "method",
            "step_or_tolerance (1/omega)",
            "chain (1)",
            "first_wrong_impact (1)",
            "horizon (1/omega)",
        ],
    );
    for entry in &race.entries {
        let value = (entry.setting.method != MethodName::Certified).then_some(entry.setting.value);
        for (i, run) in entry.runs.iter().enumerate() {
            file.row(cells![name(entry.setting.method), value, i + 1, run.impact, run.time]);
        }
    }
    file
}
