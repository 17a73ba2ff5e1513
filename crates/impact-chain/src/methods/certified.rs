//! Runs the engine of this project under the trait of its rivals.

use super::method::{Cost, Method, Task};
use super::steps::check_end;
use crate::{Engine, Error, Graze, Impact, LATEST, Sink, State};

/// The exact event-driven engine: flight in closed form, the first root of each gap certified.
///
/// - Source: this project, [`crate::Engine`].
/// - Order: none, it has no step. The time of an impact is off by a few roundings of the gap over
///   its speed.
/// - Fails: nowhere within the model; a run that needs more events than its bound is an error.
#[derive(Clone, Copy, Debug, Default)]
pub struct Certified;

impl Method for Certified {
    fn name(&self) -> &'static str {
        "certified"
    }

    fn run(&self, (scenario, start, until): Task, sink: Sink) -> Result<Cost, Error> {
        check_end(until)?;
        scenario.validate()?;
        let same = *start == State::of(scenario);
        let moved = if same { None } else { Some(start.as_scenario(scenario)?) };
        let mut engine = Engine::new(moved.as_ref().unwrap_or(scenario))?;
        let later = |time: f64| start.time + time;
        engine
            .run((until - start.time).max(-LATEST), |hit| {
                sink(Impact { time: later(hit.time), ..hit })
            })
            .map_err(|error| match error {
                Error::Work { gap, time, bound } => Error::Work { gap, time: later(time), bound },
                other => other,
            })?;
        let counters = engine.counters();
        Ok(Cost {
            impacts: counters.impacts,
            steps: counters.searches,
            evaluations: counters.evaluations,
            simultaneous: counters.simultaneous,
            undecided: counters.undecided,
            first_graze: engine.first_graze().map(|at| Graze { time: later(at.time), ..at }),
        })
    }
}
