//! Runs the engine of this project as a `Method`, so that it can be compared with its rivals.

use super::method::{Cost, Method, Sealed, Task};
use super::steps::check_end;
use crate::{Engine, Error, Event, Sink};
use std::ops::ControlFlow::{Break, Continue};

/// The exact event-driven engine: flight in closed form, the first root of each gap certified.
///
/// - Source: this project, [`crate::Engine`].
/// - Order: none, it has no step. The time of an impact is off by a few roundings of the width,
///   divided by the closing speed.
/// - Fails: nowhere within the model; a run that needs more events than its bound is an error.
#[derive(Clone, Copy, Debug, Default)]
pub struct Certified;

impl Sealed for Certified {}

impl Method for Certified {
    fn name(&self) -> &'static str {
        "certified"
    }

    fn run(&self, task: Task, sink: Sink) -> Result<Cost, Error> {
        check_end(task)?;
        let mut engine = Engine::from_state(task.scenario, task.start)?;
        engine.run(task.until, |event, _| match event {
            Event::Impact(impact) if !sink(*impact) => Break(()),
            _ => Continue(()),
        })?;
        let counters = engine.counters();
        Ok(Cost {
            impacts: counters.impacts,
            steps: counters.searches,
            evaluations: counters.evaluations,
            simultaneous: counters.simultaneous,
            undecided: counters.undecided,
            first_graze: engine.first_graze(),
        })
    }
}
