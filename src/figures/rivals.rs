//! One look for each method in all charts of speed and accuracy, and what it is called.

use super::axis::Axis;
use super::sheet::Entry;
use super::style::{BLUE, Colour, GREEN, GREY, INK, Mark, ORANGE, PURPLE, RED, Stroke, THIN};
use crate::experiments::Measured;
use crate::experiments::measured::{Row, What};
use crate::params::{MethodName, Setting};

/// Colour and marker of a method.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Colour.
    pub colour: Colour,
    /// Marker.
    pub mark: Mark,
}

/// Half the width of a marker.
pub const HALF: i32 = 58;

impl Look {
    /// The marker as the panels draw it.
    pub fn marker(self) -> (Mark, i32, Stroke) {
        (self.mark, HALF, Stroke::solid(self.colour, THIN))
    }

    /// The line that joins the settings of a method.
    pub fn line(self) -> Stroke {
        Stroke::solid(self.colour, THIN)
    }
}

/// The look of a method.
pub fn look(method: MethodName) -> Look {
    let (colour, mark) = match method {
        MethodName::Certified => (RED, Mark::Disc),
        MethodName::Sampled => (BLUE, Mark::Ring),
        MethodName::Newton => (GREEN, Mark::Diamond),
        MethodName::RungeKutta => (ORANGE, Mark::Square),
        MethodName::MoreauJean => (PURPLE, Mark::Triangle),
        MethodName::Verlet => (INK, Mark::Cross),
        MethodName::Penalty => (GREY, Mark::Plus),
    };
    Look { colour, mark }
}

/// What a method is called.
pub fn name(method: MethodName) -> &'static str {
    match method {
        MethodName::Certified => "certified events",
        MethodName::Sampled => "sampled gaps",
        MethodName::Newton => "Newton’s iteration",
        MethodName::RungeKutta => "Runge–Kutta",
        MethodName::MoreauJean => "time stepping",
        MethodName::Verlet => "Verlet with a flip",
        MethodName::Penalty => "penalty springs",
    }
}

/// Legend entries of some methods, in the order of [`MethodName::ALL`].
pub fn entries(methods: impl Fn(MethodName) -> bool) -> Vec<Entry> {
    let entry = |method: MethodName| {
        let (mark, half, stroke) = look(method).marker();
        Entry::mark(mark, half, stroke, name(method))
    };
    MethodName::ALL.into_iter().filter(|m| methods(*m)).map(entry).collect()
}

/// Points of each method that has some, in the order of [`MethodName::ALL`].
pub fn by_method<T>(
    rows: &[T],
    setting: impl Fn(&T) -> Setting,
    point: impl Fn(&T) -> Option<(f64, f64)>,
) -> Vec<(MethodName, Vec<(f64, f64)>)> {
    let of = |method: MethodName| {
        let own = rows.iter().filter(|row| setting(row).method == method);
        (method, own.filter_map(&point).collect::<Vec<_>>())
    };
    MethodName::ALL.into_iter().map(of).filter(|(_, points)| !points.is_empty()).collect()
}

/// The decades that hold all values, as a logarithmic axis.
pub fn decades_around(values: impl Iterator<Item = f64>, every: i32, label: &str) -> Axis {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        low = low.min(super::axis::log(value));
        high = high.max(super::axis::log(value));
    }
    if low > high {
        (low, high) = (0.0, 1.0);
    }
    let (low, high) = (low.floor() as i32, high.ceil() as i32);
    Axis::decades(low, high.max(low + 1), every, label)
}

/// A program that was timed, and held against the truth on one chain.
#[derive(Clone, Debug)]
pub struct Timed {
    /// Name of the program.
    pub name: String,
    /// The method of this project, if it is one.
    pub method: Option<MethodName>,
    /// Version.
    pub version: String,
    /// Step, tolerance or options.
    pub settings: String,
    /// Number of masses.
    pub masses: u64,
    /// Measured time of an impact.
    pub microseconds: f64,
    /// Time up to which it is true; the end of the run if it is true to the end.
    pub horizon: Option<f64>,
    /// Impacts that it was held against.
    pub compared: Option<u64>,
}

/// All rows of one chain with a time.
pub fn timed(measured: &Measured) -> Vec<Timed> {
    let one = |row: &Row| {
        let method = match row.what {
            What::Engine => Some(MethodName::Certified),
            What::Method => MethodName::ALL.into_iter().find(|m| m.id() == row.name),
            What::Peer => None,
            What::Ensemble | What::Command | What::Absent => return None,
        };
        Some(Timed {
            name: row.name.clone(),
            method,
            version: row.version.clone(),
            settings: row.settings.clone(),
            masses: row.n,
            microseconds: row.microseconds_per_impact?,
            horizon: row.compared.map(|_| row.horizon_time.unwrap_or(row.until)),
            compared: row.compared,
        })
    };
    measured.rows.iter().filter(|row| row.chains == 1 && row.n > 0).filter_map(one).collect()
}

/// The most accurate setting of each program at each number of masses; of several, the fastest.
pub fn most_accurate(programs: &[Timed]) -> Vec<&Timed> {
    let better = |a: &Timed, b: &Timed| {
        let alike = a.name == b.name && a.masses == b.masses;
        let quality = |t: &Timed| t.horizon.unwrap_or(0.0);
        let ahead =
            quality(a) > quality(b) || quality(a) == quality(b) && a.microseconds < b.microseconds;
        alike && ahead
    };
    programs.iter().filter(|b| !programs.iter().any(|a| better(a, b))).collect()
}

/// Names of the other programs, sorted, each with its look.
pub fn others(programs: &[Timed]) -> Vec<(&str, Look)> {
    const MARKS: [Mark; 6] = [
        Mark::OpenSquare,
        Mark::OpenDiamond,
        Mark::OpenTriangle,
        Mark::Square,
        Mark::Diamond,
        Mark::Triangle,
    ];
    let mut names: Vec<&str> =
        programs.iter().filter(|p| p.method.is_none()).map(|p| p.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let look = |i: usize| Look { colour: INK, mark: MARKS[i % MARKS.len()] };
    names.into_iter().enumerate().map(|(i, name)| (name, look(i))).collect()
}

/// The look of a program: of its method, or that of the others.
pub fn look_of(program: &Timed, others: &[(&str, Look)]) -> Look {
    let other = || others.iter().find(|(name, _)| *name == program.name).map(|(_, look)| *look);
    program.method.map(look).or_else(other).unwrap_or(Look { colour: INK, mark: Mark::Square })
}

/// Legend entries of the other programs.
pub fn entries_of_others(others: &[(&str, Look)]) -> Vec<Entry> {
    let entry = |(name, look): &(&str, Look)| {
        let (mark, half, stroke) = look.marker();
        Entry::mark(mark, half, stroke, name)
    };
    others.iter().map(entry).collect()
}
