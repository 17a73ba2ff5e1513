//! Counts the work of a rival, and bounds it.

use super::method::Cost;
use super::steps::{MAX_STEPS, too_many};
use crate::events::EVENTS_PER_GAP;
use crate::topology::Topology;
use crate::{Error, Impact, Scenario, Sink};

/// Why a run ends early: an error, or none if the receiver of the impacts stopped it.
pub type Stop = Option<Error>;

/// The counted work of a run; impacts pass through it.
pub struct Tally<'a> {
    pub cost: Cost,
    sink: Sink<'a>,
    topology: Topology,
    unit: f64,
    bound: u64,
    /// End of the current unit of time, and the events left in it.
    end: f64,
    left: u64,
}

impl<'a> Tally<'a> {
    pub fn new(scenario: &Scenario, sink: Sink<'a>) -> Self {
        let topology = Topology::new(scenario.forcing.len(), scenario.boundary);
        let bound = EVENTS_PER_GAP * topology.gaps() as u64;
        Tally {
            cost: Cost::default(),
            sink,
            topology,
            unit: 1.0 / scenario.natural_frequency,
            bound,
            end: f64::NEG_INFINITY,
            left: bound,
        }
    }

    /// Lowers the bound of a method without a least rebound speed, whose chatters have no end.
    pub fn stopping_at(&mut self, speed: f64) {
        if speed == 0.0 {
            self.bound /= 10;
        }
    }

    /// Takes an event of gap k from the budget of the current unit of time.
    pub fn spend(&mut self, k: usize, time: f64) -> Result<(), Stop> {
        if time >= self.end {
            self.end = time + self.unit;
            self.left = self.bound;
        }
        if self.left == 0 {
            let gap = self.topology.label(k);
            return Err(Error::Work { gap, time, bound: self.bound }.into());
        }
        self.left -= 1;
        Ok(())
    }

    pub fn impact(&mut self, k: usize, time: f64, closing_speed: f64) -> Result<(), Stop> {
        self.spend(k, time)?;
        self.cost.impacts += 1;
        if (self.sink)(Impact { time, gap: self.topology.label(k), closing_speed }) {
            Ok(())
        } else {
            Err(None)
        }
    }

    /// Counts an impact if it has a speed. A gap at rest at zero has none, but is an event.
    pub fn event(&mut self, k: usize, time: f64, speed: f64) -> Result<(), Stop> {
        if speed > 0.0 { self.impact(k, time, speed) } else { self.spend(k, time) }
    }

    /// Counts one more step of an integrator that chooses its steps.
    pub fn step(&mut self) -> Result<(), Stop> {
        self.cost.steps += 1;
        if self.cost.steps as f64 > MAX_STEPS {
            return Err(too_many(self.cost.steps as f64, "tolerance").into());
        }
        Ok(())
    }
}
