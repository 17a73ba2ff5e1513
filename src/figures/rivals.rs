//! Draws methods in all charts of speed and accuracy, each named next to its symbols.

use super::prelude::*;
use crate::experiments::Measured;
use crate::experiments::accuracy::race::Race;
use crate::experiments::measured::Subject;

/// The point of a setting, with its interval in y if it has one.
pub struct Point {
    pub setting: Setting,
    pub x: f64,
    pub y: f64,
    pub interval: Option<[f64; 2]>,
}

/// Points of methods.
pub type Curves = Vec<(MethodName, Vec<Point>)>;

/// Where the name of a method stands: next to which of its settings, with an offset to the right
/// and down in millimetres.
pub struct Place {
    pub method: MethodName,
    pub setting: usize,
    pub offset: (i32, i32),
}

/// Makes the axis of times over the engine's, up to `longest`.
pub fn time_axis(longest: f64) -> Axis {
    Axis::decades(0, 4, 1, "measured time of an impact over the engine’s")
        .between(0.2, longest)
        .column("measured time over the engine's (1)")
}

/// The last setting of a method, however many it has.
pub const FINEST: usize = usize::MAX;

/// Draws the settings of each method as marks on a line, and the names of some next to their marks.
/// In the data each setting is a series.
pub fn draw(panel: &Panel, curves: &Curves, places: &[Place]) -> Drawn {
    // The engine on top of all others.
    let (engine, others): (Vec<_>, Vec<_>) =
        curves.iter().partition(|curve| curve.0 == MethodName::Certified);
    for (method, points) in others.into_iter().chain(engine) {
        let look = encoding::method(*method);
        // Thin lines of several colours would not be told apart.
        let bar = Stroke::solid(if *method == MethodName::Certified { RED } else { GREY }, HAIR);
        for Point { setting, x, y, interval } in points {
            if let Some([low, high]) = interval {
                panel.bars(&setting.name(), &[(*x, *low, *high)], 0, bar)?;
            }
            panel.record(&setting.name(), [(*x, *y)]);
        }
        let places: Vec<_> = points.iter().map(|point| (point.x, point.y)).collect();
        let line = Stroke { width: THIN, ..look.2 };
        panel.unrecorded().marked_curve(method.title(), &places, line, look)?;
    }
    for Place { method, setting, offset } in places {
        let curve = curves.iter().find(|curve| curve.0 == *method).map(|curve| &curve.1);
        if let Some(Point { x, y, .. }) =
            curve.and_then(|curve| curve.get(*setting).or(curve.last()))
        {
            let inside = (*x, y.clamp(panel.y.lo, panel.y.hi));
            let colour = encoding::method(*method).2.colour;
            let colour = if colour == GREY { INK } else { colour };
            panel.label_nearby(method.title(), inside, *offset, colour)?;
        }
    }
    Ok(())
}

/// Draws the marks of the methods of fixed steps, whose curves lie close together, with their
/// names, one below the other.
pub fn key(panel: &Panel, x: f64, heights: [f64; 3]) -> Drawn {
    let methods = [MethodName::MoreauJean, MethodName::Verlet, MethodName::Penalty];
    for (method, y) in methods.into_iter().zip(heights) {
        panel.unrecorded().markers(method.title(), &[(x, y)], encoding::method(method))?;
        panel.label(method.title(), (x, y), (2, 0), INK)?;
    }
    Ok(())
}

/// Draws an arrow to the corner where the best methods stand.
pub fn better(panel: &Panel, from: (f64, f64), to: (f64, f64)) -> Drawn {
    panel.area.draw(&arrow(vec![from, to], Stroke::solid(INK, THIN)))?;
    panel.label("better", from, (0, if to.1 > from.1 { 1 } else { -1 }), INK)
}

/// Returns the measured time of an impact over the engine's, on the chains of the race.
pub fn over_engine(race: &Race, measured: &Measured, setting: Setting) -> Option<f64> {
    let run = &race.parameters.growth;
    match setting.method {
        MethodName::Certified => Some(1.0),
        _ => measured.method(setting, run.chain.masses, run.sigma)?.over_engine(),
    }
}

/// Points of each method that has some, in the order of [`MethodName::ALL`], without chains side by
/// side, whose times are not those of one.
pub fn by_method<T>(rows: &[T], point: impl Fn(&T) -> Option<Point>) -> Curves {
    let is_alone = |point: &Point| point.setting.method != MethodName::VerletAbreast;
    all_by_method(rows, |row| point(row).filter(is_alone))
}

/// Points of each method that has some, chains side by side included.
pub fn all_by_method<T>(rows: &[T], point: impl Fn(&T) -> Option<Point>) -> Curves {
    let points_of = |method: MethodName| {
        let own = rows.iter().filter_map(&point).filter(|point| point.setting.method == method);
        (method, own.collect::<Vec<_>>())
    };
    MethodName::ALL.into_iter().map(points_of).filter(|(_, points)| !points.is_empty()).collect()
}

/// Returns the engine and other programs on one chain of `masses` masses: for each setting the time
/// of an impact over the engine's, and the time up to which the run is right, at most its end.
pub fn programs(measured: &Measured, masses: usize) -> Vec<(&str, Vec<(f64, f64)>)> {
    let mut groups: Vec<(&str, Vec<(f64, f64)>)> = Vec::new();
    let rows = measured.rows_about(Subject::Engine).chain(measured.rows_about(Subject::Peer));
    for row in rows.filter(|row| row.n == masses as u64 && row.chains == 1) {
        let time = row.microseconds_per_impact.zip(measured.engine(row));
        let Some(time) = time.map(|(time, engine)| time / engine) else { continue };
        let point = (time, row.horizon_time.unwrap_or(row.until));
        match groups.last_mut().filter(|last| last.0 == row.name) {
            Some(last) => last.1.push(point),
            None => groups.push((&row.name, vec![point])),
        }
    }
    groups
}
