//! Cuts time into equal steps, tabulates phases at their ends, and checks the ranges of steps,
//! tolerances and end times.

use super::method::Task;
use crate::error::{Error, check_range};
use crate::search::clock::{Instant, LATEST, Rate};
use std::cell::RefCell;
use std::rc::Rc;

pub const MAX_STEPS: f64 = 1e10;

const SHORTEST: f64 = 1e-9;

/// Steps whose phases are kept; those of a longer run are computed in pieces of as many.
const KEPT: usize = 1 << 14;

/// One of equal steps in time; the last may be shorter.
pub struct Step<'a> {
    pub from: Instant,
    pub to: Instant,
    pub h: f64,
    /// (sin, cos) of each rate at its end.
    pub phases: &'a [(f64, f64)],
}

/// Equal steps from the start of a task to its end, and the rates whose phases are wanted.
pub struct Steps {
    rates: Vec<Rate>,
    begin: Instant,
    end: Instant,
    h: f64,
    count: u64,
}

/// The phases at the ends of whole steps from a number on.
struct Piece {
    /// The rates, the start, the bits of the length of a step, and the number of the first.
    key: (Vec<Rate>, Instant, u64, u64),
    phases: Vec<(f64, f64)>,
}

impl Steps {
    pub fn new(task: Task, h: f64, rates: Vec<Rate>) -> Result<Steps, Error> {
        let Task { scenario, start, until } = task;
        check_range("step", h, SHORTEST, 1.0 / scenario.fastest())?;
        let count = ((until - start.time).max(0.0) / h).ceil();
        if count > MAX_STEPS {
            return Err(too_many_steps(count, "step"));
        }
        let (begin, end) = (Instant::at(start.time), Instant::at(until));
        Ok(Steps { rates, begin, end, h, count: count as u64 })
    }

    #[inline(always)]
    pub fn each<E>(&self, mut visit: impl FnMut(&Step) -> Result<(), E>) -> Result<(), E> {
        let Steps { ref rates, begin, end, h, count } = *self;
        let (whole, mut from) = (count.saturating_sub(1), begin);
        for first in (0..whole).step_by(KEPT) {
            let number = (whole - first).min(KEPT as u64) as usize;
            let piece = self.tabulated(first, number);
            let phases = piece.phases.chunks_exact(rates.len()).take(number);
            for (number, phases) in (first..).zip(phases) {
                let to = begin.after((number + 1) as f64 * h);
                visit(&Step { from, to, h, phases })?;
                from = to;
            }
        }
        if count > 0 {
            let phases: Vec<_> = rates.iter().map(|rate| rate.sin_cos(end)).collect();
            visit(&Step { from, to: end, h: end.since(from).max(0.0), phases: &phases })?;
        }
        Ok(())
    }

    /// Tabulates the phases of some steps. The last table of a thread serves all chains with the
    /// same frequencies, start and step.
    fn tabulated(&self, first: u64, number: usize) -> Rc<Piece> {
        thread_local!(static LAST: RefCell<Option<Rc<Piece>>> = const { RefCell::new(None) });
        let key = (self.rates.clone(), self.begin, self.h.to_bits(), first);
        LAST.with_borrow_mut(|last| {
            let length = number * self.rates.len();
            let same = |piece: &Rc<Piece>| piece.key == key && piece.phases.len() >= length;
            let piece = last.take().filter(same).unwrap_or_else(|| {
                let end = |i: u64| self.begin.after((first + i + 1) as f64 * self.h);
                let phases = |i| self.rates.iter().map(move |rate| rate.sin_cos(end(i)));
                let phases = (0..number as u64).flat_map(phases).collect();
                Rc::new(Piece { key: key.clone(), phases })
            });
            last.insert(piece).clone()
        })
    }
}

pub fn too_many_steps(steps: f64, field: &str) -> Error {
    let remedy = format!("give a larger {field} or an earlier end, for at most {MAX_STEPS:e}");
    Error::input(field, format!("{steps:.1e} steps are needed"), remedy)
}

pub fn check_end(task: Task) -> Result<(), Error> {
    check_range("until", task.until, task.start.time, LATEST)
}

pub fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    check_range("tolerance", tolerance, 1e-15, 0.1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Chain, Scenario, State};

    /// Also where a shorter run with the same steps came before.
    #[test]
    fn runs_of_the_same_step_have_all_of_their_steps() {
        let scenario = Scenario::given(&Chain { masses: 1, ..Chain::default() }, vec![[0.0; 2]]);
        let (scenario, rates) = (scenario.unwrap(), [1.0, 1.4].map(Rate::new).to_vec());
        for number in [8, 15, 24] {
            let (start, until) = (State::from_scenario(&scenario), f64::from(number) * 0.125);
            let task = Task { scenario: &scenario, start: &start, until };
            let mut ends = Vec::new();
            let steps = Steps::new(task, 0.125, rates.clone()).unwrap();
            let each = steps.each(|step| -> Result<(), ()> {
                ends.push((step.to.time(), step.phases[0].0));
                Ok(())
            });
            let expected = (1..=number).map(|i| 0.125 * f64::from(i)).map(|t| (t, t.sin()));
            let close =
                |((t, x), (u, y)): ((f64, f64), (f64, f64))| t == u && (x - y).abs() < 1e-15;
            assert!(each.is_ok() && ends.len() == number as usize, "{ends:?}");
            assert!(ends.into_iter().zip(expected).all(close), "{number}");
        }
    }
}
