//! Draws Fig. S9: error and misses of the next impact against measured time, for every method.

use super::prelude::*;
use super::rivals::{self, FINEST, Place, Point, by_method, over_engine};
use crate::experiments::accuracy::race::{DISPLACED, Entry};
use crate::experiments::{MEASURED, RACE};
use crate::params::MethodName::*;

/// Where the names stand in (a).
const NAMES_IN_A: [Place; 4] = [
    Place { method: Certified, setting: FINEST, offset: (-2, 0) },
    Place { method: Sampled, setting: FINEST, offset: (2, 0) },
    Place { method: Advancement, setting: 0, offset: (-2, 0) },
    Place { method: RungeKutta, setting: FINEST, offset: (2, 0) },
];

/// Where they stand in (b).
const NAMES_IN_B: [Place; 6] = [
    Place { method: Certified, setting: FINEST, offset: (0, -2) },
    Place { method: Advancement, setting: 0, offset: (2, 0) },
    Place { method: RungeKutta, setting: FINEST, offset: (1, -2) },
    Place { method: MoreauJean, setting: 2, offset: (2, 0) },
    Place { method: Verlet, setting: 0, offset: (0, 2) },
    Place { method: Penalty, setting: FINEST, offset: (-1, -2) },
];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (race, measured) = (results.of(&RACE)?, results.of(&MEASURED)?);
    let time_axis = || rivals::time_axis(900.0);
    let sheet = Sheet::new(8300);
    let error = Axis::decades(-18, 0, 3, "error in time (1/*ω*)");
    let error = error.column("error of the next impact's time (1/omega)");
    let (upper, x) = (Frame::new(1300, 430, 8250, 4330), time_axis().without_numbers());
    let errors = sheet.lettered("(a)", upper, x, error)?.outside(Edge);
    errors.level("counts as missed", DISPLACED, Stroke::dashed(GREY, HAIR, SHORT))?;
    errors.label("missed above", (errors.x.hi, DISPLACED), (-1, -1), INK)?;

    let states = race.entries.iter().map(|e| e.tried).max().unwrap_or(1);
    let bottom = -(pxfm::f_log10(states as f64).ceil() as i32) - 1;
    let mut axis = Axis::decades(bottom, 0, 1, "share missed");
    // Below one in all that were tried there is nothing but zero.
    axis.ticks.retain(|tick| tick.at <= axis.lo || tick.at >= 9.5 * axis.lo);
    if let Some(first) = axis.ticks.first_mut() {
        first.label = Some("none".into());
    }
    // A lane above the axis line.
    let none = axis.lo;
    axis.lo *= 0.3;
    let misses = Frame::new(1300, 4950, 8250, 7250);
    let mut misses = sheet.lettered("(b)", misses, time_axis(), axis)?.outside(Edge);
    misses.y.lo = none;
    misses.level("a break", 7.0 * none, Stroke::dashed(GREY, HAIR, SHORT))?;
    let time = |e: &Entry| over_engine(race, measured, e.setting);
    let point =
        |e: &Entry, y: f64, interval| Some(Point { setting: e.setting, x: time(e)?, y, interval });
    let median_error = |e: &Entry| point(e, e.errors?[0], e.errors);
    let share_missed = |e: &Entry| point(e, e.misses as f64 / e.tried.max(1) as f64, None);
    rivals::key(&errors, 110.0, [1e-7, 3e-9, 1e-10])?;
    rivals::draw(&errors, &by_method(&race.entries, median_error), &NAMES_IN_A)?;
    rivals::better(&errors, (0.7, 1e-10), (0.35, 1e-13))?;
    rivals::draw(&misses, &by_method(&race.entries, share_missed), &NAMES_IN_B)?;
    let certified = race.entries.iter().find(|e| e.setting.method == Certified);
    let largest = certified.and_then(|entry| Some(entry.errors?[1]));
    let description = describe!(
        "Against measured time over the engine's, a mark for each method and step or tolerance, n = {}, σ = {}: (a) median error of the time of the next \
         impact, with a line up to the largest, which for the engine is {}; (b) the share of states from which the \
         next impact is missed.",
        race.parameters.growth.chain.masses,
        race.parameters.growth.sigma,
        largest.map_or("unknown".into(), |error| short(error, 2)),
    );
    Ok(sheet.finish("Error and misses of the next impact", description))
}
