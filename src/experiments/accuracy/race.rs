//! Every method against the true motion: the next impact, and whole runs until they leave it.

use crate::experiments::horizon::{self, Horizon};
use crate::experiments::prelude::*;
use impact_chain::methods::truth::{Hit, TrueMotion};
use impact_chain::methods::{Cost, Method, Task};
use impact_numerics::double_double::DoubleDouble;

/// A time off by more than this counts as lost, in units of 1/ω.
pub const DISPLACED: f64 = 1e-3;

/// No state waits longer than this for its next impact.
const LONGEST: f64 = 1e3;

/// Time after the true impact within which a method may still find it.
const PATIENCE: f64 = 0.1;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Race {
    pub parameters: RaceParams,
    pub growth: Horizon,
    pub entries: Vec<Entry>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    pub setting: Setting,
    /// Evaluations per impact of the runs.
    pub work: Option<f64>,
    /// When each run left the truth: at the first impact not within [`DISPLACED`], or at its end.
    pub runs: Vec<f64>,
    /// Number of exact states from which the next impact was computed.
    pub tried: u64,
    /// Number of these states whose next impact was not found, or not within [`DISPLACED`].
    pub misses: u64,
    /// Median and largest error of the time of the next impact, over those with the right gap.
    pub errors: Option<[f64; 2]>,
    /// The largest of these errors in units of ε (d + R₁ + R₂)/|Δ'|.
    pub units: Option<f64>,
}

impl Entry {
    /// Returns the mean time at which runs left the truth, a lower bound if some did not leave it.
    pub fn horizon(&self) -> Option<Estimate> {
        mean(&self.runs).map(|mean| with_error(mean, standard_error(&self.runs).unwrap_or(0.0)))
    }
}

struct Course {
    scenario: Scenario,
    hits: Vec<(Hit, State)>,
}

pub fn run(parameters: &RaceParams, progress: &Progress) -> Result<Race, Error> {
    let growth = horizon::run(&parameters.growth, progress)?;
    let stage = progress.stage("true motions", parameters.chains as u64);
    let courses = run_each(&stage, progress, 0..parameters.chains as u64, |index| {
        let scenario = parameters.growth.scenario(index);
        let hits = TrueMotion::from_state(&scenario, &State::from_scenario(&scenario))
            .run(parameters.until);
        Ok(Course { scenario, hits: hits.map_err(|source| Error::failed("race", source))? })
    })?;
    let targets = targets(parameters.segments, &courses);
    let targets = targets.map_err(|source| Error::failed("race", source))?;
    let stage = progress.stage("methods against the truth", parameters.settings.len() as u64);
    let entries = run_each(&stage, progress, &parameters.settings, |setting| {
        entry(parameters, *setting, &courses, &targets, progress)
    })?;
    Ok(Race { parameters: parameters.clone(), growth, entries })
}

/// A state to start from at t = 0, and the true next impact of exactly these doubles.
struct Target {
    scenario: Scenario,
    state: State,
    hit: Hit,
    /// ε (d + R₁ + R₂)/|Δ'|: the error of the time by the rounding of the gap.
    unit: f64,
}

/// States right after impacts of the true motion, moved to t = 0, so that rounding hides no error.
fn targets(number: usize, courses: &[Course]) -> Result<Vec<Target>, impact_chain::Error> {
    let mut targets = Vec::with_capacity(number);
    for Course { scenario, hits } in courses {
        let last = hits.len().saturating_sub(1);
        let count = (number / courses.len()).min(last);
        for i in 0..count {
            let (_, state) = &hits[i * last / count];
            let scenario = state.as_scenario(scenario)?;
            let state = State { time: 0.0, ..state.clone() };
            let mut truth = TrueMotion::from_state(&scenario, &state);
            targets.extend(truth.next(LONGEST)?.map(|hit| {
                let unit = f64::EPSILON * truth.scale(hit.gap) / hit.closing_speed;
                Target { scenario, state, hit, unit }
            }));
        }
    }
    Ok(targets)
}

fn entry(
    parameters: &RaceParams,
    setting: Setting,
    courses: &[Course],
    targets: &[Target],
    progress: &Progress,
) -> Result<Entry, Error> {
    let method = setting.method();
    let (mut cost, mut runs) = (Cost::default(), Vec::with_capacity(courses.len()));
    for course in courses {
        let (run, work) = follow(parameters, method.as_ref(), course, progress);
        progress.check()?;
        runs.push(run);
        cost.impacts += work.impacts;
        cost.evaluations += work.evaluations;
    }
    let (mut misses, mut errors, mut units) = (0, Vec::new(), None);
    for Target { scenario, state, hit, unit } in targets {
        progress.check()?;
        let until = hit.time.to_f64() + PATIENCE;
        match method.first(Task { scenario, start: state, until }) {
            Ok(Some(impact)) if impact.gap == hit.gap => {
                let error = error(hit, &impact);
                errors.push(error);
                units = Some(units.map_or(error / unit, |u: f64| u.max(error / unit)));
                misses += u64::from(error > DISPLACED);
            }
            _ => misses += 1,
        }
    }
    errors.sort_by(f64::total_cmp);
    Ok(Entry {
        setting,
        work: cost.evaluations_per_impact(),
        runs,
        tried: targets.len() as u64,
        misses,
        errors: quantile(&errors, 0.5).zip(errors.last()).map(|(median, last)| [median, *last]),
        units,
    })
}

/// Returns the time at which a chain left the truth, and its cost, zero if the method failed.
fn follow(
    parameters: &RaceParams,
    method: &dyn Method,
    Course { scenario, hits }: &Course,
    progress: &Progress,
) -> (f64, Cost) {
    let mut left = None;
    let mut truth = hits.iter().map(|(hit, _)| hit);
    let mut compare = |impact: Impact| {
        let agrees = |hit: &&Hit| hit.gap == impact.gap && error(hit, &impact) <= DISPLACED;
        let other = truth.next().filter(|hit| left.is_none() && !agrees(hit));
        left = left.or(other.map(|hit| hit.time.to_f64()));
        (left.is_none() || impact.time < parameters.at_least) && !progress.stopped()
    };
    let task = Task { scenario, start: &State::from_scenario(scenario), until: parameters.until };
    let cost = method.run(task, &mut compare);
    // Or at the first impact of the truth that the run did not reach.
    let left = left.or_else(|| truth.next().map(|hit| hit.time.to_f64()));
    (left.unwrap_or(parameters.until), cost.unwrap_or_default())
}

fn error(hit: &Hit, impact: &Impact) -> f64 {
    (DoubleDouble::from(impact.time) - hit.time).to_f64().abs()
}
