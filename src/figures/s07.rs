//! Draws Fig. S7: how long all impacts of a run are right, against its time and one impact's error.

use super::prelude::*;
use super::rivals::{self, FINEST, Place, by_method, look, over_engine, programs};
use crate::experiments::accuracy::race::{DISPLACED, Entry, Race};
use crate::experiments::{MEASURED, RACE, Results};
use crate::params::{MethodName::*, Setting};
use impact_numerics::statistics::Estimate;

/// The rounding of doubles, 2⁻⁵³.
const ROUNDING: f64 = f64::EPSILON / 2.0;

/// Where names stand in (a); methods with fixed steps have one name.
const NAMES: [Place; 4] = [
    (Certified, FINEST, (2, 0), None),
    (Sampled, 2, (-2, 0), None),
    (Advancement, 2, (-2, 0), None),
    (RungeKutta, FINEST, (2, 0), None),
];

/// The same for other programs: name of the row, name here.
const PROGRAMS: [(&str, &str, usize, (i32, i32)); 6] = [
    ("impact-paper", "engine, one chain", FINEST, (2, 0)),
    ("heyoka", "heyoka", FINEST, (0, -2)),
    ("SUNDIALS CVODE", "CVODE", FINEST, (2, 0)),
    ("SciPy DOP853", "SciPy", FINEST, (-2, 0)),
    ("pymunk", "pymunk", FINEST, (0, -2)),
    ("diffsol tsit45", "diffsol", 0, (-2, 1)),
];

/// The same for (b).
const BY_ERROR: [Place; 4] = [
    (Certified, FINEST, (-2, 0), None),
    (Sampled, 0, (-2, 0), None),
    (Advancement, 2, (0, 3), None),
    (RungeKutta, 0, (-2, -1), None),
];

/// Returns the time in which an error ε grows to [`DISPLACED`], ln([`DISPLACED`]/ε)/λ, and its
/// interval: [low, value, high].
fn allowed(race: &Race, error: f64) -> Option<[f64; 3]> {
    let growth = race.growth.growth()?;
    let folds = pxfm::f_log(DISPLACED / error).max(0.0);
    Some([growth.interval[1], growth.value, growth.interval[0]].map(|rate| folds / rate))
}

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (race, measured) = (results.of(&RACE)?, results.of(&MEASURED)?);
    let sheet = Sheet::new(8700);
    let top = (race.parameters.until / 50.0).ceil() * 50.0;
    let x = rivals::time_axis();
    let by_time = Frame::new(1100, 430, 8250, 4330);
    let by_time = sheet.lettered("(a)", by_time, x, horizon_axis(top))?.outside(Outside::Edge);
    let x = Axis::decades(-18, 0, 3, "median error of the next impact (1/*ω*)").between(1e-20, 0.5);
    let by_error = Frame::new(1100, 5500, 8250, 7700);
    let by_error = sheet.lettered("(b)", by_error, x, horizon_axis(top))?.outside(Outside::Edge);

    chaos(&by_error, race)?;
    if let Some([_, ceiling, _]) = allowed(race, ROUNDING).filter(|t| t[1] < top) {
        let line = Stroke::dashed(GREY, LINE, SHORT);
        by_time.level("what chaos allows in double precision", ceiling, line)?;
        let end = (by_time.x.hi, ceiling);
        by_time.label("what chaos allows in double precision", end, (-1, -1), GREY)?;
    }
    let run = &race.parameters.growth;
    let others = programs(measured, run.chain.masses);
    for (program, points) in &others {
        let stroke = Stroke::dashed(GREY, HAIR, DOTTED);
        by_time.unrecorded().curve(program, points, stroke)?;
    }
    let time = |e: &Entry| over_engine(race, measured, e.setting);
    let timed = |e: &Entry| Some((e.setting, (time(e)?, e.horizon()?)));
    let median = |e: &Entry| Some((e.setting, (e.errors?[0], e.horizon()?)));
    let timed = by_method(&race.entries, timed);
    let by_median = by_method(&race.entries, median);
    let mut drawn = Vec::new();
    for (panel, methods, places) in
        [(&by_time, timed, &NAMES[..]), (&by_error, by_median, &BY_ERROR[..])]
    {
        for (method, found) in &methods {
            let stroke = Stroke { width: HAIR, ..look(*method).2 };
            for (setting, (x, t)) in found {
                let bar = (*x, t.value - t.error, t.value + t.error);
                panel.bars(&setting.name(), &[bar], 0, stroke)?;
            }
        }
        let point = |(setting, (x, t)): (Setting, (f64, Estimate))| (setting, (x, t.value));
        let points = |found: Vec<_>| found.into_iter().map(point).collect::<Vec<_>>();
        let curves = methods.into_iter().map(|(method, found)| (method, points(found)));
        let curves: rivals::Curves<(f64, f64)> = curves.collect();
        rivals::draw(panel, &curves, places)?;
        drawn.push(curves);
    }
    // Their marks lie above those of the methods, and their lines are where no name may be.
    let colour = |program: &str| if program == "impact-paper" { RED } else { GREY };
    let width = |program: &str| if program == "impact-paper" { LINE } else { THIN };
    for (program, points) in &others {
        let look = (Symbol::OpenDiamond, MEDIUM, Stroke::solid(colour(program), width(program)));
        by_time.markers(program, points, look)?;
    }
    for (program, points) in others {
        let Some(place) = PROGRAMS.iter().find(|place| place.0 == program) else { continue };
        if let Some(at) = points.get(place.2).or(points.last()) {
            by_time.label_nearby(place.1, (at.0, at.1.min(top)), place.3, colour(program))?;
        }
    }
    for (method, points) in &drawn[0] {
        // Where lines leave room.
        let last = points.len() - 1;
        for (i, (setting, at)) in points.iter().enumerate() {
            let offset = match method {
                Advancement if i > 0 => (1, 0),
                RungeKutta if i == last => (1, -1),
                RungeKutta if i == 2 || i == 4 => (1, 1),
                Sampled if i == 0 => (-1, 0),
                Sampled if i == last => (1, 0),
                Verlet if i == 0 || i == last => (0, -1),
                _ => continue,
            };
            by_time.label(&in_powers(setting.value), *at, offset, GREY)?;
        }
    }
    by_time.label("fixed steps", (0.22, 17.0), (1, -1), INK)?;
    by_error.label_nearby("fixed steps", (0.2, 6.0), (-1, -2), INK)?;
    let growth = race.growth.growth().map_or("unknown".into(), |g| short(g.value, 3));
    let description = describe!(
        "Time up to which a run has every impact right, mean of {} chains, n = {}, σ = {}: (a) against measured time over the \
         engine's, the engine at the top left; (b) against the median error of one impact, with the line that the growth λ = \
         {growth} allows.",
        race.parameters.chains,
        run.chain.masses,
        run.sigma,
    );
    Ok(sheet.finish("How long a run is true", description))
}

fn horizon_axis(top: f64) -> Axis {
    let step = if top > 60.0 { 50.0 } else { 10.0 };
    Axis::linear(0.0, top, step, 1, "horizon *t* (1/*ω*)").column("horizon (1/omega)")
}

/// The line that chaos allows, with the band of λ's interval.
fn chaos(panel: &Panel, race: &Race) -> Drawn {
    let at = |error: f64| allowed(race, error).map(|t| (error, t));
    let errors = (0..=72).map(|i| pxfm::f_exp10(-18.0 + 0.25 * f64::from(i)));
    let grid: Vec<_> = errors.filter(|error| panel.x.contains(*error)).filter_map(at).collect();
    let cut = |t: f64| t.min(panel.y.hi);
    let below = grid.iter().map(|(x, t)| (*x, cut(t[0])));
    let above = grid.iter().rev().map(|(x, t)| (*x, cut(t[2])));
    let band = Polygon::new(below.chain(above).collect::<Vec<_>>(), GREY.mix(0.35));
    panel.draw_series("interval of the growth", [band])?;
    let line: Vec<_> = grid.iter().map(|(x, t)| (*x, t[1])).collect();
    let stroke = Stroke::dashed(GREY, LINE, SHORT);
    panel.outside(Outside::Cut).curve("what chaos allows", &line, stroke)
}
