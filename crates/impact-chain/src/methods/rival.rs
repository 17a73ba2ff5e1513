//! Runs the engine as a `Method`, and its rivals, which share all but their steps: their work is
//! counted and bounded.

use super::method::{Cost, Method, Sealed, Task};
use super::steps::{MAX_STEPS, Step, Steps, check_end, too_many_steps};
use crate::budget::Budget;
use crate::search::clock::Rate;
use crate::topology::Topology;
use crate::vectors::vector_level;
use crate::{Engine, Error, Event, Impact, Scenario, Sink};
use fearless_simd::{Simd, dispatch};
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

pub enum Stop {
    Failed(Error),
    /// The receiver of the impacts asked for it.
    ByReceiver,
}

impl From<Error> for Stop {
    fn from(error: Error) -> Stop {
        Stop::Failed(error)
    }
}

/// The counted work of a run; impacts pass through it.
pub struct Tally<'a> {
    pub cost: Cost,
    sink: Sink<'a>,
    topology: Topology,
    /// One unit of time, 1/ω.
    unit: f64,
    budget: Budget<f64>,
}

impl<'a> Tally<'a> {
    pub fn new(scenario: &Scenario, sink: Sink<'a>) -> Self {
        let topology = Topology::new(scenario.forcing.len(), scenario.boundary);
        Tally {
            cost: Cost::default(),
            sink,
            topology,
            unit: 1.0 / scenario.natural_frequency,
            budget: Budget::new(topology.gaps(), f64::NEG_INFINITY),
        }
    }

    /// Lowers the bound of a method whose least rebound speed is zero: its chatters have no end.
    pub fn limit_chatter(&mut self, least_rebound: f64) {
        if least_rebound == 0.0 {
            self.budget.bound /= 10;
        }
    }

    /// Takes an event of gap k from the budget of the current unit of time.
    pub fn spend(&mut self, k: usize, time: f64) -> Result<(), Stop> {
        if self.budget.spend(time, || time + self.unit) {
            return Ok(());
        }
        let (gap, bound) = (self.topology.label(k), self.budget.bound);
        Err(Error::Work { gap, time, bound }.into())
    }

    pub fn impact(&mut self, k: usize, time: f64, closing_speed: f64) -> Result<(), Stop> {
        self.spend(k, time)?;
        self.cost.impacts += 1;
        if (self.sink)(Impact { time, gap: self.topology.label(k), closing_speed }) {
            Ok(())
        } else {
            Err(Stop::ByReceiver)
        }
    }

    /// Counts an impact if it has a speed; without one it is an event only, of a gap that rests at
    /// zero.
    pub fn event(&mut self, k: usize, time: f64, speed: f64) -> Result<(), Stop> {
        if speed > 0.0 { self.impact(k, time, speed) } else { self.spend(k, time) }
    }

    /// Counts one more step of an integrator that chooses its steps.
    pub fn step(&mut self) -> Result<(), Stop> {
        self.cost.steps += 1;
        if self.cost.steps as f64 > MAX_STEPS {
            return Err(too_many_steps(self.cost.steps as f64, "tolerance").into());
        }
        Ok(())
    }
}
