//! Runs the methods other than the engine, which share all but their steps.

use super::method::{Cost, Method, Task};
use super::steps::{Step, check_end, steps};
use super::tally::{Stop, Tally};
use crate::{Error, Sink};

/// A method other than the engine.
pub trait Rival: Sync {
    const NAME: &'static str;

    fn begin(&self, task: Task) -> Result<Run, Error>;
}

/// Goes from the start of a task to its end, and hands each impact to the tally.
pub type Run = Box<dyn FnOnce(&mut Tally) -> Result<(), Stop>>;

impl<R: Rival> Method for R {
    fn name(&self) -> &'static str {
        R::NAME
    }

    fn run(&self, task: Task, sink: Sink) -> Result<Cost, Error> {
        let (scenario, _, until) = task;
        check_end(until)?;
        let run = self.begin(task)?;
        let mut tally = Tally::new(scenario, sink);
        match run(&mut tally) {
            Err(Some(error)) => Err(error),
            Err(None) | Ok(()) => Ok(tally.cost),
        }
    }
}

pub trait Stepper: 'static {
    fn step(&mut self, step: &Step, tally: &mut Tally) -> Result<(), Stop>;
}

pub fn run_steps(task: Task, h: f64, mut stepper: impl Stepper) -> Result<Run, Error> {
    let mut steps = steps(task, h)?;
    Ok(Box::new(move |tally| {
        steps.try_for_each(|step| {
            tally.cost.steps += 1;
            stepper.step(&step, tally)
        })
    }))
}
