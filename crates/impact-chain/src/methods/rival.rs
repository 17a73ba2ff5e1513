//! Runs the methods other than the engine, which share all but their steps.

use super::method::{Cost, Method, Sealed, Task};
use super::steps::{Step, Steps, check_end};
use super::tally::{Stop, Tally};
use crate::search::clock::Rate;
use crate::vectors::vector_level;
use crate::{Error, Sink};
use fearless_simd::{Simd, dispatch};

/// A method other than the engine.
pub trait Rival: Sync {
    const NAME: &'static str;

    fn begin(&self, task: Task) -> Result<Run, Error>;
}

/// Goes from the start of a task to its end, and hands each impact to the tally.
pub type Run = Box<dyn FnOnce(&mut Tally) -> Result<(), Stop>>;

impl<R: Rival> Sealed for R {}

impl<R: Rival> Method for R {
    fn name(&self) -> &'static str {
        R::NAME
    }

    fn run(&self, task: Task, sink: Sink) -> Result<Cost, Error> {
        check_end(task)?;
        let run = self.begin(task)?;
        let mut tally = Tally::new(task.scenario, sink);
        match run(&mut tally) {
            Err(Stop::Failed(error)) => Err(error),
            Err(Stop::ByReceiver) | Ok(()) => Ok(tally.cost),
        }
    }
}

/// Makes steps of equal length; what is inlined there is compiled for the vectors of the processor.
pub trait Stepper: 'static {
    fn step<S: Simd>(&mut self, simd: S, step: &Step, tally: &mut Tally) -> Result<(), Stop>;
}

pub fn run_steps(
    task: Task,
    h: f64,
    rates: Vec<Rate>,
    mut stepper: impl Stepper,
) -> Result<Run, Error> {
    let steps = Steps::new(task, h, rates)?;
    Ok(Box::new(
        move |tally| dispatch!(vector_level(), simd => make_steps(simd, &steps, &mut stepper, tally)),
    ))
}

/// Makes all steps of a run.
#[inline(always)]
fn make_steps<S: Simd>(
    simd: S,
    steps: &Steps,
    stepper: &mut impl Stepper,
    tally: &mut Tally,
) -> Result<(), Stop> {
    steps.each(
        #[inline(always)]
        |step| {
            tally.cost.steps += 1;
            stepper.step(simd, step, tally)
        },
    )
}
