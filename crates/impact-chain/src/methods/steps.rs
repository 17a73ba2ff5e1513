//! Cuts time into equal steps, and checks the ranges of steps, tolerances and end times.

use super::method::Task;
use crate::error::{Error, within};
use crate::search::clock::{Instant, LATEST};

pub const MAX_STEPS: f64 = 1e10;

const SHORTEST: f64 = 1e-9;

/// One of equal steps in time; the last may be shorter.
#[derive(Clone, Copy)]
pub struct Step {
    pub from: Instant,
    pub to: Instant,
    pub h: f64,
}

pub fn steps(
    (scenario, start, until): Task,
    h: f64,
) -> Result<impl Iterator<Item = Step> + use<>, Error> {
    within("step", h, SHORTEST, 1.0 / scenario.fastest())?;
    let count = ((until - start.time).max(0.0) / h).ceil();
    if count > MAX_STEPS {
        return Err(too_many(count, "step"));
    }
    let (begin, end) = (Instant::at(start.time), Instant::at(until));
    let mut from = begin;
    Ok((1..=count as u64).map(move |i| {
        let to = if i < count as u64 { begin.after(i as f64 * h) } else { end };
        let h = if i < count as u64 { h } else { end.since(from).max(0.0) };
        Step { from: std::mem::replace(&mut from, to), to, h }
    }))
}

pub fn too_many(steps: f64, field: &str) -> Error {
    let remedy = format!("give a larger {field} or an earlier end, for at most {MAX_STEPS:e}");
    Error::input(field, format!("{steps:.1e} steps are needed"), remedy)
}

pub fn check_end(until: f64) -> Result<(), Error> {
    within("until", until, -LATEST, LATEST)
}

pub fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    within("tolerance", tolerance, 1e-15, 0.1)
}
