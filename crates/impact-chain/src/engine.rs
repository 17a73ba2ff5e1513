//! Offers the simulation of one scenario: its events in order, and the masses at any time.

use super::scenario::COMPONENTS;
use super::simulation::Simulation;
#[cfg(feature = "ensembles")]
use super::topology::Topology;
use super::{End, Error, Event, Impact, Scenario, State};
use crate::search::outcome::{Counters, Graze};
use std::ops::ControlFlow::{self, Break, Continue};

/// The simulation of one scenario, from event to event.
///
/// A run ends at a time `until`, or earlier; the next call goes on from there. An event whose time
/// is `until` is within the run.
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
        Engine::with_epoch(scenario, 0.0)
    }

    /// Goes on from a state of this scenario, or from one of yours, at its time: the forcing has
    /// the phases of that time, and a run from a state is the whole run up to rounding.
    ///
    /// # Errors
    /// Those of [`new`](Engine::new), and the same two for the state.
    pub fn from_state(scenario: &Scenario, state: &State) -> Result<Engine, Error> {
        scenario.validate()?;
        // Its own start is known to more digits than its positions have.
        if *state == State::from_scenario(scenario) {
            return Engine::new(scenario);
        }
        Engine::with_epoch(&state.as_scenario(scenario)?, state.time)
    }

    fn with_epoch(scenario: &Scenario, epoch: f64) -> Result<Engine, Error> {
        Ok(Engine(if scenario.overtones.is_empty() {
            Components::One(Box::new(Simulation::new(scenario, epoch)?))
        } else {
            Components::Several(Box::new(Simulation::new(scenario, epoch)?))
        }))
    }

    /// Returns the further impacts up to time `until`, in order.
    ///
    /// # Errors
    /// Those of [`run`](Engine::run).
    pub fn impacts(&mut self, until: f64) -> Result<Vec<Impact>, Error> {
        let mut impacts = Vec::new();
        self.observe(until, &mut |event, _| {
            if let Event::Impact(impact) = event {
                impacts.push(*impact);
            }
            Continue(())
        })?;
        Ok(impacts)
    }

    /// Returns the next impact up to time `until`, or `None` if there is no impact; the run stops
    /// right after it.
    ///
    /// # Errors
    /// Those of [`run`](Engine::run).
    pub fn next_impact(&mut self, until: f64) -> Result<Option<Impact>, Error> {
        let mut next = None;
        self.observe(until, &mut |event, _| match event {
            Event::Impact(impact) => {
                next = Some(*impact);
                Break(())
            }
            _ => Continue(()),
        })?;
        Ok(next)
    }

    /// Runs until time `until`; [`state`](Engine::state) then tells where the masses are.
    ///
    /// # Errors
    /// Those of [`run`](Engine::run).
    pub fn advance(&mut self, until: f64) -> Result<(), Error> {
        self.observe(until, &mut |_, _| Continue(())).map(drop)
    }

    /// Runs until time `until`, and shows each event to `observer` in order, with the engine right
    /// after it, or stops there if `observer` says so. Events of one instant have the same state.
    ///
    /// # Errors
    /// [`Error::Input`] for an end before the last event or after [`LATEST`](crate::LATEST), and
    /// [`Error::Work`] for more events than the bound within one unit of time, right before the
    /// event that exceeds it.
    pub fn run(
        &mut self,
        until: f64,
        mut observer: impl FnMut(&Event, &Engine) -> ControlFlow<()>,
    ) -> Result<End, Error> {
        self.observe(until, &mut observer)
    }

    /// Generic code would be compiled with the caller's crate, which may be unoptimised.
    fn observe(
        &mut self,
        until: f64,
        observer: &mut dyn FnMut(&Event, &Engine) -> ControlFlow<()>,
    ) -> Result<End, Error> {
        let end = call!(&self.0, simulation => simulation.end(until))?;
        while let Some(event) = call!(&mut self.0, simulation => simulation.next(end))? {
            if observer(&event, self).is_break() {
                return Ok(End::Stopped);
            }
        }
        Ok(End::Reached)
    }

    /// Returns the time of the next event up to `until`, or `None` if there is no event, without
    /// going there. A gap that then closes without speed may leave no event.
    ///
    /// # Errors
    /// Those of [`run`](Engine::run).
    pub fn next_event_time(&mut self, until: f64) -> Result<Option<f64>, Error> {
        call!(&mut self.0, simulation => simulation.next_time(simulation.end(until)?))
    }

    #[cfg(feature = "ensembles")]
    pub(crate) fn topology(&self) -> Topology {
        call!(&self.0, simulation => simulation.topology)
    }

    /// Returns positions and velocities at a time from the last event to the next, as that to which
    /// [`run`](Engine::run) ran. At the time of an event it is the state after it.
    /// [`Engine::from_state`] goes on from there.
    ///
    /// # Errors
    /// [`Error::Input`] for any other time.
    pub fn state(&self, time: f64) -> Result<State, Error> {
        call!(&self.0, simulation => simulation.state(time))
    }

    /// Returns the free parts (a_j, b_j) of the masses 1..n, from the time of the start on; a
    /// cluster shares one.
    #[must_use]
    pub fn free_parts(&self) -> Vec<[f64; 2]> {
        call!(&self.0, simulation => simulation.free_parts())
    }

    /// Returns the gaps in contact and their contact forces (≥ 0) at a time up to the next event.
    ///
    /// # Errors
    /// Those of [`state`](Engine::state).
    pub fn contacts(&self, time: f64) -> Result<Vec<(usize, f64)>, Error> {
        call!(&self.0, simulation => simulation.contacts(time))
    }

    /// Returns the time of the last event; before the first, that of the start.
    #[must_use]
    pub fn time(&self) -> f64 {
        call!(&self.0, simulation => simulation.event_time)
    }

    /// Returns the counted work since the start.
    pub fn counters(&self) -> Counters {
        call!(&self.0, simulation => simulation.work)
    }

    /// Returns the first dip of which rounding could not tell whether it is an impact, or `None`.
    #[must_use]
    pub fn first_graze(&self) -> Option<Graze> {
        call!(&self.0, simulation => simulation.first_graze)
    }
}
