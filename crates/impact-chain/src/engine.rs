//! Offers the simulation of one scenario: impacts in order, and the masses at any time.

use super::impact::{Impact, Sink, collect};
use super::scenario::COMPONENTS;
use super::simulation::Simulation;
use super::{Error, Scenario, State};
use crate::search::outcome::{Counters, Graze};

/// The simulation of one scenario.
///
/// # Errors
/// [`Error::Work`] ends a run that exceeds the bound on work; [`Error::Input`] refuses a time that
/// is not between the last event and the next.
#[derive(Clone, Debug)]
pub struct Engine(Components);

/// The paper's model has one component of the forcing: its code is compiled separately, for speed.
#[derive(Clone, Debug)]
enum Components {
    One(Box<Simulation<1>>),
    Several(Box<Simulation<COMPONENTS>>),
}

/// Makes the same call for either number of components.
macro_rules! call {
    ($engine:expr, $simulation:ident => $call:expr) => {
        match $engine {
            Components::One($simulation) => $call,
            Components::Several($simulation) => $call,
        }
    };
}

impl Engine {
    /// Sets a scenario at t = 0.
    ///
    /// # Errors
    /// [`Error::Input`] for values outside the model, [`Error::Overlap`] for an overlapping start.
    pub fn new(scenario: &Scenario) -> Result<Engine, Error> {
        Ok(Engine(if scenario.overtones.is_empty() {
            Components::One(Box::new(Simulation::new(scenario)?))
        } else {
            Components::Several(Box::new(Simulation::new(scenario)?))
        }))
    }

    /// Runs until time `until`, and hands each impact to `sink` in order; stops early, right
    /// after that impact, when `sink` returns false. May be called again with a later time.
    pub fn run(&mut self, until: f64, mut sink: impl FnMut(Impact) -> bool) -> Result<(), Error> {
        self.run_to(until, &mut sink)
    }

    /// Returns the next impact up to time `until`, if any; the run stops right after it.
    pub fn next_impact(&mut self, until: f64) -> Result<Option<Impact>, Error> {
        Ok(collect(1, |sink| self.run_to(until, sink))?.pop())
    }

    /// Returns all impacts up to time `until`, in order.
    pub fn impacts(&mut self, until: f64) -> Result<Vec<Impact>, Error> {
        collect(usize::MAX, |sink| self.run_to(until, sink))
    }

    /// Generic code would be compiled with the caller's crate, which may be unoptimised.
    fn run_to(&mut self, until: f64, sink: Sink) -> Result<(), Error> {
        call!(&mut self.0, simulation => simulation.run(until, sink))
    }

    /// Returns positions and velocities at a time from the last event to the next, as that to which
    /// [`run`](Engine::run) ran. [`State::as_scenario`] goes on from there.
    pub fn state(&self, time: f64) -> Result<State, Error> {
        call!(&self.0, simulation => simulation.state(time))
    }

    /// Returns the positions x_1..x_n at such a time.
    pub fn positions(&self, time: f64) -> Result<Vec<f64>, Error> {
        Ok(self.state(time)?.positions)
    }

    /// Returns the velocities of the masses 1..n at such a time.
    pub fn velocities(&self, time: f64) -> Result<Vec<f64>, Error> {
        Ok(self.state(time)?.velocities)
    }

    /// Returns the free parts (a_j, b_j) of the masses 1..n; a cluster shares one.
    pub fn free_parts(&self) -> Vec<[f64; 2]> {
        call!(&self.0, simulation => simulation.free_parts())
    }

    /// Returns the gaps in contact and their contact forces (≥ 0) at a time up to the next event.
    pub fn contacts(&self, time: f64) -> Result<Vec<(usize, f64)>, Error> {
        call!(&self.0, simulation => simulation.contacts(time))
    }

    /// Returns the time of the last event.
    pub fn time(&self) -> f64 {
        call!(&self.0, simulation => simulation.now.time())
    }

    pub fn counters(&self) -> Counters {
        call!(&self.0, simulation => simulation.work)
    }

    /// Returns the first dip of which rounding could not tell whether it is an impact, if any.
    pub fn first_graze(&self) -> Option<Graze> {
        call!(&self.0, simulation => simulation.first_graze)
    }
}
