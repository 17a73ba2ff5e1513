//! A gap sampled on a grid of times, and bisection.

use super::crossing::crossing;
use super::flights::{Locate, Look, run_samples};
use super::{Cost, Method, State};
use crate::{Error, Impact, Scenario};

/// Flight in closed form; every gap is looked at with a fixed step, and a change of its sign is
/// bisected down to neighbouring doubles.
///
/// - Source: the bracketing and bisection of every textbook (Press et al., Numerical Recipes, sec.
///   9.1); simulations of impacting oscillators are mostly written so.
/// - Order: none; an impact that is seen has the accuracy of rounding. What the step decides is
///   whether it is seen.
/// - Fails: two roots within a step leave no change of sign, so grazes and short dips are missed, of
///   depth up to |Δ''| h²/8; three are taken for one, often the wrong one. A chatter has infinitely
///   many impacts in a finite time: the bound on work ends the run there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// Time h between two looks.
    pub step: f64,
}

impl Method for Sampled {
    fn name(&self) -> &'static str {
        "sampled"
    }

    fn run(
        &self,
        scenario: &Scenario,
        start: &State,
        until: f64,
        sink: &mut dyn FnMut(Impact) -> bool,
    ) -> Result<Cost, Error> {
        run_samples(self, (scenario, start), until, self.step, sink)
    }
}

impl Locate for Sampled {
    fn locate(&self, from: Look, to: Look, mut at: impl FnMut(f64) -> Look) -> Option<f64> {
        let changes = to.width < 0.0;
        changes.then(|| crossing(from.s, to.s, from.width, |s| at(s).width))
    }
}
