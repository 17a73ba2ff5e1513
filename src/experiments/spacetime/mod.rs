//! One long run at the printed threshold, impact by impact: where impacts start, how they spread
//! along the chain, and where they stop.
//!
//! Which run is shown is not a matter of taste: it is the first realisation of its stream that
//! still has impacts in the last part of the run.

pub mod tables;

use super::{Error, Progress};
use crate::params::SpaceTimeParams;
use impact_chain::{Engine, Scenario};
use impact_numerics::random::NormalPairs;
use serde::{Deserialize, Serialize};

/// The run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceTime {
    /// What was run.
    pub parameters: SpaceTimeParams,
    /// Which realisation it is, from 0; those before it had no impact in the last part.
    pub realisation: u64,
    /// Time of each impact, rising.
    pub times: Vec<f64>,
    /// Gap of each impact, from 0.
    pub gaps: Vec<u32>,
}

/// A step of a front: from a gap that was hit to its neighbour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advance {
    /// The gap that is hit for the first time.
    pub gap: usize,
    /// When.
    pub time: f64,
    /// How long after the first impact of the neighbour that was hit first.
    pub delay: f64,
}

/// Runs realisations until one keeps hitting.
pub fn run(parameters: &SpaceTimeParams, progress: &Progress) -> Result<SpaceTime, Error> {
    let stage = progress.stage("spacetime", 1);
    let failed = |source| Error::failed("spacetime", source);
    for realisation in 0..REALISATIONS {
        progress.check()?;
        let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, realisation);
        let scenario = Scenario::draw(&parameters.chain, parameters.sigma, &mut normals);
        let mut engine = Engine::new(&scenario).map_err(failed)?;
        let impacts = engine.impacts(parameters.until).map_err(failed)?;
        let (times, gaps): (Vec<f64>, Vec<u32>) =
            impacts.into_iter().map(|impact| (impact.time, impact.gap as u32)).unzip();
        if times.last().is_some_and(|t| *t > parameters.until - parameters.last) {
            stage.advance(1);
            let parameters = parameters.clone();
            return Ok(SpaceTime { parameters, realisation, times, gaps });
        }
    }
    Err(Error::input(
        "sigma",
        format!("none of {REALISATIONS} runs with {:?} has late impacts", parameters.sigma),
        "give a larger one",
    ))
}

/// Realisations after which the search for one that keeps hitting is given up.
const REALISATIONS: u64 = 1000;

impl SpaceTime {
    /// Number of gaps.
    pub fn width(&self) -> usize {
        self.parameters.chain.gaps()
    }

    /// Time of the first impact of each gap.
    pub fn firsts(&self) -> Vec<Option<f64>> {
        let mut firsts = vec![None; self.width()];
        for (&time, &gap) in self.times.iter().zip(&self.gaps) {
            firsts[gap as usize].get_or_insert(time);
        }
        firsts
    }

    /// Gaps that are hit at all.
    pub fn reached(&self) -> usize {
        self.firsts().iter().flatten().count()
    }

    /// The gaps at which impacts start: hit when neither neighbour had been. Such a gap closes by
    /// itself, since its masses move as they did from the beginning.
    pub fn starts(&self) -> Vec<usize> {
        let firsts = self.firsts();
        let before = |gap: Option<usize>, time: f64| {
            gap.and_then(|gap| *firsts.get(gap)?).is_some_and(|other| other < time)
        };
        let alone = |gap: usize| {
            firsts[gap].is_some_and(|t| !before(gap.checked_sub(1), t) && !before(Some(gap + 1), t))
        };
        (0..firsts.len()).filter(|&gap| alone(gap)).collect()
    }

    /// Gaps reached by a time.
    pub fn reached_by(&self, time: f64) -> usize {
        self.firsts().iter().flatten().filter(|first| **first <= time).count()
    }

    /// The steps of all fronts, the quickest first: each gap that is reached, without the starts.
    pub fn advances(&self) -> Vec<Advance> {
        let firsts = self.firsts();
        let at = |gap: Option<usize>| gap.and_then(|gap| *firsts.get(gap)?);
        let advance = |gap: usize| {
            let time = firsts[gap]?;
            let beside = [at(gap.checked_sub(1)), at(Some(gap + 1))];
            let before = beside.into_iter().flatten().reduce(f64::min)?;
            (before < time).then_some(Advance { gap, time, delay: time - before })
        };
        let mut advances: Vec<Advance> = (0..firsts.len()).filter_map(advance).collect();
        advances.sort_by(|a, b| a.delay.total_cmp(&b.delay));
        advances
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{Chain, Profile};

    /// Five gaps by hand: gap 1 starts, then 2 and 0 follow; gap 4 starts and 3 is never hit.
    fn by_hand() -> SpaceTime {
        let mut parameters = SpaceTimeParams::new(Profile::Quick);
        parameters.chain = Chain { masses: 4, ..Chain::default() };
        parameters.until = 100.0;
        SpaceTime {
            parameters,
            realisation: 0,
            times: vec![10.0, 12.0, 13.0, 14.0, 50.0, 60.0, 61.0],
            gaps: vec![1, 2, 1, 0, 4, 1, 1],
        }
    }

    #[test]
    fn a_small_run_is_read_right() {
        let run = by_hand();
        assert_eq!(run.firsts(), [Some(14.0), Some(10.0), Some(12.0), None, Some(50.0)]);
        assert_eq!((run.reached(), run.reached_by(12.0)), (4, 2));
        assert_eq!(run.starts(), [1, 4]);
        let advance = |gap, time, delay| Advance { gap, time, delay };
        assert_eq!(run.advances(), [advance(2, 12.0, 2.0), advance(0, 14.0, 4.0)]);
    }

    #[test]
    fn the_run_is_the_first_that_keeps_hitting() {
        // Below the threshold some runs fall silent, and are passed over.
        let seeded = |seed| {
            let quick = SpaceTimeParams::new(Profile::Quick);
            let parameters = SpaceTimeParams { seed, sigma: 0.1, last: 10.0, ..quick };
            run(&parameters, &Progress::silent()).unwrap()
        };
        let all: Vec<SpaceTime> = (1..=10).map(seeded).collect();
        let late = all[0].parameters.until - all[0].parameters.last;
        for found in &all {
            assert!(found.times.last().unwrap() > &late && found.times.is_sorted());
        }
        let found = all.into_iter().find(|found| found.realisation > 0).expect("one in ten");
        // Those passed over really had no late impact.
        for index in 0..found.realisation {
            let mut normals = NormalPairs::new("space-time", found.parameters.seed, index);
            let scenario = Scenario::draw(&Chain::default(), found.parameters.sigma, &mut normals);
            let mut last = 0.0;
            let mut engine = Engine::new(&scenario).unwrap();
            let seen = |impact: impact_chain::Impact| {
                last = impact.time;
                true
            };
            engine.run(found.parameters.until, seen).unwrap();
            assert!(last <= late, "realisation {index} has an impact at {last}");
        }
    }
}
