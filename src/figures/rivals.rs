//! One look for each method in all charts of speed and accuracy, and what it is called.

use super::axis::Axis;
use super::sheet::Entry;
use super::style::{BLUE, Colour, GREEN, GREY, INK, Mark, ORANGE, PURPLE, RED, Stroke, THIN};
use crate::experiments::Measured;
use crate::experiments::measured::{Row, What};
use crate::params::{MethodName, Setting};

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
