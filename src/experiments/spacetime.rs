//! Records one long run at the printed threshold: the first with impacts in its last part.

use crate::experiments::prelude::*;

pub const SPACE_TIME: Experiment<Runs, SpaceTime> = Experiment {
    own: &["src/experiments/spacetime.rs"],
    how: Whole(run, |parameters| parameters.until as u64 * WORK_PER_SECOND / 100_000),
    ..Experiment::new("spacetime", Runs::spacetime, run, tables)
};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceTime {
    pub parameters: Runs,
    pub times: Vec<f64>,
    /// Gap of each impact, from 0.
    pub gaps: Vec<u32>,
}

pub fn run(parameters: &Runs, progress: &Progress) -> Result<SpaceTime, Error> {
    let stage = progress.stage("spacetime", 1);
    for realisation in 0..parameters.realisations as u64 {
        progress.check()?;
        let impacts = Engine::new(&parameters.scenario(realisation))
            .and_then(|mut engine| engine.impacts(parameters.until))
            .map_err(|source| Error::failed("spacetime", source))?;
        if impacts.last().is_some_and(|last| last.time > 0.9 * parameters.until) {
            stage.advance(1);
            let (times, gaps) = impacts.iter().map(|hit| (hit.time, hit.gap as u32)).unzip();
            return Ok(SpaceTime { parameters: parameters.clone(), times, gaps });
        }
    }
    let problem = format!("no run with {:?} has late impacts", parameters.sigma);
    Err(Error::input("sigma", problem, "give a larger one"))
}

impl SpaceTime {
    pub fn width(&self) -> usize {
        self.parameters.chain.gaps()
    }

    /// Returns the time of the first impact of each gap, or `None` if it has none.
    pub fn firsts(&self) -> Vec<Option<f64>> {
        let mut firsts = vec![None; self.width()];
        for (&time, &gap) in self.times.iter().zip(&self.gaps) {
            firsts[gap as usize].get_or_insert(time);
        }
        firsts
    }

    /// Returns for each gap that is hit the time since a neighbour's first impact, if any.
    fn waits(&self) -> Vec<(usize, Option<f64>)> {
        let firsts: Vec<f64> =
            self.firsts().into_iter().map(|first| first.unwrap_or(f64::INFINITY)).collect();
        let mut waits = Vec::new();
        for (gap, &first) in firsts.iter().enumerate().filter(|(_, first)| first.is_finite()) {
            let around = &firsts[gap.saturating_sub(1)..firsts.len().min(gap + 2)];
            let earliest = around.iter().copied().fold(first, f64::min);
            waits.push((gap, (earliest < first).then_some(first - earliest)));
        }
        waits
    }

    /// Returns the gaps at which impacts start, by themselves: hit when neither neighbour had been.
    pub fn starts(&self) -> Vec<usize> {
        let starts = self.waits().into_iter().filter(|(_, wait)| wait.is_none());
        starts.map(|(gap, _)| gap).collect()
    }

    /// Returns how long each step of a front takes, the quickest first; starts are no steps.
    fn advances(&self) -> Vec<f64> {
        let steps = self.waits().into_iter().filter_map(|(_, wait)| wait);
        let mut advances: Vec<f64> = steps.collect();
        advances.sort_by(f64::total_cmp);
        advances
    }
}

pub fn tables(run: &SpaceTime) -> Vec<Table> {
    let advances = run.advances();
    let median = advances.get(advances.len() / 2);
    let table = Table::builder("spacetime.run", &[run], |_| 1)
        .chosen("sigma", SIGMA, "standard deviation σ", |run| Some(run.parameters.sigma))
        .chosen("until", TIME, "length of the run", |run| Some(run.parameters.until))
        .count("starts", "gaps hit when neither neighbour was", |run| run.starts().len() as u64)
        .computed_by(origin(SpaceTime::starts), &["starts"])
        .real("advance_median", TIME, 3, "median step of a front", |_| median.copied())
        .real("advance_longest", TIME, 3, "longest step of a front", |_| advances.last().copied())
        .computed_by(origin(SpaceTime::advances), &["advance_median", "advance_longest"])
        .done();
    vec![table]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gap 1 starts, then 2 and 0 follow; gap 4 starts and 3 is never hit.
    #[test]
    fn a_small_run_is_read_right() {
        let chain = Chain { masses: 4, ..Chain::default() };
        let parameters = Runs { chain, ..Runs::spacetime(Profile::Quick) };
        let (times, gaps) = (vec![10.0, 12.0, 13.0, 14.0, 50.0, 60.0], vec![1, 2, 1, 0, 4, 1]);
        let run = SpaceTime { parameters, times, gaps };
        assert_eq!(run.firsts(), [Some(14.0), Some(10.0), Some(12.0), None, Some(50.0)]);
        assert_eq!(run.starts(), [1, 4]);
        assert_eq!(run.advances(), [2.0, 4.0]);
    }
}
