//! The exact event-driven engine.

use super::{Error, Scenario};

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

/// Counted work of a run: deterministic, and a result like any other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Impacts.
    pub impacts: u64,
    /// Evaluations of a gap by the root search.
    pub evaluations: u64,
    /// Searches started.
    pub searches: u64,
    /// Contact phases begun.
    pub contact_phases: u64,
    /// Roots inside the undecidable band (declared in the search).
    pub undecided: u64,
}

/// The simulation of one scenario.
#[derive(Clone, Debug)]
pub struct Engine {
    counters: Counters,
}

impl Engine {
    /// Sets a scenario at t = 0.
    ///
    /// # Errors
    /// [`Error::Input`] for values outside the model, [`Error::Overlap`] for an overlapping start.
    pub fn new(_scenario: &Scenario) -> Result<Engine, Error> {
        todo!()
    }

    /// Runs until time `until`, and hands each impact to `sink` in order; stops early, right
    /// after that impact, when `sink` returns false. May be called again with a later time.
    ///
    /// # Errors
    /// [`Error::Work`] when the bound on work is exceeded.
    pub fn run(&mut self, _until: f64, _sink: impl FnMut(Impact) -> bool) -> Result<(), Error> {
        todo!()
    }

    /// Positions x_1..x_n at a time between the last event and the next.
    pub fn positions(&self, _time: f64) -> Vec<f64> {
        todo!()
    }

    /// Counted work so far.
    pub fn counters(&self) -> Counters {
        self.counters
    }
}
