//! Newton's iteration from a sampled guess.

use super::flights::{Locate, Look, run_samples};
use super::{Cost, Method, State};
use crate::{Error, Impact, Scenario};

/// Flight in closed form; every gap is looked at with a fixed step, and where its sign changes, or a
/// parabola through the two looks comes near zero between them, Newton's iteration on Δ starts.
///
/// Behind a change of sign it starts from the secant's zero, before a near touch from the earlier
/// look. A root counts if the iteration ends within the step and the gap is closing there.
///
/// - Source: Press et al., Numerical Recipes, sec. 9.4; without the safeguards of sec. 9.4's
///   bracketed form, as it is often written.
/// - Order: none in the step, 2 in the iteration; a root that is found has the accuracy of rounding.
/// - Fails: as Newton fails. Near a graze Δ' is nearly zero and the iteration is thrown out of the
///   step, or ends at the root where the gap opens; right after an impact it is drawn back to it. A
///   root that is lost so leaves the gap overlapped, and its masses pass through each other until
///   they come back. Dips that the parabola does not guess are missed as by sampling alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newton {
    /// Time h between two looks.
    pub step: f64,
}

/// A dip of the parabola below this part of the largest width of the two looks starts the iteration.
const NEAR: f64 = 0.05;

/// Iterations, at most.
const ITERATIONS: u32 = 40;

/// The iteration has ended when it moves by less than this part of the step: quadratic convergence
/// makes that move exact to rounding.
const SMALL: f64 = 1e-9;

/// Below zero by more than this part of the other look's width, a gap has been lost before.
const LOST: f64 = 1e-9;

impl Method for Newton {
    fn name(&self) -> &'static str {
        "newton"
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

impl Locate for Newton {
    fn locate(&self, from: Look, to: Look, mut at: impl FnMut(f64) -> Look) -> Option<f64> {
        let size = from.width.abs().max(to.width.abs());
        if from.width < -LOST * size {
            return None;
        }
        let mut s = guess(&from, &to, size)?;
        let h = to.s - from.s;
        for _ in 0..ITERATIONS {
            let look = at(s);
            let move_by = -look.width / look.rate;
            s += move_by;
            if move_by.abs() <= SMALL * h {
                // A tie with another impact may lie before it by rounding.
                let within = from.s - SMALL * h <= s && s <= to.s;
                return (within && look.rate < 0.0).then_some(s.max(from.s));
            }
            // Far outside it is lost; a little outside it may come back.
            if !(from.s - h..=to.s + h).contains(&s) {
                return None;
            }
        }
        None
    }
}

/// Where the iteration starts, if anything calls for it.
fn guess(from: &Look, to: &Look, size: f64) -> Option<f64> {
    let h = to.s - from.s;
    if to.width < 0.0 {
        // The secant's zero; the later look right after an impact, where the width is zero.
        let part = if from.width > 0.0 { from.width / (from.width - to.width) } else { 1.0 };
        return Some(from.s + part * h);
    }
    if from.rate < 0.0 && to.rate > 0.0 {
        let dip = from.rate / (from.rate - to.rate) * h;
        let lowest = from.width + 0.5 * from.rate * dip;
        return (lowest <= NEAR * size).then_some(from.s);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gap just hit, which closes at 0.2 and would open at 1.3: s (0.2 − s)(1.3 − s).
    fn cubic(s: f64) -> Look {
        let width = s * (0.2 - s) * (1.3 - s);
        Look { s, width, rate: 0.26 - 3.0 * s + 3.0 * s * s }
    }

    #[test]
    fn the_root_of_the_last_impact_is_no_impact() {
        let newton = Newton { step: 1.0 };
        let found = newton.locate(cubic(0.0), cubic(0.7), cubic).unwrap();
        assert!((found - 0.2).abs() < 1e-15, "{found}");
        // From here the iteration is drawn back to s = 0, where the gap opens.
        assert_eq!(newton.locate(cubic(0.0), cubic(0.8), cubic), None);
        // And from here it is thrown out of the step.
        assert_eq!(newton.locate(cubic(0.0), cubic(0.9), cubic), None);
    }
}
