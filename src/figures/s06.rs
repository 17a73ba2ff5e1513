//! Draws Fig. S6: error and misses of the next impact against measured time, for every method.

use super::prelude::*;
use super::rivals::{self, FINEST, Place, by_method, look, over_engine};
use crate::experiments::accuracy::race::{DISPLACED, Entry};
use crate::experiments::{MEASURED, RACE, Results};
use crate::params::MethodName::*;

/// Where the names stand in the upper panel.
const NAMES: [Place; 6] = [
    (Certified, FINEST, (-2, 0), None),
    (Sampled, FINEST, (2, 0), None),
    (Advancement, 0, (2, 0), None),
    (RungeKutta, FINEST, (2, 0), None),
    (MoreauJean, 1, (1, -2), None),
    (Verlet, 1, (1, 6), Some(ALIKE)),
];

/// Where they stand in the lower panel.
const MISSED: [Place; 6] = [
    (Certified, FINEST, (2, -2), None),
    (Sampled, 0, (0, -2), None),
    (Advancement, 0, (2, 0), None),
    (RungeKutta, FINEST, (1, -2), None),
    (MoreauJean, 2, (2, 0), None),
    (Verlet, 2, (-2, 0), Some(ALIKE)),
];

/// Methods whose marks coincide.
const ALIKE: &str = "Verlet, penalty springs";

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (race, measured) = (results.of(&RACE)?, results.of(&MEASURED)?);
    let sheet = Sheet::new(8300);
    let cost_axis = rivals::time_axis;
    let error = Axis::decades(-18, 0, 3, "error in time (1/*ω*)");
    let (x, y) =
        (cost_axis().without_numbers(), error.column("error of the next impact's time (1/omega)"));
    let errors =
        sheet.lettered("(a)", Frame::new(1300, 430, 8250, 4330), x, y)?.outside(Outside::Edge);
    errors.level("counts as missed", DISPLACED, Stroke::dashed(GREY, HAIR, SHORT))?;
    errors.label("missed above", (errors.x.hi, DISPLACED), (-1, -1), INK)?;

    let tried = race.entries.iter().map(|e| e.tried).max().unwrap_or(1);
    let bottom = -(pxfm::f_log10(tried as f64).ceil() as i32) - 1;
    let mut axis = Axis::decades(bottom, 0, 1, "share missed");
    // Below one in all that were tried there is nothing but zero.
    axis.ticks.retain(|tick| tick.at <= axis.lo || tick.at >= 9.5 * axis.lo);
    if let Some(first) = axis.ticks.first_mut() {
        first.label = Some("none".into());
    }
    let misses = Frame::new(1300, 4950, 8250, 7250);
    let misses = sheet.lettered("(b)", misses, cost_axis(), axis)?.outside(Outside::Edge);

    let time = |e: &Entry| over_engine(race, measured, e.setting);
    let median = |e: &Entry| Some((e.setting, (time(e)?, e.errors?[0])));
    let share = |e: &Entry| e.misses as f64 / e.tried.max(1) as f64;
    let missed = |e: &Entry| Some((e.setting, (time(e)?, share(e))));
    for entry in &race.entries {
        if let Some((time, [median, largest])) = time(entry).zip(entry.errors) {
            let thin = Stroke { width: HAIR, ..look(entry.setting.method).2 };
            errors.bars(&entry.setting.name(), &[(time, median, largest)], 0, thin)?;
        }
    }
    rivals::draw(&errors, &by_method(&race.entries, median), &NAMES)?;
    rivals::draw(&misses, &by_method(&race.entries, missed), &MISSED)?;
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
