//! Fig. S12: error and misses of the next impact against counted work, for every method.

use plotters::style::text_anchor::{HPos, VPos};

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::data::cells;
use super::panel::Frame;
use super::rivals::{by_method, decades_around, entries, look, name};
use super::series::Outside;
use super::sheet::Sheet;
use super::style::{Dash, GREY, HAIR, INK, SMALL, Stroke, TINY};
use super::{DataFile, Error, Figure};
use crate::experiments::accuracy::race::{DISPLACED, Entry, Race};
use crate::params::MethodName;

/// Lowest error that is drawn.
const FLOOR: f64 = 1e-18;

/// Draws the figure.
pub fn draw(race: &Race, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(9500, note)?;
    let costs = || race.entries.iter().filter_map(|entry| entry.evaluations_per_impact);
    let cost_axis = || decades_around(costs(), 1, "evaluations per impact");
    let errors = sheet.panel(
        Frame::new(1300, 430, 8150, 4030),
        cost_axis().bare(),
        Axis::decades(-18, 0, 3, "error of the next impact’s time"),
    )?;
    errors.letter(LETTERS[0])?;
    let guide = Stroke::dashed(GREY, HAIR, Dash::Short);
    let across = |y: f64| [(errors.x.lo, y), (errors.x.hi, y)];
    errors.curve("counts as missed", &across(log(DISPLACED)), guide, Outside::Refuse)?;
    let words = (TINY, INK, HPos::Left, VPos::Bottom);
    let place = (errors.x.lo, log(DISPLACED));
    errors.note("missed above", place, (110, -60), words)?;

    let lowest = race.entries.iter().map(|e| e.segments.tried).max().unwrap_or(1) as f64;
    let bottom = -(log(lowest).ceil() as i32) - 1;
    let mut axis = Axis::decades(bottom, 0, 1, "share missed");
    // Below one in all that were tried there is nothing but zero.
    axis.ticks.retain(|tick| tick.at <= axis.lo + 1e-9 || tick.at >= axis.lo + 1.0 - 1e-9);
    if let Some(first) = axis.ticks.first_mut() {
        first.label = Some("none".into());
    }
    let misses = sheet.panel(Frame::new(1300, 4650, 8150, 7250), cost_axis(), axis)?;
    misses.letter(LETTERS[1])?;

    let spread = |e: &Entry| {
        let [_, _, largest] = e.segments.errors?;
        Some((log(e.evaluations_per_impact?), log(largest.max(FLOOR))))
    };
    let middle = |e: &Entry| {
        let [median, _, _] = e.segments.errors?;
        Some((log(e.evaluations_per_impact?), log(median.max(FLOOR))))
    };
    let missed = |e: &Entry| {
        let share = e.segments.misses() as f64 / e.segments.tried.max(1) as f64;
        let y = if share > 0.0 { log(share) } else { f64::from(bottom) };
        Some((log(e.evaluations_per_impact?), y))
    };
    let medians = by_method(&race.entries, |e| e.setting, middle);
    for ((method, points), (_, ends)) in
        medians.iter().zip(by_method(&race.entries, |e| e.setting, spread))
    {
        let look = look(*method);
        let bars: Vec<_> = points.iter().zip(&ends).map(|(a, b)| (a.0, a.1, b.1)).collect();
        errors.bars(name(*method), &bars, 0, Stroke::solid(look.colour, HAIR))?;
        errors.curve(name(*method), points, look.line(), Outside::Refuse)?;
        errors.marks(name(*method), points, look.marker(), Outside::Refuse)?;
    }
    for (method, points) in by_method(&race.entries, |e| e.setting, missed) {
        let look = look(method);
        misses.curve(name(method), &points, look.line(), Outside::Refuse)?;
        misses.marks(name(method), &points, look.marker(), Outside::Refuse)?;
    }
    let entries = entries(|method| medians.iter().any(|(m, _)| *m == method));
    for (i, column) in entries.chunks(3).enumerate() {
        sheet.legend((700 + 2650 * i as i32, 8450), (SMALL, 370), column)?;
    }
    Ok(sheet.finish(
        "s12",
        "Error and misses of the next impact",
        description(race),
        vec![table(race)],
    ))
}

fn description(race: &Race) -> String {
    let certified = race.entries.iter().find(|e| e.setting.method == MethodName::Certified);
    let largest = certified.and_then(|entry| Some(entry.segments.errors?[2]));
    format!(
        "Against counted work, a marker for each method and step or tolerance, n = {}, σ = {}: (a) median error of the time of the next \
         impact, with a line up to the largest, which for certified events is {}; (b) the share of states from which the \
         next impact is missed.",
        race.parameters.chain.masses,
        race.parameters.sigma,
        largest.map_or("unknown".into(), |error| short(error, 2)),
    )
}

fn table(race: &Race) -> DataFile {
    let mut file = DataFile::new(
        "s12.csv",
        &[
            "method",
            "step_or_tolerance (1/omega)",
            "evaluations_per_impact (1)",
            "steps_per_impact (1)",
            "segments (1)",
            "unseen (1)",
            "wrong_gap (1)",
            "displaced (1)",
            "failed (1)",
            "error_median (1/omega)",
            "error_90 (1/omega)",
            "error_largest (1/omega)",
        ],
    );
    for entry in &race.entries {
        let s = &entry.segments;
        let error = |i: usize| s.errors.map(|errors| errors[i]);
        let value = (entry.setting.method != MethodName::Certified).then_some(entry.setting.value);
        file.row(cells![
            name(entry.setting.method),
            value,
            entry.evaluations_per_impact,
            entry.steps_per_impact,
            s.tried,
            s.unseen,
            s.wrong_gap,
            s.displaced,
            s.failed,
            error(0),
            error(1),
            error(2)
        ]);
    }
    file
}
