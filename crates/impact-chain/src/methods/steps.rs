//! Equal steps in time, and the ranges of steps, tolerances and end times.

use super::prelude::*;
use crate::scenario::within;

pub const MOST_STEPS: f64 = 1e10;

const SHORTEST: f64 = 1e-9;

/// One of equal steps in time; the last one may be shorter.
#[derive(Clone, Copy)]
pub struct Step {
    pub from: Instant,
    pub to: Instant,
    pub h: f64,
}

/// The steps of length `h` from `start` to `until`, in order.
pub fn steps(
    scenario: &Scenario,
    start: &State,
    until: f64,
    h: f64,
) -> Result<impl Iterator<Item = Step>, Error> {
    within("step", h, SHORTEST, 1.0 / scenario.fastest())?;
    check_end(until)?;
    let count = ((until - start.time).max(0.0) / h).ceil();
    if count > MOST_STEPS {
        return Err(too_many(count, "step"));
    }
    let (begin, end) = (Instant::at(start.time), Instant::at(until));
    let mut from = begin;
    Ok((1..=count as u64).map(move |i| {
        let step = match i < count as u64 {
            true => Step { from, to: begin.after(i as f64 * h), h },
            false => Step { from, to: end, h: end.since(from).max(0.0) },
        };
        from = step.to;
        step
    }))
}

pub fn too_many(steps: f64, field: &str) -> Error {
    let remedy = format!("give a larger {field} or an earlier end, for at most {MOST_STEPS:e}");
    Error::input(field, format!("{steps:.1e} steps are needed"), remedy)
}

pub fn check_end(until: f64) -> Result<(), Error> {
    within("until", until, -LATEST, LATEST)
}

/// Refuses a tolerance outside 1e-15 to 0.1.
pub fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    within("tolerance", tolerance, 1e-15, 0.1)
}
