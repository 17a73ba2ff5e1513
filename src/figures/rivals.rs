//! Draws methods and other programs in all charts of speed and accuracy: this engine red, all
//! others grey, each named next to its symbols.

use super::prelude::*;
use crate::experiments::Measured;
use crate::experiments::accuracy::race::Race;
use crate::experiments::measured::What;
use crate::params::{MethodName, Setting};

/// The look of a method; its line joins the settings of the method.
pub fn look(method: MethodName) -> Marker {
    let (mark, size) = match method {
        MethodName::Certified => return (Symbol::Disc, LARGE + 12, Stroke::solid(RED, LINE)),
        MethodName::Sampled => (Symbol::Ring, MEDIUM + 4),
        MethodName::Advancement => (Symbol::OpenSquare, MEDIUM),
        MethodName::RungeKutta => (Symbol::Disc, MEDIUM),
        MethodName::MoreauJean => (Symbol::Plus, MEDIUM + 14),
        MethodName::Penalty => (Symbol::OpenTriangle, MEDIUM),
        MethodName::Verlet | MethodName::Truth => (Symbol::Cross, MEDIUM),
    };
    (mark, size, Stroke::solid(GREY, THIN))
}

/// Points of methods, with their settings.
pub type Curves<P> = Vec<(MethodName, Vec<(Setting, P)>)>;

/// Where the name of a method stands: next to which of its settings, with an offset to the right
/// and down in millimetres; and another name, for methods whose marks coincide.
pub type Place = (MethodName, usize, (i32, i32), Option<&'static str>);

/// Returns the axis of times that S6 and S7 share.
pub fn time_axis() -> Axis {
    Axis::decades(0, 4, 1, "measured time of an impact over the engine’s")
        .between(0.2, 8e3)
        .column("measured time over the engine's (1)")
}

pub const FINEST: usize = usize::MAX;

/// Draws the settings of each method as marks on a line, and the names of some next to their marks.
/// In the data each setting is a series.
pub fn draw(panel: &Panel, curves: &Curves<(f64, f64)>, places: &[Place]) -> Drawn {
    for (method, points) in curves {
        let look = look(*method);
        let line = Stroke { width: THIN, ..look.2 };
        let places: Vec<(f64, f64)> = points.iter().map(|point| point.1).collect();
        panel.unrecorded().marked_curve(method.title(), &places, line, look)?;
        for (setting, point) in points {
            panel.record(&setting.name(), [*point]);
        }
    }
    for (method, setting, offset, name) in places {
        let curve = curves.iter().find(|curve| curve.0 == *method).map(|curve| &curve.1);
        if let Some((_, at)) = curve.and_then(|curve| curve.get(*setting).or(curve.last())) {
            let inside = (at.0, at.1.clamp(panel.y.lo, panel.y.hi));
            let colour = if *method == MethodName::Certified { RED } else { INK };
            panel.label_nearby(name.unwrap_or(method.title()), inside, *offset, colour)?;
        }
    }
    Ok(())
}

/// Returns the measured time of an impact over the engine's, on the chains of the race.
pub fn over_engine(race: &Race, measured: &Measured, setting: Setting) -> Option<f64> {
    let run = &race.parameters.growth;
    match setting.method {
        MethodName::Certified => Some(1.0),
        _ => measured.method(setting, run.chain.masses, run.sigma)?.over_engine(),
    }
}

/// Points of each method that has some, in the order of [`MethodName::ALL`].
pub fn by_method<T, P>(rows: &[T], point: impl Fn(&T) -> Option<(Setting, P)>) -> Curves<P> {
    let points_of = |method: MethodName| {
        let at = rows.iter().filter_map(&point).filter(|at| at.0.method == method);
        (method, at.collect::<Vec<_>>())
    };
    MethodName::ALL.into_iter().map(points_of).filter(|(_, points)| !points.is_empty()).collect()
}

/// Returns the engine and other programs on one chain of `masses` masses: for each setting the time
/// of an impact over the engine's, and the time up to which the run is right, at most its end.
pub fn programs(measured: &Measured, masses: usize) -> Vec<(&str, Vec<(f64, f64)>)> {
    let mut found: Vec<(&str, Vec<(f64, f64)>)> = Vec::new();
    let rows = measured.of(What::Engine).chain(measured.of(What::Peer));
    for row in rows.filter(|row| row.n == masses as u64 && row.chains == 1) {
        let time = row.microseconds_per_impact.zip(measured.engine(row));
        let Some(time) = time.map(|(time, engine)| time / engine) else { continue };
        let point = (time, row.horizon_time.unwrap_or(row.until));
        match found.last_mut().filter(|last| last.0 == row.name) {
            Some(last) => last.1.push(point),
            None => found.push((&row.name, vec![point])),
        }
    }
    found
}
