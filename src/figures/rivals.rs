//! One look for each method in all charts of speed and accuracy.

use super::prelude::*;
use crate::experiments::Measured;
use crate::experiments::accuracy::tables::name;
use crate::experiments::measured::{Measurement, What};
use crate::params::MethodName;

const INK_LINE: Stroke = Stroke::solid(INK, THIN);

/// The look of a method; its line joins the settings of the method.
pub fn look(method: MethodName) -> Marker {
    let (colour, mark) = match method {
        MethodName::Certified => (RED, Mark::Disc),
        MethodName::Sampled => (BLUE, Mark::Ring),
        MethodName::Advancement => (GREEN, Mark::Diamond),
        MethodName::RungeKutta => (ORANGE, Mark::Square),
        MethodName::MoreauJean => (PURPLE, Mark::Triangle),
        MethodName::Verlet => (INK, Mark::Cross),
        MethodName::Penalty | MethodName::Truth => (GREY, Mark::Plus),
    };
    (mark, LARGE, Stroke::solid(colour, THIN))
}

/// Legend entries of some methods, in the order of [`MethodName::ALL`].
pub fn entries(methods: impl Fn(MethodName) -> bool) -> Vec<Entry> {
    let entry = |method| Entry::mark(look(method), name(method));
    MethodName::ALL.into_iter().filter(|m| methods(*m)).map(entry).collect()
}

/// Points of each method that has some, in the order of [`MethodName::ALL`].
pub fn by_method<T, P>(
    rows: &[T],
    point: impl Fn(&T) -> Option<(MethodName, P)>,
) -> Vec<(MethodName, Vec<P>)> {
    let of = |method: MethodName| {
        let own = rows.iter().filter_map(&point).filter(|own| own.0 == method);
        (method, own.map(|own| own.1).collect::<Vec<_>>())
    };
    MethodName::ALL.into_iter().map(of).filter(|(_, points)| !points.is_empty()).collect()
}

/// A program that was timed, and held against the truth on one chain.
pub struct Timed {
    pub name: String,
    /// The method of this project, if it is one.
    pub method: Option<MethodName>,
    pub masses: u64,
    /// Measured time of an impact.
    pub microseconds: f64,
    /// Time up to which it is true; the end of the run if it is true to the end.
    pub horizon: f64,
}

/// All rows of one chain with a time and a horizon.
pub fn timed(measured: &Measured) -> Vec<Timed> {
    let one = |row: &Measurement| {
        let method = match row.what {
            What::Engine => Some(MethodName::Certified),
            What::Method => MethodName::ALL.into_iter().find(|m| m.id() == row.name),
            What::Peer => None,
            What::Ensemble | What::Command | What::Absent => return None,
        };
        Some(Timed {
            name: row.name.clone(),
            method,
            masses: row.n,
            microseconds: row.microseconds_per_impact?,
            horizon: row.compared.map(|_| row.horizon_time.unwrap_or(row.until))?,
        })
    };
    // The engine is the certified method; as one of the methods it is the same, with more to count.
    let again = MethodName::Certified.id();
    let rows = measured.rows.iter().filter(|row| row.chains == 1 && row.n > 0 && row.name != again);
    rows.filter_map(one).collect()
}

/// The most accurate setting of each program at each number of masses; of several, the fastest.
pub fn most_accurate(programs: &[Timed]) -> Vec<&Timed> {
    let quality = |t: &Timed| (t.horizon, -t.microseconds);
    let alike = |a: &Timed, b: &Timed| a.name == b.name && a.masses == b.masses;
    let better = |a: &Timed, b: &Timed| alike(a, b) && quality(a) > quality(b);
    programs.iter().filter(|b| !programs.iter().any(|a| better(a, b))).collect()
}

/// Names of the other programs, sorted, each with its look.
pub fn others(programs: &[Timed]) -> Vec<(&str, Marker)> {
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
    names.into_iter().zip(MARKS.into_iter().cycle().map(|mark| (mark, LARGE, INK_LINE))).collect()
}

/// The look of a program: of its method, or that of the others.
pub fn look_of(program: &Timed, others: &[(&str, Marker)]) -> Marker {
    let other = || others.iter().find(|(name, _)| *name == program.name).map(|(_, look)| *look);
    program.method.map(look).or_else(other).unwrap_or((Mark::Square, LARGE, INK_LINE))
}
