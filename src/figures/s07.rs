//! Fig. S7: how long a run is true, against its work, its error and its time.

use super::prelude::*;
use super::rivals::{by_method, entries, look, look_of, others, timed};
use crate::experiments::Measured;
use crate::experiments::accuracy::race::{DISPLACED, Race};
use crate::experiments::accuracy::tables::name;

/// The rounding of doubles, 2⁻⁵³.
const ROUNDING: f64 = f64::EPSILON / 2.0;

/// Time after which an error ε has grown to [`DISPLACED`]: ln(10⁻³/ε)/λ, with λ and its error.
fn allowed(race: &Race, error: f64) -> Option<[f64; 3]> {
    let growth = race.growth.growth()?;
    let folds = pxfm::f_log(DISPLACED / error).max(0.0);
    Some([growth.interval[1], growth.value, growth.interval[0]].map(|rate| folds / rate))
}

pub fn draw(race: &Race, measured: &Measured) -> Result<Figure, Error> {
    let sheet = Sheet::new(9950);
    let top = (race.parameters.until / 50.0).ceil() * 50.0;
    let costs = race.entries.iter().filter_map(|entry| entry.work);
    let (x, y) =
        (Axis::around(costs, 1, "evaluations per impact"), horizon(top, "horizon *t* (1/*ω*)"));
    let by_cost = sheet.lettered(LETTERS[0], Frame::new(1100, 430, 8150, 3500), x, y)?;
    let x = Axis::decades(-18, 0, 6, "error of the next impact (1/*ω*)");
    let y = horizon(top, "horizon *t* (1/*ω*)");
    let by_error = sheet.lettered(LETTERS[1], Frame::new(1100, 4900, 4300, 7350), x, y)?;

    chaos(&by_error, race)?;
    let ceiling = allowed(race, ROUNDING);
    if let Some([_, ceiling, _]) = ceiling.filter(|c| c[1] < top) {
        let line = Stroke::dashed(GREY, LINE, Dash::Short);
        by_cost.level("what chaos allows to doubles", ceiling, line)?;
        let look = (TINY, INK, HPos::Right, VPos::Bottom);
        by_cost.note("what chaos allows to doubles", (by_cost.x.hi, ceiling), (0, -70), look)?;
    }
    let by_work = by_method(&race.entries, |e| Some((e.setting.method, (e.work?, e.horizon()?))));
    let by_median =
        by_method(&race.entries, |e| Some((e.setting.method, (e.errors?[0], e.horizon()?))));
    for (panel, methods) in [(&by_cost, &by_work), (&by_error, &by_median)] {
        for (method, found) in methods {
            let look = look(*method);
            let points: Vec<_> = found.iter().map(|(x, time)| (*x, time.value)).collect();
            let bars = found.iter().map(|(x, t)| (*x, t.value - t.error, t.value + t.error));
            let bars: Vec<_> = bars.collect();
            panel.bars(name(*method), &bars, 0, look.2, Outside::Edge)?;
            if std::ptr::eq(panel, &by_cost) {
                panel.curve(name(*method), &points, look.2, Outside::Refuse)?;
            }
            panel.marks(name(*method), &points, look, Outside::Edge)?;
        }
    }
    let programs = timed(measured);
    let mut legend = entries(|method| by_work.iter().any(|(m, _)| *m == method));
    legend.extend(others(&programs).into_iter().map(|(name, look)| Entry::mark(look, name)));
    sheet.legend((350, 8600), (SMALL, 370), (4, 2800), &legend)?;
    clock(&sheet, measured, race.parameters.growth.chain.masses, top)?;
    Ok(sheet.finish("s07", "How long a run is true", description(race)))
}

/// The axis of horizons.
fn horizon(top: f64, label: &str) -> Axis {
    let step = if top > 60.0 { 50.0 } else { 10.0 };
    Axis::linear(0.0, top, step, 1, label).column("horizon (1/omega)")
}

/// The line that chaos allows, with the band of λ's interval.
fn chaos(panel: &Panel, race: &Race) -> Result<(), Error> {
    let at = |error: f64| allowed(race, error).map(|t| (error, t));
    let errors = (0..=72).map(|i| pxfm::f_exp10(-18.0 + 0.25 * f64::from(i)));
    let grid: Vec<_> = errors.filter_map(at).collect();
    let cut = |t: f64| t.min(panel.y.hi);
    let below = grid.iter().map(|(x, t)| (*x, cut(t[0])));
    let above = grid.iter().rev().map(|(x, t)| (*x, cut(t[2])));
    panel.area("interval of the growth", &below.chain(above).collect::<Vec<_>>(), PALE, 100)?;
    let line: Vec<_> = grid.iter().map(|(x, t)| (*x, t[1])).collect();
    let stroke = Stroke::dashed(GREY, LINE, Dash::Short);
    panel.curve("what chaos allows", &line, stroke, Outside::Cut)
}

/// Panel (c): the horizon of programs on one chain against the time they take, as measured.
fn clock(sheet: &Sheet, measured: &Measured, masses: usize, top: f64) -> Result<(), Error> {
    let mut rows = timed(measured);
    rows.retain(|row| row.masses as usize == masses);
    let time = rows.iter().map(|row| row.microseconds);
    let x = Axis::around(time, 1, "measured µs per impact").column("measured time per impact (us)");
    let y = horizon(top, "");
    let panel = sheet.lettered(LETTERS[2], Frame::new(5300, 4900, 8150, 7350), x, y)?;
    let others = others(&rows);
    for row in &rows {
        let point = [(row.microseconds, row.horizon)];
        panel.marks(&row.name, &point, look_of(row, &others), Outside::Edge)?;
    }
    Ok(())
}

fn description(race: &Race) -> Seen {
    let growth = race.growth.growth().map_or("unknown".into(), |g| short(g.value, 3));
    seen!(
        "Time up to which a run has every impact right, mean of {} chains with n = {} and σ = {}: (a) against evaluations per \
         impact, (b) against the median error of one impact, with the line that the growth λ = {growth} allows, (c) against \
         measured time, on one chain.",
        race.parameters.chains,
        race.parameters.growth.chain.masses,
        race.parameters.growth.sigma,
    )
}
