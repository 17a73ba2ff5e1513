//! Draws Fig. S10: how long all impacts of a run are right, against time and one impact's error.

use super::prelude::*;
use super::rivals::{self, FINEST, Place, Point, by_method, over_engine, programs};
use crate::experiments::accuracy::race::{DISPLACED, Entry, Race};
use crate::experiments::{MEASURED, RACE};
use crate::params::MethodName::*;

/// Where names stand in (a).
const NAMES_IN_A: [Place; 3] = [
    Place { method: Certified, setting: FINEST, offset: (0, 2) },
    Place { method: Advancement, setting: 2, offset: (-2, 0) },
    Place { method: RungeKutta, setting: 3, offset: (3, 1) },
];

/// The same in (b), for other programs: name of the row, name here.
const PROGRAMS: [(&str, &str, usize, (i32, i32)); 6] = [
    ("impact-paper", "engine", FINEST, (2, 0)),
    ("heyoka", "heyoka", FINEST, (0, -2)),
    ("SUNDIALS CVODE", "CVODE", FINEST, (2, 0)),
    ("SciPy DOP853", "SciPy", FINEST, (-2, 0)),
    ("pymunk", "pymunk", FINEST, (0, -2)),
    ("diffsol tsit45", "diffsol", 0, (-2, 0)),
];

/// The same for (c).
const NAMES_IN_C: [Place; 4] = [
    Place { method: Certified, setting: FINEST, offset: (-2, 0) },
    Place { method: Sampled, setting: 0, offset: (-1, 2) },
    Place { method: Advancement, setting: 2, offset: (0, 3) },
    Place { method: RungeKutta, setting: 1, offset: (-2, 0) },
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
    let sheet = Sheet::new(10900);
    let top = (race.parameters.until / 50.0).ceil() * 50.0;
    let x = || rivals::time_axis(1.3e4);
    let (by_time, others) = (Frame::new(1100, 430, 8250, 3230), Frame::new(1100, 3800, 8250, 6600));
    let by_time =
        sheet.lettered("(a)", by_time, x().without_numbers(), horizon_axis(top))?.outside(Edge);
    let others = sheet.lettered("(b)", others, x(), horizon_axis(top))?.outside(Edge);
    let x = Axis::decades(-18, 0, 3, "median error of the next impact (1/*ω*)").between(1e-20, 0.5);
    let by_error = Frame::new(1100, 7750, 8250, 9950);
    let by_error = sheet.lettered("(c)", by_error, x, horizon_axis(top))?.outside(Edge);

    chaos(&by_error, race)?;
    if let Some([_, ceiling, _]) = allowed(race, f64::EPSILON / 2.0).filter(|t| t[1] < top) {
        let name = "what chaos allows in double precision";
        by_time.level(name, ceiling, Stroke::dashed(GREY, LINE, SHORT))?;
        by_time.label(name, (by_time.x.hi, ceiling), (-1, -1), GREY)?;
    }
    let run = &race.parameters.growth;
    let time = |e: &Entry| over_engine(race, measured, e.setting);
    let point = |setting, x: f64, t: Estimate| {
        let interval = Some([t.value - t.error, t.value + t.error]);
        Point { setting, x, y: t.value, interval }
    };
    let against_time = |e: &Entry| Some(point(e.setting, time(e)?, e.horizon()?));
    let against_error = |e: &Entry| Some(point(e.setting, e.errors?[0], e.horizon()?));
    let curves = by_method(&race.entries, against_time);
    rivals::key(&by_time, 700.0, [0.48, 0.37, 0.26].map(|share| share * top))?;
    rivals::draw(&by_time, &curves, &NAMES_IN_A)?;
    rivals::draw(&by_error, &by_method(&race.entries, against_error), &NAMES_IN_C)?;
    for (program, points) in programs(measured, run.chain.masses) {
        let Some(place) = PROGRAMS.iter().find(|place| place.0 == program) else { continue };
        let mark = match place.1 {
            "engine" => encoding::method(Certified),
            _ => (Symbol::OpenDiamond, LARGE, Stroke::solid(INK, THIN)),
        };
        let colour = mark.2.colour;
        others.marked_curve(program, &points, Stroke::solid(colour, THIN), mark)?;
        if let Some(at) = points.get(place.2).or(points.last()) {
            others.label_nearby(place.1, (at.0, at.1.min(top)), place.3, colour)?;
        }
    }
    // The coarsest and the finest setting, below the name or with it.
    for (method, points) in &curves {
        let Some((first, last)) = points.first().zip(points.last()) else { continue };
        let [from, to] = [first, last].map(|point| in_powers(point.setting.value));
        let (words, at, offset, colour) = match method {
            Advancement => (format!("{from} to {to}"), points.get(2), (-2, 3), INK),
            RungeKutta => (format!("{from} to {to}"), points.get(3), (3, 4), INK),
            Sampled => (format!("sampling, {from} to {to}"), Some(last), (1, -2), INK),
            Verlet => (from, Some(first), (0, -1), ORANGE),
            _ => continue,
        };
        if let Some(Point { x, y, .. }) = at {
            by_time.label_nearby(&words, (*x, y.min(top)), offset, colour)?;
        }
        if *method == Verlet && points.len() > 1 {
            by_time.label_nearby(&to, (last.x, last.y), (0, -1), colour)?;
        }
    }
    rivals::better(&by_time, (400.0, 0.68 * top), (210.0, 0.79 * top))?;
    rivals::better(&others, (400.0, 0.68 * top), (210.0, 0.79 * top))?;
    let growth = race.growth.growth().map_or("unknown".into(), |g| short(g.value, 3));
    let description = describe!(
        "Time up to which a run has every impact right, n = {}, σ = {}: against measured time over the engine's (a) for this program, \
         mean of {} chains, the engine at the top left, and (b) for others on one chain; (c) against the median error of one impact, \
         with the line that λ = {growth} allows.",
        run.chain.masses,
        run.sigma,
        race.parameters.chains,
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
    panel.outside(Cut).curve("what chaos allows", &line, Stroke::dashed(GREY, LINE, SHORT))
}
