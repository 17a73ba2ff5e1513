//! The event-driven engine as others use it; its algorithm is in `simulation`.

use super::flight::Motion;
use super::force::Force;
use super::scenario::COMPONENTS;
use super::simulation::{Gap, Simulation};
use super::{Error, Scenario};
use crate::search::earliest::Earliest;
use crate::search::first_root::Counters;

/// One impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Time t, in the units of the scenario.
    pub time: f64,
    /// The gap that closed: 0 is left wall–mass 1, j is mass j–mass j + 1.
    pub gap: usize,
    /// Closing speed −Δ' just before the impact, ≥ 0.
    pub closing_speed: f64,
}

/// Receives the impacts of a run in order; returns false to stop it.
pub type Sink<'a> = &'a mut dyn FnMut(Impact) -> bool;

/// The first `most` impacts of a run, or all if there are fewer.
pub fn collected<T>(
    most: usize,
    run: impl FnOnce(Sink) -> Result<T, Error>,
) -> Result<Vec<Impact>, Error> {
    let mut impacts = Vec::new();
    run(&mut |impact| {
        impacts.push(impact);
        impacts.len() < most
    })?;
    Ok(impacts)
}

/// The simulation of one scenario.
#[derive(Clone, Debug)]
pub struct Engine(Kind);

/// The paper's model has one component of the forcing: its code is compiled separately, for speed.
#[derive(Clone, Debug)]
enum Kind {
    One(Box<Simulation<1>>),
    Several(Box<Simulation<COMPONENTS>>),
}

/// Makes the same call on either kind of simulation.
macro_rules! inside {
    ($engine:expr, $simulation:ident => $call:expr) => {
        match $engine {
            Kind::One($simulation) => $call,
            Kind::Several($simulation) => $call,
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
            Kind::One(Box::new(Simulation::new(scenario)?))
        } else {
            Kind::Several(Box::new(Simulation::new(scenario)?))
        }))
    }

    /// Bytes of a simulation with so many masses and components of the forcing, its scenario included.
    pub fn memory(masses: usize, components: usize) -> u128 {
        let each = if components == 1 { bytes::<1>() } else { bytes::<COMPONENTS>() };
        masses as u128 * (each + size_of::<[f64; 2]>() * (1 + components)) as u128
    }

    /// Runs until time `until`, and hands each impact to `sink` in order; stops early, right
    /// after that impact, when `sink` returns false. May be called again with a later time.
    ///
    /// # Errors
    /// [`Error::Work`] when the bound on work is exceeded.
    pub fn run(&mut self, until: f64, mut sink: impl FnMut(Impact) -> bool) -> Result<(), Error> {
        self.run_to(until, &mut sink)
    }

    /// The next impact up to time `until`, if there is one; the run stops right after it.
    pub fn next_impact(&mut self, until: f64) -> Result<Option<Impact>, Error> {
        Ok(collected(1, |sink| self.run_to(until, sink))?.pop())
    }

    /// All impacts up to time `until`, in order.
    pub fn impacts(&mut self, until: f64) -> Result<Vec<Impact>, Error> {
        collected(usize::MAX, |sink| self.run_to(until, sink))
    }

    /// Not generic over the receiver: generic code would be compiled with the caller's crate, which may be unoptimised.
    fn run_to(&mut self, until: f64, sink: Sink) -> Result<(), Error> {
        inside!(&mut self.0, simulation => simulation.run(until, sink))
    }

    /// Positions x_1..x_n at `time`, exact between the last event and the next.
    pub fn positions(&self, time: f64) -> Vec<f64> {
        inside!(&self.0, simulation => simulation.positions(time))
    }

    /// Velocities of the masses 1..n at `time`, exact between the last event and the next.
    pub fn velocities(&self, time: f64) -> Vec<f64> {
        inside!(&self.0, simulation => simulation.velocities(time))
    }

    /// Free parts (a_j, b_j) of the masses 1..n; those in contact share that of their cluster.
    pub fn free_parts(&self) -> Vec<[f64; 2]> {
        inside!(&self.0, simulation => simulation.free_parts())
    }

    /// The gaps in contact and their contact forces at `time` (≥ 0 while it lasts), exact between
    /// the last event and the next.
    pub fn contacts(&self, time: f64) -> Vec<(usize, f64)> {
        inside!(&self.0, simulation => simulation.contacts(time))
    }

    /// Time of the last event.
    pub fn time(&self) -> f64 {
        inside!(&self.0, simulation => simulation.now.time())
    }

    /// Counted work so far.
    pub fn counters(&self) -> Counters {
        inside!(&self.0, simulation => simulation.work)
    }
}

/// Bytes of one mass with its gap. The queue has a key and two nodes for each gap of the next power of two.
fn bytes<const M: usize>() -> usize {
    size_of::<Motion<M>>()
        + size_of::<[f64; 2]>()
        + size_of::<[[f64; 2]; M]>()
        + size_of::<Gap<M>>()
        + size_of::<Force<M>>()
        + 2 * Earliest::BYTES
}
