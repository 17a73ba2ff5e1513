//! What all rivals share around their steps: the steps in time, the count of work and its bounds.

use super::{Cost, State};
use crate::topology::Topology;
use crate::{Error, Impact, Scenario};
use impact_numerics::clock::{Instant, LATEST};

/// Events that one gap may need within one unit of time 1/ω on average before a run is given up. A
/// rival that cannot rest in contact sees infinitely many impacts in a finite time there.
const EVENTS_PER_GAP: u64 = 10_000;

/// Steps that one run may take.
const MOST_STEPS: f64 = 1e10;

/// The shortest step.
const SHORTEST: f64 = 1e-9;

/// Why a run ends before its time.
pub enum Stop {
    /// The receiver of the impacts wants no more.
    Asked,
    /// An error.
    Failed(Error),
}

impl From<Error> for Stop {
    fn from(error: Error) -> Stop {
        Stop::Failed(error)
    }
}

/// The count of a run's work; impacts pass through it.
pub struct Tally<'a> {
    pub cost: Cost,
    sink: &'a mut dyn FnMut(Impact) -> bool,
    topology: Topology,
    unit: f64,
    bound: u64,
    /// End of the current unit of time, and the events left in it.
    end: f64,
    left: u64,
}

impl<'a> Tally<'a> {
    pub fn new(scenario: &Scenario, sink: &'a mut dyn FnMut(Impact) -> bool) -> Self {
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

    /// Hands out an impact of gap k.
    pub fn impact(&mut self, k: usize, time: f64, closing_speed: f64) -> Result<(), Stop> {
        self.spend(k, time)?;
        self.cost.impacts += 1;
        match (self.sink)(Impact { time, gap: self.topology.label(k), closing_speed }) {
            true => Ok(()),
            false => Err(Stop::Asked),
        }
    }

    /// Counts one more step of an integrator that chooses its steps.
    pub fn step(&mut self) -> Result<(), Stop> {
        self.cost.steps += 1;
        if self.cost.steps as f64 > MOST_STEPS {
            let problem = format!("more than {MOST_STEPS:e} steps are needed");
            let remedy = "give a larger tolerance or an earlier end";
            return Err(Error::input("tolerance", problem, remedy).into());
        }
        Ok(())
    }

    /// The cost of a run that has ended so.
    pub fn finish(self, ended: Result<(), Stop>) -> Result<Cost, Error> {
        match ended {
            Err(Stop::Failed(error)) => Err(error),
            Err(Stop::Asked) | Ok(()) => Ok(self.cost),
        }
    }
}

/// One of equal steps in time; the last one may be shorter.
#[derive(Clone, Copy)]
pub struct Step {
    /// Its beginning.
    pub from: Instant,
    /// Its end.
    pub to: Instant,
    /// Its length.
    pub h: f64,
}

/// The steps of length `h` from `start` to `until`, in order.
///
/// # Errors
/// [`Error::Input`] for a step that is none, that is longer than 1/max(ω, Ω), or too short.
pub fn steps(
    scenario: &Scenario,
    start: &State,
    until: f64,
    h: f64,
) -> Result<impl Iterator<Item = Step>, Error> {
    let longest = 1.0 / scenario.fastest();
    if !(SHORTEST..=longest).contains(&h) {
        let remedy = format!("give a number from {SHORTEST:?} to 1/max(w, W) = {longest:?}");
        return Err(Error::input("step", format!("{h:?} is out of range"), remedy));
    }
    check_end(until)?;
    let count = ((until - start.time).max(0.0) / h).ceil();
    if count > MOST_STEPS {
        let problem = format!("{count:.1e} steps of {h:?} are needed");
        let remedy = format!("give a step or an end for at most {MOST_STEPS:e} steps");
        return Err(Error::input("step", problem, remedy));
    }
    let (begin, end) = (Instant::at(start.time), Instant::at(until));
    let mut from = begin;
    Ok((1..=count as u64).map(move |i| {
        let step = match i < count as u64 {
            true => Step { from, to: begin.after(i as f64 * h), h },
            false => Step { from, to: end, h: end.since(from).max(0.0) },
        };
        from = step.to;
        step
    }))
}

/// The tolerances that make sense in doubles.
const TOLERANCES: std::ops::RangeInclusive<f64> = 1e-15..=0.1;

/// Refuses a tolerance that is none.
pub fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    if TOLERANCES.contains(&tolerance) {
        return Ok(());
    }
    let problem = format!("{tolerance:?} is out of range");
    Err(Error::input("tolerance", problem, "give a number from 1e-15 to 0.1"))
}

/// Refuses an end that is no time.
pub fn check_end(until: f64) -> Result<(), Error> {
    if until.abs() <= LATEST {
        return Ok(());
    }
    Err(Error::input("until", format!("{until:?} is out of range"), "give a time from 0 to 1e12"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scenario() -> Scenario {
        Scenario::from_json(r#"{"forcing":[[0.5,0.5]]}"#).unwrap()
    }

    #[test]
    fn steps_end_at_the_end() {
        let scenario = scenario();
        let start = State { time: 3.0, ..State::of(&scenario) };
        let of = |until: f64, h: f64| {
            steps(&scenario, &start, until, h).map(Iterator::collect::<Vec<Step>>)
        };
        let all = of(4.05, 0.1).unwrap();
        assert_eq!(all.len(), 11);
        assert!(all.windows(2).all(|pair| pair[0].to == pair[1].from));
        assert_eq!((all[0].from.time(), all[10].to.time()), (3.0, 4.05));
        assert!((all[10].h - 0.05).abs() < 1e-15 && all[9].h == 0.1);
        assert!(of(2.0, 0.1).unwrap().is_empty());
        for (until, h) in [(4.0, 0.0), (4.0, f64::NAN), (4.0, 0.8), (4.0, 1e-10), (1e12, 0.1)] {
            let error = of(until, h).err().unwrap().to_string();
            assert!(error.starts_with("step: "), "{error}");
        }
        assert!(of(f64::NAN, 0.1).is_err());
    }

    #[test]
    fn the_budget_is_that_of_one_unit_of_time() {
        let scenario = scenario();
        let mut sink = |_| true;
        let mut tally = Tally::new(&scenario, &mut sink);
        for i in 0..100_000 {
            assert!(tally.impact(0, f64::from(i) * 1e-4, 1.0).is_ok());
        }
        let ended = (0..100_000).try_for_each(|_| tally.impact(1, 20.0, 1.0));
        let error = tally.finish(ended).unwrap_err();
        assert_eq!(error, Error::Work { gap: 1, time: 20.0, bound: 20_000 });
    }
}
