//! Draws methods and other programs in all charts of speed and accuracy: this engine red, all
//! others grey, each named next to its symbols.

use super::prelude::*;
use crate::experiments::Measured;
use crate::experiments::measured::What;
use crate::params::MethodName;

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

pub type Curves = Vec<(MethodName, Vec<(f64, f64)>)>;

/// Where the name of a method stands: next to which of its settings, with an offset to the right
/// and down in millimetres; and another name, for methods whose marks coincide.
pub type Place = (MethodName, usize, (i32, i32), Option<&'static str>);

pub const FINEST: usize = usize::MAX;

/// Draws the settings of each method as marks on a line, and the names of some next to their marks.
pub fn draw(panel: &Panel, curves: &Curves, places: &[Place]) -> Drawn {
    for (method, points) in curves {
        let look = look(*method);
        let line = Stroke { width: THIN, ..look.2 };
        panel.marked_curve(method.title(), points, line, look)?;
    }
    for (method, setting, offset, name) in places {
        let curve = curves.iter().find(|curve| curve.0 == *method).map(|curve| &curve.1);
        if let Some(at) = curve.and_then(|curve| curve.get(*setting).or(curve.last())) {
            let inside = (at.0, at.1.clamp(panel.y.lo, panel.y.hi));
            let colour = if *method == MethodName::Certified { RED } else { INK };
            panel.label_nearby(name.unwrap_or(method.title()), inside, *offset, colour)?;
        }
    }
    Ok(())
}

/// Points of each method that has some, in the order of [`MethodName::ALL`].
pub fn by_method<T, P>(
    rows: &[T],
    point: impl Fn(&T) -> Option<(MethodName, P)>,
) -> Vec<(MethodName, Vec<P>)> {
    let points_of = |method: MethodName| {
        let at = rows.iter().filter_map(&point).filter(|at| at.0 == method);
        (method, at.map(|at| at.1).collect::<Vec<_>>())
    };
    MethodName::ALL.into_iter().map(points_of).filter(|(_, points)| !points.is_empty()).collect()
}

/// Returns other programs on one chain of `masses` masses: for each setting the time of an impact
/// over the engine's, and the time up to which the run is right, at most its end.
pub fn programs(measured: &Measured, masses: usize) -> Vec<(&str, Vec<(f64, f64)>)> {
    let mut found: Vec<(&str, Vec<(f64, f64)>)> = Vec::new();
    for row in measured.of(What::Peer).filter(|row| row.n == masses as u64) {
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
