//! Every method against the true motion: the next impact from exact states, and whole runs until
//! they leave the truth, with the counted work of both.

use super::routes::method;
use crate::experiments::ensembles::each;
use crate::experiments::horizon::{self, Horizon};
use crate::experiments::{Error, Progress};
use crate::params::{RaceParams, Setting};
use impact_chain::methods::State;
use impact_chain::methods::truth::{Hit, TrueMotion};
use impact_chain::{self, Impact, Scenario};
use impact_numerics::double_double::DoubleDouble;
use impact_numerics::random::NormalPairs;
use impact_numerics::statistics::{mean, quantile, standard_error};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// A time off by more than this counts as lost, in units of 1/ω.
pub const DISPLACED: f64 = 1e-3;

/// No state waits longer than this for its next impact.
const LONGEST: f64 = 1e3;

/// Waiting longer than this beyond the true impact is no use.
const PATIENCE: f64 = 0.1;

/// All methods against the truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Race {
    /// What was run.
    pub parameters: RaceParams,
    /// Growth of small differences in the same chain.
    pub growth: Horizon,
    /// Impacts of the true motion of each chain.
    pub impacts: Vec<u64>,
    /// One for each setting, in their order.
    pub entries: Vec<Entry>,
}

/// What one method with one setting did.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Method and setting.
    pub setting: Setting,
    /// Evaluations per impact of the runs.
    pub evaluations_per_impact: Option<f64>,
    /// When each run left the truth: the time of the first impact of the truth that it has not within [`DISPLACED`], or
    /// the end of the run.
    pub runs: Vec<f64>,
    /// Mean time at which the runs left the truth, and its standard error; those that did not
    /// count with the end of the run, so the mean is then a lower bound.
    pub horizon: Option<[f64; 2]>,
    /// The next impact from exact states.
    pub segments: Segments,
}

/// The next impact from exact states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Segments {
    /// States tried.
    pub tried: u64,
    /// Those whose next impact was not found, or not within [`DISPLACED`].
    pub misses: u64,
    /// Median and largest error of the time, of those with the right gap.
    pub errors: Option<[f64; 2]>,
    /// The largest of these errors in units of ε (d + R₁ + R₂)/|Δ'|.
    pub units: Option<f64>,
}

/// The true motion of one chain.
struct Course {
    scenario: Scenario,
    hits: Vec<(Hit, State)>,
}

/// Runs everything.
pub fn run(parameters: &RaceParams, progress: &Progress) -> Result<Race, Error> {
    let growth = horizon::run(&parameters.growth, progress)?;
    let failed = |source| Error::failed("race", source);
    let courses: Vec<Course> = (0..parameters.chains)
        .into_par_iter()
        .with_max_len(1)
        .map(|index| {
            progress.check()?;
            let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index as u64);
            let scenario = Scenario::draw(&parameters.chain, parameters.sigma, &mut normals);
            let mut truth = TrueMotion::of(&scenario, &State::of(&scenario));
            let hits = truth.run(parameters.until).map_err(failed)?;
            Ok(Course { scenario, hits })
        })
        .collect::<Result<_, Error>>()?;
    let targets = targets(parameters, &courses)?;
    let stage = progress.stage("methods against the truth", parameters.settings.len() as u64);
    let entries = each(&stage, progress, parameters.settings.iter().copied(), |setting| {
        entry(parameters, setting, &courses, &targets, progress)
    })?;
    Ok(Race {
        parameters: parameters.clone(),
        growth,
        impacts: courses.iter().map(|course| course.hits.len() as u64).collect(),
        entries,
    })
}

/// A state to start from at t = 0, and the true next impact of exactly these doubles.
struct Target {
    scenario: Scenario,
    state: State,
    hit: Hit,
    /// ε (d + R₁ + R₂)/|Δ'|: what rounding the gap makes of its time.
    unit: f64,
}

/// States right after impacts of the true motion. Each is moved to t = 0, the forcing with it, so
/// that the rounding of a late time hides no error.
fn targets(parameters: &RaceParams, courses: &[Course]) -> Result<Vec<Target>, Error> {
    let failed = |source| Error::failed("race", source);
    let wanted = parameters.segments / courses.len().max(1);
    let mut targets = Vec::with_capacity(parameters.segments);
    for Course { scenario, hits } in courses {
        let last = hits.len().saturating_sub(1);
        for i in 0..wanted.min(last) {
            let (_, state) = &hits[i * last / wanted.min(last)];
            let scenario = state.as_scenario(scenario).map_err(failed)?;
            let state = State { time: 0.0, ..state.clone() };
            let truth = TrueMotion::of(&scenario, &state);
            targets.extend(truth.next(LONGEST).map_err(failed)?.map(|hit| {
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
    let (mut impacts, mut evaluations) = (0, 0);
    let mut runs = Vec::with_capacity(courses.len());
    for course in courses {
        progress.check()?;
        let (run, cost) = follow(parameters, setting, course, progress);
        progress.check()?;
        runs.push(run);
        if let Some(cost) = cost {
            impacts += cost.impacts;
            evaluations += cost.evaluations;
        }
    }
    let segments = segments(setting, targets, progress)?;
    Ok(Entry {
        setting,
        evaluations_per_impact: (impacts > 0).then(|| evaluations as f64 / impacts as f64),
        horizon: mean(&runs).map(|m| [m, standard_error(&runs).unwrap_or(0.0)]),
        runs,
        segments,
    })
}

/// Runs one chain from its start until it has left the truth and its cost is known: when it did, and the cost, if it
/// could go on so long.
fn follow(
    parameters: &RaceParams,
    setting: Setting,
    course: &Course,
    progress: &Progress,
) -> (f64, Option<impact_chain::methods::Cost>) {
    let mut left = None;
    let mut truth = course.hits.iter().map(|(hit, _)| hit);
    let mut compare = |impact: Impact| {
        let other = truth.next().filter(|hit| left.is_none() && !agrees(hit, &impact));
        left = left.or(other.map(|hit| hit.time.to_f64()));
        (left.is_none() || impact.time < parameters.at_least) && !progress.stopped()
    };
    let start = State::of(&course.scenario);
    let cost = method(setting).run(&course.scenario, &start, parameters.until, &mut compare);
    // Or at an impact of the truth that the run never came to.
    let left = left.or_else(|| truth.next().map(|hit| hit.time.to_f64()));
    (left.unwrap_or(parameters.until), cost.ok())
}

fn agrees(hit: &Hit, impact: &Impact) -> bool {
    hit.gap == impact.gap && error(hit, impact) <= DISPLACED
}

fn error(hit: &Hit, impact: &Impact) -> f64 {
    (DoubleDouble::from(impact.time) - hit.time).to_f64().abs()
}

/// Starts anew from each exact state.
fn segments(setting: Setting, targets: &[Target], progress: &Progress) -> Result<Segments, Error> {
    let mut found = Segments { tried: 0, misses: 0, errors: None, units: None };
    let mut errors = Vec::new();
    let method = method(setting);
    for Target { scenario, state, hit, unit } in targets {
        progress.check()?;
        found.tried += 1;
        let mut first = None;
        let until = hit.time.to_f64() + PATIENCE;
        let ran = method.run(scenario, state, until, &mut |impact| {
            first = Some(impact);
            false
        });
        match (ran, first) {
            (Ok(_), Some(impact)) if impact.gap == hit.gap => {
                let error = error(hit, &impact);
                errors.push(error);
                found.units = Some(found.units.map_or(error / unit, |u| u.max(error / unit)));
                found.misses += u64::from(error > DISPLACED);
            }
            _ => found.misses += 1,
        }
    }
    errors.sort_by(f64::total_cmp);
    found.errors = quantile(&errors, 0.5).zip(errors.last()).map(|(median, last)| [median, *last]);
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{MethodName, Profile};

    #[test]
    fn ours_loses_nothing_and_a_coarse_method_does() {
        let mut parameters = RaceParams::new(Profile::Quick);
        parameters.segments = 40;
        let race = run(&parameters, &Progress::silent()).unwrap();
        let of = |name: MethodName| {
            race.entries.iter().find(|entry| entry.setting.method == name).unwrap()
        };
        let ours = of(MethodName::Certified);
        assert_eq!((ours.segments.tried, ours.segments.misses), (40, 0));
        let [_, largest] = ours.segments.errors.unwrap();
        assert!(largest > 0.0 && largest < 1e-12, "{largest:e}");
        assert_eq!(ours.runs[0], parameters.until, "{:?}", ours.runs);
        assert!(ours.evaluations_per_impact.unwrap() < 40.0);
        for name in [MethodName::Verlet, MethodName::Penalty, MethodName::MoreauJean] {
            let theirs = of(name);
            assert!(theirs.segments.misses > 20, "{theirs:?}");
            assert!(theirs.runs[0] < 0.5 * parameters.until, "{theirs:?}");
        }
    }
}
