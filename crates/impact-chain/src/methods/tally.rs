//! Counts the work of a rival, and bounds it.

use super::method::Cost;
use super::steps::{MAX_STEPS, too_many_steps};
use crate::budget::Budget;
use crate::topology::Topology;
use crate::{Error, Impact, Scenario, Sink};

/// Why a run ends early.
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
