//! One realisation: free parts before and after a window, and what its impacts did to them.

use super::{HeatParams, Run, until};
use crate::circuits::balance::energy_change;
use crate::circuits::impact_probability::amplitude;
use crate::dynamics::Scenario;
use crate::experiments::ensembles::{Running, count};
use crate::experiments::{Error, Progress};
use crate::numerics::random::NormalPairs;
use crate::params::{Boundary, Chain, HeatRow};

/// Half the sum of squares of free amplitudes.
fn energy<'a>(parts: impl Iterator<Item = &'a [f64; 2]>) -> f64 {
    parts.map(|[a, b]| 0.5 * (a * a + b * b)).sum()
}

/// Amplitudes of the forced part of a mass, from 1; those of a wall are zero.
fn forced(scenario: &Scenario, mass: usize) -> [f64; 2] {
    let (omega, big_omega) = (scenario.natural_frequency, scenario.forcing_frequency);
    let factor = omega * omega - big_omega * big_omega;
    let own = mass.checked_sub(1).and_then(|index| scenario.forcing.get(index));
    own.map_or([0.0; 2], |pair| pair.map(|amplitude| amplitude / factor))
}

/// The masses to the left and to the right of a gap; between walls 0 and n + 1 are these.
fn sides(scenario: &Scenario, gap: usize) -> [usize; 2] {
    let closed = scenario.boundary == Boundary::Ring && gap == scenario.forcing.len();
    [gap, if closed { 1 } else { gap + 1 }]
}

/// Closing speed of the forced parts of a gap.
fn forced_closing(scenario: &Scenario, gap: usize, time: f64) -> f64 {
    let big_omega = scenario.forcing_frequency;
    let (sin, cos) = pxfm::f_sincos(big_omega * time);
    let velocity = |[a, b]: [f64; 2]| big_omega * (b * cos - a * sin);
    let [left, right] = sides(scenario, gap).map(|mass| velocity(forced(scenario, mass)));
    left - right
}

/// Runs it; none if the engine gave up.
pub fn realisation(
    parameters: &HeatParams,
    row: &HeatRow,
    chain: &Chain,
    index: u64,
    progress: &Progress,
) -> Result<Option<Run>, Error> {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(chain, row.sigma, &mut normals);
    let mut motion = Running::new(&scenario, "heat", progress)?;
    if !motion.go(parameters.protocol.transient, |_| ())? {
        return Ok(None);
    }
    let before = energy(motion.engine.free_parts().iter());
    let contacts = motion.engine.counters().contact_phases;
    let masses = scenario.forcing.len();
    let mut run = Run::default();
    // One more at each end, for the walls.
    let mut hit = vec![false; masses + 2];
    let mut gaps = vec![false; masses + 1];
    let ended = motion.go(until(parameters), |impact| {
        let (v, r) = (impact.closing_speed, row.restitution);
        let f = forced_closing(&scenario, impact.gap, impact.time);
        let sides = sides(&scenario, impact.gap);
        let wall = sides[0] == 0 || sides[1] > masses;
        let reduced = if wall { 1.0 } else { 0.5 };
        run.gained += energy_change(reduced, r, v, f);
        run.lost += 0.5 * reduced * (1.0 - r * r) * v * v;
        run.squares += reduced * v * v;
        run.products += reduced * v * f;
        run.impacts += u64::from(!wall);
        gaps[impact.gap] = true;
        for mass in sides {
            hit[mass] = true;
        }
    });
    if !ended? {
        return Ok(None);
    }
    let parts = motion.engine.free_parts();
    let struck =
        || parts.iter().zip(&hit[1..=masses]).filter(|(_, hit)| **hit).map(|(part, _)| part);
    run.free = energy(parts.iter());
    run.free_of_hit = energy(struck());
    run.hit = struck().count() as u64;
    run.changed = run.free - before;
    run.contact = motion.engine.counters().contact_phases > contacts;
    run.distinct = count(&gaps);
    run.closing = closing(&scenario, &parts);
    Ok(Some(run))
}

/// Gaps whose amplitudes reach from one mass to the other, Y_0 + Y_1/|ω² − Ω²| ≥ d.
fn closing(scenario: &Scenario, parts: &[[f64; 2]]) -> u64 {
    let free = |mass: usize| {
        let own = mass.checked_sub(1).and_then(|index| parts.get(index));
        own.copied().unwrap_or([0.0; 2])
    };
    let differ = |[a, b]: [f64; 2], [c, d]: [f64; 2]| amplitude(c - a, d - b);
    let reaches = |gap: &usize| {
        let [left, right] = sides(scenario, *gap);
        let own = differ(free(left), free(right));
        own + differ(forced(scenario, left), forced(scenario, right)) >= scenario.spacing
    };
    // A ring counts its gaps from 1.
    let first = usize::from(scenario.boundary == Boundary::Ring);
    (first..first + scenario.gaps()).filter(reaches).count() as u64
}
