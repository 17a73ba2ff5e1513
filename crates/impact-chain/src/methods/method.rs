//! Defines the trait of all ways to simulate a chain.

use crate::{Error, Graze, Impact, Scenario, Sink, State};

/// What no other crate can implement.
pub trait Sealed {}

/// Counted work of a method: deterministic.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Cost {
    /// Impacts found.
    pub impacts: u64,
    /// Steps in time; for the certified engine, searches.
    pub steps: u64,
    /// Evaluations of the acceleration of one mass or of the width of one gap, with its sines.
    pub evaluations: u64,
    /// Impacts at exactly the same instant as one of a neighbouring gap, which no rival detects.
    pub simultaneous: u64,
    /// Dips of gaps that rounding could not decide, which no rival detects.
    pub undecided: u64,
    /// The first of these dips, or `None` if there is no such dip.
    pub first_graze: Option<Graze>,
}

impl Cost {
    /// Returns the evaluations of an impact, or `None` without impacts.
    #[must_use]
    pub fn evaluations_per_impact(&self) -> Option<f64> {
        (self.impacts > 0).then(|| self.evaluations as f64 / self.impacts as f64)
    }
}

/// A run: of which chain, from where, and until when.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The chain.
    pub scenario: &'a Scenario,
    /// The state from which the run starts, at its time, whatever the start of the scenario is.
    pub start: &'a State,
    /// The time of the end, from that of the start to [`LATEST`](crate::LATEST).
    pub until: f64,
}

/// A way to simulate a chain. Only this crate has some: another may not rely on their parts.
pub trait Method: Sealed + Sync {
    /// Returns the name, as in `trace --method`, e.g. "verlet".
    fn name(&self) -> &'static str;

    /// Runs a task and hands each impact to `sink`, which stops the run right after that impact by
    /// returning false.
    ///
    /// A gap of the start that is shut up to rounding counts as shut; it is hit if it is closing.
    ///
    /// # Errors
    /// [`Error::Input`] for a scenario, start, end, step or tolerance outside the model,
    /// [`Error::Overlap`] for an overlapping start, [`Error::Work`] when a bound on work is
    /// exceeded.
    fn run(&self, task: Task, sink: Sink) -> Result<Cost, Error>;

    /// Returns the first impact, or `None` if there is no impact.
    ///
    /// # Errors
    /// Those of [`run`](Method::run).
    fn first(&self, task: Task) -> Result<Option<Impact>, Error> {
        let mut first = None;
        self.run(task, &mut |impact| {
            first = Some(impact);
            false
        })?;
        Ok(first)
    }

    /// Returns all impacts, in order.
    ///
    /// # Errors
    /// Those of [`run`](Method::run).
    fn impacts(&self, task: Task) -> Result<Vec<Impact>, Error> {
        let mut impacts = Vec::new();
        self.run(task, &mut |impact| {
            impacts.push(impact);
            true
        })?;
        Ok(impacts)
    }
}
