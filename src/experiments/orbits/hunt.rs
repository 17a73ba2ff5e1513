//! The search for one circuit over many forcings.

use super::search::times;
use super::{Error, fault, scenario};
use crate::dynamics::orbit::{Solver, Stability, replay};
use crate::dynamics::{self, Engine, Scenario};
use crate::experiments::Progress;
use crate::numerics::random::generator;
use crate::params::OrbitsParams;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// What the search for a circuit gave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hunt {
    /// The circuit.
    pub circuit: Vec<usize>,
    /// Random starts of Newton's method.
    pub starts: u64,
    /// Stretches of runs with these impacts, which nearly close: further starts.
    pub returns: u64,
    /// Solutions of the equations, from any start.
    pub solutions: u64,
    /// Pairs of σ and forcing with an orbit that the engine confirms.
    pub admissible: u64,
    /// Pairs with a stable one.
    pub stable: u64,
    /// Stretches, solutions and whether there is an orbit and a stable one, for each pair.
    pub each: Vec<[u64; 4]>,
    /// The orbit with the least radius.
    pub best: Option<Prey>,
}

/// One orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prey {
    /// σ.
    pub sigma: f64,
    /// Number of the forcing.
    pub forcing: usize,
    /// Period, in periods of the forcing.
    pub periods: usize,
    /// Largest modulus of a multiplier that is not neutral.
    pub radius: f64,
    /// These multipliers.
    pub multipliers: Vec<[f64; 2]>,
}

pub fn hunt(
    parameters: &OrbitsParams,
    circuit: &[usize],
    progress: &Progress,
) -> Result<Hunt, Error> {
    let own = &parameters.hunt;
    let all: Vec<(f64, usize)> =
        own.sigmas.iter().flat_map(|&sigma| (0..own.forcings).map(move |i| (sigma, i))).collect();
    let one = |&(sigma, index): &(f64, usize)| {
        progress.check()?;
        beneath(parameters, circuit, sigma, index).map_err(fault)
    };
    let each: Vec<Hunt> = all.par_iter().map(one).collect::<Result<_, Error>>()?;
    let sum = |of: fn(&Hunt) -> u64| each.iter().map(of).sum();
    let best = each.iter().filter_map(|hunt| hunt.best.clone());
    Ok(Hunt {
        circuit: circuit.to_vec(),
        starts: sum(|hunt| hunt.starts),
        returns: sum(|hunt| hunt.returns),
        solutions: sum(|hunt| hunt.solutions),
        admissible: sum(|hunt| hunt.admissible),
        stable: sum(|hunt| hunt.stable),
        each: each.iter().map(|h| [h.returns, h.solutions, h.admissible, h.stable]).collect(),
        best: best.min_by(|a, b| a.radius.total_cmp(&b.radius)),
    })
}

/// The search under one forcing.
fn beneath(
    parameters: &OrbitsParams,
    circuit: &[usize],
    sigma: f64,
    index: usize,
) -> Result<Hunt, dynamics::Error> {
    let scenario = scenario(parameters, sigma, index);
    let mut random =
        generator(&format!("{} hunt", parameters.stream), parameters.seed, index as u64);
    let close = close_returns(&scenario, circuit, parameters.hunt.until)?;
    let mut hunt = Hunt {
        circuit: circuit.to_vec(),
        starts: (parameters.periods * parameters.hunt.starts) as u64,
        returns: 0,
        solutions: 0,
        admissible: 0,
        stable: 0,
        each: Vec::new(),
        best: None,
    };
    for periods in 1..=parameters.periods {
        let solver = Solver::new(&scenario, circuit, periods)?;
        let draws =
            (0..parameters.hunt.starts).map(|_| times(&mut random, circuit.len(), solver.period()));
        let seen = close.iter().filter(|(own, _)| *own == periods).map(|(_, times)| times.clone());
        let starts: Vec<Vec<f64>> = draws.chain(seen).collect();
        hunt.returns += (starts.len() - parameters.hunt.starts) as u64;
        for orbit in starts.iter().filter_map(|times| solver.from(times)) {
            hunt.solutions += 1;
            if replay(&scenario, &orbit)?.is_some()
                && let Some(stability) = Stability::new(&scenario, &orbit)
            {
                let radius = stability.radius();
                hunt.admissible = 1;
                hunt.stable |= u64::from(radius < 1.0);
                if hunt.best.as_ref().is_none_or(|best| radius < best.radius) {
                    hunt.best = Some(Prey {
                        sigma,
                        forcing: index,
                        periods,
                        radius,
                        multipliers: stability.multipliers,
                    });
                }
            }
        }
    }
    Ok(hunt)
}

/// Stretches of a run from rest whose impacts are the circuit's and which end with its first impact again
/// near a whole number of periods of the forcing: that number, and the times from the phase 0 on.
fn close_returns(
    scenario: &Scenario,
    circuit: &[usize],
    until: f64,
) -> Result<Vec<(usize, Vec<f64>)>, dynamics::Error> {
    let forcing = std::f64::consts::TAU / scenario.forcing_frequency;
    let mut impacts = Vec::new();
    let ended = Engine::new(scenario)?.run(until, |impact| {
        impacts.push((impact.time, impact.gap));
        true
    });
    match ended {
        Err(dynamics::Error::Work { .. }) => {}
        other => other?,
    }
    let k = circuit.len();
    let mut found = Vec::new();
    for stretch in impacts.windows(k + 1) {
        // The solver wants the circuit from its first gap: another turn of it is another stretch.
        if stretch.iter().zip(circuit.iter().chain(circuit)).any(|(own, gap)| own.1 != *gap) {
            continue;
        }
        let first = stretch[0].0;
        let periods = ((stretch[k].0 - first) / forcing).round().max(1.0);
        let last = stretch[k - 1].0 - first;
        // What took longer than the period it is near is squeezed into it.
        let squeeze = (periods * forcing * 0.98 / last).min(1.0);
        let phase = first - forcing * (first / forcing).floor();
        let times = stretch[..k].iter().map(|(time, _)| phase + squeeze * (time - first));
        found.push((periods as usize, times.collect()));
    }
    Ok(found)
}
