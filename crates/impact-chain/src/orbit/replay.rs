//! A periodic orbit, run through the certified engine.

use super::Orbit;
use crate::{Engine, Error, Initial, Scenario};

/// What the engine says of an orbit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Replay {
    /// The largest difference of the time of an impact.
    pub late: f64,
    /// The largest difference of a free amplitude after the period from the one that would repeat.
    pub off: f64,
}

/// Differences above this, in units of time or length, are another motion. Rounding is 10^-14, and an unstable
/// orbit multiplies it in a period.
pub const TOLERANCE: f64 = 1e-6;

/// Starts the engine on an orbit and lets it run for one period. None if other gaps close than those of
/// the circuit, or in another order, or not at its times, or if the start overlaps.
///
/// # Errors
/// Those of [`Engine::new`] and [`Engine::run`], but for the overlap.
pub fn replay(scenario: &Scenario, orbit: &Orbit) -> Result<Option<Replay>, Error> {
    let start = Scenario { initial: Initial::Free(orbit.free.clone()), ..scenario.clone() };
    let mut engine = match Engine::new(&start) {
        Err(Error::Overlap { .. }) => return Ok(None),
        other => other?,
    };
    let (mut seen, mut same) = (0, true);
    let mut late: f64 = 0.0;
    engine.run(orbit.period, |impact| {
        same &= orbit.gaps.get(seen) == Some(&impact.gap);
        if same {
            late = late.max((impact.time - orbit.times[seen]).abs());
        }
        seen += 1;
        same
    })?;
    if !same || seen != orbit.gaps.len() || engine.counters().contact_phases > 0 {
        return Ok(None);
    }
    let (sin, cos) = pxfm::f_sincos(scenario.natural_frequency * orbit.period);
    let returned = engine.free_parts().into_iter().zip(&orbit.free);
    let off = returned.fold(0.0, |most: f64, ([a, b], [c, d])| {
        let [x, y] = [a * cos + b * sin - c, b * cos - a * sin - d];
        most.max(x.abs()).max(y.abs())
    });
    Ok((late < TOLERANCE && off < TOLERANCE).then_some(Replay { late, off }))
}
