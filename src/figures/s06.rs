//! Fig. S6: error and misses of the next impact against counted work, for every method.

use super::prelude::*;
use super::rivals::{by_method, entries, look};
use crate::experiments::accuracy::race::{DISPLACED, Entry, Race};
use crate::experiments::accuracy::tables::name;
use crate::params::MethodName;

pub fn draw(race: &Race) -> Result<Figure, Error> {
    let sheet = Sheet::new(9500);
    let costs = || race.entries.iter().filter_map(|entry| entry.work);
    let cost_axis = || Axis::around(costs(), 1, "evaluations per impact");
    let error = Axis::decades(-18, 0, 3, "error in time (1/*ω*)");
    let (x, y) = (cost_axis().bare(), error.column("error of the next impact's time (1/omega)"));
    let errors = sheet.lettered(LETTERS[0], Frame::new(1300, 430, 8150, 4030), x, y)?;
    errors.level("counts as missed", DISPLACED, Stroke::dashed(GREY, HAIR, Dash::Short))?;
    let words = (TINY, INK, HPos::Right, VPos::Bottom);
    errors.note("missed above", (errors.x.hi, DISPLACED), (-60, -60), words)?;

    let tried = race.entries.iter().map(|e| e.tried).max().unwrap_or(1);
    let bottom = -(pxfm::f_log10(tried as f64).ceil() as i32) - 1;
    let mut axis = Axis::decades(bottom, 0, 1, "share missed");
    // Below one in all that were tried there is nothing but zero.
    axis.ticks.retain(|tick| tick.at <= axis.lo || tick.at >= 9.5 * axis.lo);
    if let Some(first) = axis.ticks.first_mut() {
        first.label = Some("none".into());
    }
    let misses = Frame::new(1300, 4650, 8150, 7250);
    let misses = sheet.lettered(LETTERS[1], misses, cost_axis(), axis)?;

    let spread = |e: &Entry| Some((e.setting.method, (e.work?, e.errors?[0], e.errors?[1])));
    let share = |e: &Entry| e.misses as f64 / e.tried.max(1) as f64;
    let missed = |e: &Entry| Some((e.setting.method, (e.work?, share(e))));
    let spreads = by_method(&race.entries, spread);
    for (method, bars) in &spreads {
        let look = look(*method);
        let points: Vec<_> = bars.iter().map(|bar| (bar.0, bar.1)).collect();
        let thin = Stroke::solid(look.2.colour, HAIR);
        errors.bars(name(*method), bars, 0, thin, Outside::Edge)?;
        errors.marked(name(*method), &points, (look.2, look), Outside::Edge)?;
    }
    for (method, points) in by_method(&race.entries, missed) {
        let look = look(method);
        misses.marked(name(method), &points, (look.2, look), Outside::Edge)?;
    }
    let entries = entries(|method| spreads.iter().any(|(m, _)| *m == method));
    sheet.legend((700, 8450), (SMALL, 370), (3, 2650), &entries)?;
    Ok(sheet.finish("s06", "Error and misses of the next impact", description(race)))
}

fn description(race: &Race) -> Seen {
    let certified = race.entries.iter().find(|e| e.setting.method == MethodName::Certified);
    let largest = certified.and_then(|entry| Some(entry.errors?[1]));
    seen!(
        "Against counted work, a marker for each method and step or tolerance, n = {}, σ = {}: (a) median error of the time of the next \
         impact, with a line up to the largest, which for the engine is {}; (b) the share of states from which the \
         next impact is missed.",
        race.parameters.growth.chain.masses,
        race.parameters.growth.sigma,
        largest.map_or("unknown".into(), |error| short(error, 2)),
    )
}
