//! All simple circuits under one forcing.

use super::ends::{self, End};
use super::{Error, fault, scenario};
use crate::dynamics::orbit::{Orbit, Solver, Stability, TOLERANCE, replay};
use crate::dynamics::{self, Engine, Initial, Scenario};
use crate::experiments::Progress;
use crate::numerics::random::generator;
use crate::params::OrbitsParams;
use rand::RngExt;
use rand_pcg::Pcg64Dxsm;
use serde::{Deserialize, Serialize};

/// A periodic orbit of a simple circuit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Number of the forcing.
    pub forcing: usize,
    /// Place of its circuit.
    pub circuit: usize,
    /// Its period, in periods of the forcing.
    pub periods: usize,
    /// The start from which it was first found.
    pub start: usize,
    /// Multipliers (re, im) that are not neutral.
    pub multipliers: Vec<[f64; 2]>,
    /// Their largest modulus.
    pub radius: f64,
    /// Pairs of neutral multipliers.
    pub neutral: usize,
    /// The largest difference between its impacts and the engine's.
    pub late: f64,
    /// Whether a motion that began beside it has come back to its impacts.
    pub returned: bool,
}

/// What one forcing has.
pub struct Sample {
    pub found: Vec<Found>,
    pub single: u64,
    pub end: End,
    pub drawn: Option<Drawn>,
}

/// An orbit that may be drawn.
#[derive(Clone)]
pub struct Drawn {
    pub scenario: Scenario,
    pub sigma: f64,
    pub orbit: Orbit,
    pub radius: f64,
}

impl Drawn {
    /// The longest is drawn, and of these the one that attracts most.
    pub fn rank(&self) -> f64 {
        self.orbit.gaps.len() as f64 - self.radius
    }
}

/// Orbits nearer than this in time and speed are one.
const SAME: f64 = 1e-6;

/// By how much free parts are disturbed, in units of length.
const DISTURBANCE: f64 = 1e-4;

/// Random times in one period, in order.
pub fn times(random: &mut Pcg64Dxsm, k: usize, period: f64) -> Vec<f64> {
    let mut times: Vec<f64> = (0..k).map(|_| random.random::<f64>() * period).collect();
    times.sort_by(f64::total_cmp);
    times
}

/// Whether two orbits of one simple circuit are one, up to periods of the forcing.
fn same(one: &Orbit, other: &Orbit, gap: usize, forcing: f64) -> bool {
    let place = |orbit: &Orbit| orbit.gaps.iter().position(|&own| own == gap).unwrap_or(0);
    let (i, j) = (place(one), place(other));
    let apart = (one.times[i] - other.times[j]) / forcing;
    (apart - apart.round()).abs() < SAME && (one.speeds[i] - other.speeds[j]).abs() < SAME
}

pub fn sample(
    parameters: &OrbitsParams,
    circuits: &[Vec<usize>],
    sigma: f64,
    index: usize,
    progress: &Progress,
) -> Result<Sample, Error> {
    let scenario = scenario(parameters, sigma, index);
    let forcing = std::f64::consts::TAU / scenario.forcing_frequency;
    let stream = format!("{} starts", parameters.stream);
    let mut random = generator(&stream, parameters.seed, index as u64);
    let (mut found, mut single) = (Vec::new(), 0);
    let mut drawn: Option<Drawn> = None;
    for (place, circuit) in circuits.iter().enumerate() {
        progress.check()?;
        for periods in 1..=parameters.periods {
            let solver = Solver::new(&scenario, circuit, periods).map_err(fault)?;
            let mut roots: Vec<Orbit> = Vec::new();
            for start in 0..parameters.starts {
                let times = times(&mut random, circuit.len(), solver.period());
                let Some(orbit) = solver.from(&times) else { continue };
                if roots.iter().any(|root| same(root, &orbit, circuit[0], forcing)) {
                    continue;
                }
                if let Some(told) = replay(&scenario, &orbit).map_err(fault)?
                    && let Some(stability) = Stability::new(&scenario, &orbit)
                {
                    let radius = stability.radius();
                    found.push(Found {
                        forcing: index,
                        circuit: place,
                        periods,
                        start,
                        radius,
                        multipliers: stability.multipliers,
                        neutral: stability.neutral,
                        late: told.late,
                        returned: returned(&scenario, &orbit, parameters.returns).map_err(fault)?,
                    });
                    let own =
                        Drawn { scenario: scenario.clone(), sigma, orbit: orbit.clone(), radius };
                    if radius < 1.0 && drawn.as_ref().is_none_or(|other| own.rank() > other.rank())
                    {
                        drawn = Some(own);
                    }
                }
                roots.push(orbit);
            }
            if circuit.len() == 1 && periods == 1 && !roots.is_empty() {
                single += 1;
            }
        }
    }
    let end = ends::end(parameters, &scenario, circuits, &found).map_err(fault)?;
    Ok(Sample { found, single, end, drawn })
}

/// Whether a motion beside an orbit has its impacts again after some periods.
fn returned(scenario: &Scenario, orbit: &Orbit, periods: usize) -> Result<bool, dynamics::Error> {
    let mut free = orbit.free.clone();
    for (j, part) in free.iter_mut().enumerate() {
        part[j % 2] += DISTURBANCE;
        part[1 - j % 2] -= 0.5 * DISTURBANCE;
    }
    let start = Scenario { initial: Initial::Free(free), ..scenario.clone() };
    let mut engine = match Engine::new(&start) {
        Err(dynamics::Error::Overlap { .. }) => return Ok(false),
        other => other?,
    };
    // The last period, cut before its first impact.
    let edge = periods as f64 * orbit.period;
    let margin = 0.5 * (orbit.times[0] + orbit.period - orbit.times[orbit.times.len() - 1]);
    let first = edge + orbit.times[0] - margin;
    let quiet = |ended: Result<(), dynamics::Error>| match ended {
        Err(dynamics::Error::Work { .. }) => Ok(false),
        other => other.map(|()| true),
    };
    if !quiet(engine.run(first, |_| true))? {
        return Ok(false);
    }
    let (mut seen, mut same) = (0, true);
    let ran = quiet(engine.run(first + orbit.period, |impact| {
        let expected = orbit.times.get(seen).map(|time| edge + time);
        same &= orbit.gaps.get(seen) == Some(&impact.gap)
            && expected.is_some_and(|time| (impact.time - time).abs() < TOLERANCE);
        seen += 1;
        same
    }))?;
    Ok(ran && same && seen == orbit.gaps.len())
}
