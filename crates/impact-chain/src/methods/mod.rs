//! The engine, its rivals and the truth: ways to simulate one chain, under one trait.
//!
//! Each rival is the textbook form of a method that is in use, so that its cost and its failures can be measured on the
//! same scenes. Each has its source, its order and its failures in its documentation.
//!
//! - [`Certified`]: the engine of this project. [`Truth`], [`truth::TrueMotion`]: the motion to 106 bits.
//! - In closed form: [`Sampled`] gaps, conservative [`Advancement`].
//! - Integrated: a [`RungeKutta`] pair with events, [`MoreauJean`] time stepping, [`Verlet`] with a flip, [`Penalty`] springs.

mod advancement;
mod bodies;
mod certified;
mod crossing;
mod dormand_prince;
mod flights;
mod forcing;
mod moreau_jean;
mod penalty;
mod runge_kutta;
mod sampled;
mod state;
mod steps;
mod tally;
pub mod truth;
mod verlet;

pub use advancement::Advancement;
pub use certified::Certified;
pub use moreau_jean::MoreauJean;
pub use penalty::Penalty;
pub use runge_kutta::RungeKutta;
pub use sampled::Sampled;
pub use state::State;
pub use truth::Truth;
pub use verlet::Verlet;

use super::{Error, Impact, Scenario};
pub use crate::engine::Sink;
use crate::engine::collected;

mod prelude {
    pub use super::bodies::{Bodies, Stepper, run_steps};
    pub use super::crossing::{crossing, is_rounding};
    pub use super::flights::{Flights, Look};
    pub use super::steps::{Step, check_end, check_tolerance, steps};
    pub use super::tally::{Stop, Tally};
    pub use super::{Cost, Method, Sink, State, Task};
    pub use crate::impact::jumps;
    pub use crate::search::clock::{Instant, LATEST, Rate};
    pub use crate::search::trig::sin_cos_turn;
    pub use crate::topology::Topology;
    pub use crate::{Boundary, Error, Impact, Initial, Scenario};
}

/// Counted work of a method: deterministic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Impacts handed out.
    pub impacts: u64,
    /// Steps in time; for the certified engine, searches.
    pub steps: u64,
    /// Evaluations of one mass's acceleration or of one gap's width, with its sines.
    pub evaluations: u64,
    /// Runs of neighbouring gaps that closed at exactly the same instant, which no rival detects.
    pub simultaneous: u64,
}

impl Cost {
    /// Evaluations per impact; none without an impact.
    pub fn evaluations_per_impact(&self) -> Option<f64> {
        (self.impacts > 0).then(|| self.evaluations as f64 / self.impacts as f64)
    }
}

/// What a method runs: a chain, from a state, to a time. The start of the scenario is ignored.
pub type Task<'a> = (&'a Scenario, &'a State, f64);

/// A way to simulate a chain.
pub trait Method: Sync {
    /// Name, as in `trace --method`, e.g. "verlet".
    fn name(&self) -> &'static str;

    /// Runs and hands each impact to `sink`, which stops the run right after that impact by returning false.
    ///
    /// A gap of the start that is shut up to rounding counts as shut; it is hit only if it is closing.
    ///
    /// # Errors
    /// [`Error::Input`] for a scenario, start, step or tolerance outside the model,
    /// [`Error::Overlap`] for an overlapping start, [`Error::Work`] when a bound on work is exceeded.
    fn run(&self, task: Task, sink: Sink) -> Result<Cost, Error>;

    /// The first impact, if there is one.
    fn first(&self, task: Task) -> Result<Option<Impact>, Error> {
        Ok(collected(1, |sink| self.run(task, sink))?.pop())
    }

    /// All impacts, in order.
    fn impacts(&self, task: Task) -> Result<Vec<Impact>, Error> {
        collected(usize::MAX, |sink| self.run(task, sink))
    }
}
