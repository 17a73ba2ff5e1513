//! Section 3's method on a short chain: which circuits have a periodic orbit, and where runs end.

mod ends;
mod hunt;
mod search;
pub mod tables;

pub use ends::{End, Ends};
pub use hunt::{Hunt, Prey};
pub use search::Found;

use super::segments::ORDERS;
use super::{Error, Progress};
use crate::dynamics::orbit::least_amplitude;
use crate::dynamics::{self, Engine, Initial, Scenario};
use crate::numerics::estimates::{average, with_error};
use crate::numerics::random::NormalPairs;
use crate::numerics::statistics::{Estimate, mean};
use crate::params::OrbitsParams;
use rayon::prelude::*;
use search::Sample;
use serde::{Deserialize, Serialize};

/// Periodic orbits of a short chain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Orbits {
    /// What was run.
    pub parameters: OrbitsParams,
    /// All simple circuits, by length, each from its first gap.
    pub circuits: Vec<Vec<usize>>,
    /// One for each σ.
    pub rows: Vec<Row>,
    /// The circuits of Figs. 5 and 6.
    pub hunts: Vec<Hunt>,
    /// A stable orbit, to be drawn.
    pub example: Option<Example>,
}

/// What was found at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// σ.
    pub sigma: f64,
    /// Every orbit of a simple circuit, by forcing.
    pub found: Vec<Found>,
    /// For each circuit the forcings with an orbit, and with a stable one.
    pub seen: Vec<[u64; 2]>,
    /// One for each length of a circuit.
    pub lengths: Vec<Length>,
    /// Number of orbits, and of stable ones.
    pub orbits: [u64; 2],
    /// Orbits by their period in periods of the forcing.
    pub by_periods: Vec<u64>,
    /// Orbits that the first half of the starts had found.
    pub by_half: u64,
    /// Stable orbits to which a motion beside them came back; unstable ones that it left.
    pub confirmed: [u64; 2],
    /// For each forcing, the gaps of the next.
    pub singles: Vec<u64>,
    /// Pairs of forcing and gap for which the equations of this gap alone have a solution within one
    /// period of the forcing, admissible or not.
    pub single: u64,
    /// Their share by the closed form.
    pub single_expected: f64,
    /// Where runs from rest ended.
    pub ended: Ends,
    /// Share of the forcings with a stable orbit of a simple circuit.
    pub any_stable: Estimate,
}

/// The circuits of one length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Length {
    /// Number of impacts k.
    pub k: usize,
    /// Share of these circuits with an orbit, over the forcings.
    pub admissible: Estimate,
    /// Share with a stable orbit.
    pub stable: Estimate,
}

/// An orbit in one period.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Example {
    /// σ.
    pub sigma: f64,
    /// Its circuit.
    pub circuit: Vec<usize>,
    /// Largest modulus of its multipliers.
    pub radius: f64,
    /// Period.
    pub period: f64,
    /// Times of the impacts.
    pub impacts: Vec<f64>,
    /// A grid of times that includes the impacts.
    pub times: Vec<f64>,
    /// Positions on that grid, `positions[mass][time]`.
    pub positions: Vec<Vec<f64>>,
}

/// Number of Newton's starts, for progress.
pub fn starts(parameters: &OrbitsParams) -> u64 {
    let circuits = circuits(parameters.chain.gaps()).len();
    let hunted = parameters.hunt.starts * parameters.hunt.forcings * parameters.hunt.sigmas.len();
    let own = parameters.starts * parameters.forcings * parameters.sigmas.len() * circuits;
    ((hunted * ORDERS.len() + own) * parameters.periods) as u64
}

/// Runs the experiment.
///
/// # Errors
/// [`Error::Interrupted`]; [`Error::Failed`] if the chain is not allowed.
pub fn run(parameters: &OrbitsParams, progress: &Progress) -> Result<Orbits, Error> {
    let circuits = circuits(parameters.chain.gaps());
    let forcings = (parameters.sigmas.len() * parameters.forcings) as u64;
    let stage = progress.stage("periodic orbits", forcings);
    let mut rows = Vec::new();
    let mut drawn: Option<search::Drawn> = None;
    for &sigma in &parameters.sigmas {
        let samples: Vec<Sample> = (0..parameters.forcings)
            .into_par_iter()
            .map(|index| {
                let sample = search::sample(parameters, &circuits, sigma, index, progress)?;
                stage.advance(1);
                Ok(sample)
            })
            .collect::<Result<_, Error>>()?;
        let first = samples.iter().filter_map(|sample| sample.drawn.clone());
        drawn = drawn.into_iter().chain(first).max_by(|a, b| a.rank().total_cmp(&b.rank()));
        rows.push(row(parameters, &circuits, sigma, samples)?);
    }
    let hunts = ORDERS.map(|order| hunt::hunt(parameters, &order[..order.len() - 1], progress));
    let example = drawn.map(|drawn| picture(&drawn)).transpose().map_err(fault)?;
    Ok(Orbits {
        parameters: parameters.clone(),
        circuits,
        rows,
        hunts: hunts.into_iter().collect::<Result<_, _>>()?,
        example,
    })
}

fn fault(source: dynamics::Error) -> Error {
    Error::failed("orbits", source)
}

/// The forcing of one number, scaled to σ.
fn scenario(parameters: &OrbitsParams, sigma: f64, index: usize) -> Scenario {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index as u64);
    Scenario::draw(&parameters.chain, sigma, &mut normals)
}

/// All simple circuits of a complete graph, each from its least vertex, by length.
fn circuits(vertices: usize) -> Vec<Vec<usize>> {
    fn grow(vertices: usize, path: &mut Vec<usize>, all: &mut Vec<Vec<usize>>) {
        all.push(path.clone());
        for next in path[0] + 1..vertices {
            if !path.contains(&next) {
                path.push(next);
                grow(vertices, path, all);
                path.pop();
            }
        }
    }
    let mut all = Vec::new();
    (0..vertices).for_each(|first| grow(vertices, &mut vec![first], &mut all));
    all.sort_by(|a, b| a.len().cmp(&b.len()).then(a.cmp(b)));
    all
}

/// The mean of a share over forcings.
fn over(sample: &[f64]) -> Estimate {
    average(sample).unwrap_or_else(|| with_error(mean(sample).unwrap_or(0.0), 0.0))
}

pub(crate) fn row(
    parameters: &OrbitsParams,
    circuits: &[Vec<usize>],
    sigma: f64,
    samples: Vec<Sample>,
) -> Result<Row, Error> {
    // Whether each circuit has an orbit, and a stable one, for each forcing.
    let has = |sample: &Sample, circuit: usize, stable: bool| {
        sample.found.iter().any(|f| f.circuit == circuit && (!stable || f.radius < 1.0))
    };
    let number = |circuit: usize, stable: bool| {
        samples.iter().filter(|sample| has(sample, circuit, stable)).count() as u64
    };
    let longest = circuits.last().map_or(0, Vec::len);
    let length = |k: usize| {
        let own: Vec<usize> = (0..circuits.len()).filter(|&c| circuits[c].len() == k).collect();
        let share = |stable: bool| {
            let of = |sample: &Sample| {
                own.iter().filter(|&&c| has(sample, c, stable)).count() as f64 / own.len() as f64
            };
            over(&samples.iter().map(of).collect::<Vec<f64>>())
        };
        Length { k, admissible: share(false), stable: share(true) }
    };
    let any = |sample: &Sample| f64::from(u8::from(sample.found.iter().any(|f| f.radius < 1.0)));
    let any_stable = over(&samples.iter().map(any).collect::<Vec<f64>>());
    let singles: Vec<u64> = samples.iter().map(|sample| sample.single).collect();
    let scene = scenario(parameters, sigma, 0);
    let tau = std::f64::consts::TAU;
    let least = least_amplitude(&scene, tau / scene.forcing_frequency).unwrap_or(f64::INFINITY);
    // The squared amplitude of a gap is exponential: with mean 2σ² at a wall, 4σ² between masses.
    let response = (scene.natural_frequency - scene.forcing_frequency)
        * (scene.natural_frequency + scene.forcing_frequency);
    let ratio = least * response / sigma;
    let inner = (parameters.chain.gaps() - 2) as f64;
    let wall = pxfm::f_exp(-0.5 * ratio * ratio);
    let single_expected = (2.0 * wall + inner * pxfm::f_exp(-0.25 * ratio * ratio)) / (2.0 + inner);
    let seen = (0..circuits.len()).map(|c| [number(c, false), number(c, true)]).collect();
    let lengths = (1..=longest).map(length).collect();
    let (found, ends): (Vec<_>, Vec<_>) = samples.into_iter().map(|s| (s.found, s.end)).unzip();
    let found = found.concat();
    let count = |is: &dyn Fn(&Found) -> bool| found.iter().filter(|f| is(f)).count() as u64;
    Ok(Row {
        sigma,
        seen,
        lengths,
        orbits: [count(&|_| true), count(&|f| f.radius < 1.0)],
        by_periods: (1..=parameters.periods).map(|m| count(&|f| f.periods == m)).collect(),
        by_half: count(&|f| f.start < parameters.starts / 2),
        confirmed: [
            count(&|f| f.radius < 1.0 && f.returned),
            count(&|f| f.radius >= 1.0 && !f.returned),
        ],
        single: singles.iter().sum(),
        singles,
        single_expected,
        ended: Ends::of(ends),
        any_stable,
        found,
    })
}

/// Points of the grid of an example.
const POINTS: usize = 240;

fn picture(drawn: &search::Drawn) -> Result<Example, dynamics::Error> {
    let orbit = &drawn.orbit;
    let start = Scenario { initial: Initial::Free(orbit.free.clone()), ..drawn.scenario.clone() };
    let mut engine = Engine::new(&start)?;
    let grid = (0..=POINTS).map(|i| orbit.period * i as f64 / POINTS as f64);
    let mut times: Vec<f64> = grid.chain(orbit.times.iter().copied()).collect();
    times.sort_by(f64::total_cmp);
    let mut positions = vec![Vec::new(); start.forcing.len()];
    for &time in &times {
        engine.run(time, |_| true)?;
        let places = engine.positions(time);
        positions.iter_mut().zip(places).for_each(|(own, place)| own.push(place));
    }
    Ok(Example {
        sigma: drawn.sigma,
        circuit: orbit.gaps.clone(),
        radius: drawn.radius,
        period: orbit.period,
        impacts: orbit.times.clone(),
        times,
        positions,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Profile;

    #[test]
    fn simple_circuits_are_counted() {
        // By hand: 4 vertices alone, 6 pairs, 4 triples in two directions, 3! orders of all.
        let all = circuits(4);
        let of = |k: usize| all.iter().filter(|c| c.len() == k).count();
        assert_eq!([of(1), of(2), of(3), of(4)], [4, 6, 8, 6]);
        assert_eq!(all.len(), 24);
        assert!(all.iter().all(|c| c[0] == *c.iter().min().unwrap()));
    }

    #[test]
    fn a_small_search_is_consistent_with_itself() {
        let mut parameters = OrbitsParams::new(Profile::Quick);
        parameters.sigmas = vec![0.2];
        parameters.forcings = 6;
        let orbits = run(&parameters, &Progress::silent()).unwrap();
        let [row] = &orbits.rows[..] else { panic!() };
        assert!(row.orbits[0] > 5 && row.orbits[1] > 0, "{:?}", row.orbits);
        assert_eq!(row.by_periods.iter().sum::<u64>(), row.orbits[0]);
        let seen = |i: usize| row.seen.iter().map(|pair| pair[i]).sum::<u64>();
        assert!(seen(0) <= row.orbits[0] && seen(1) <= seen(0));
        let ended = &row.ended;
        assert_eq!(ended.silent + ended.periodic + ended.neither + ended.failed, 6);
        assert!(orbits.example.is_some());
        assert_eq!(orbits.hunts[0].circuit, [0, 1, 3]);
        // Nothing depends on the order in which threads finish.
        assert_eq!(run(&parameters, &Progress::silent()).unwrap(), orbits);
    }
}
