//! One realisation: what is counted in its windows.

use super::super::{Error, Progress};
use super::{Case, Run, chain};
use crate::dynamics::{self, Engine, Impact, Scenario};
use crate::numerics::random::NormalPairs;
use crate::params::RestitutionParams;

/// Time between two looks at which gaps are in contact, in units of 1/ω: no divisor of a period.
const LOOK: f64 = 1.0;

pub(super) fn realisation(
    parameters: &RestitutionParams,
    case: &Case,
    index: u64,
    progress: &Progress,
) -> Result<Option<Run>, Error> {
    progress.check()?;
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(&chain(parameters, case.restitution), case.sigma, &mut normals);
    let fault = |source| Error::failed("restitution", source);
    let mut engine = Engine::new(&scenario).map_err(fault)?;
    let mut run = Run::default();
    let mut begin = 0.0;
    for (place, &end) in case.ends.iter().enumerate() {
        let before = engine.counters().impacts;
        let ended = if place + 1 == case.ends.len() {
            last(&mut engine, &scenario, (begin, end), &mut run, progress)
        } else {
            engine.run(end, |_| !progress.stopped())
        };
        progress.check()?;
        match ended {
            Ok(()) => {}
            Err(dynamics::Error::Work { .. }) => return Ok(None),
            Err(source) => return Err(fault(source)),
        }
        run.impacts.push(engine.counters().impacts - before);
        let free = engine.free_parts();
        run.free.push(free.iter().map(|[a, b]| 0.5 * (a * a + b * b)).sum());
        begin = end;
    }
    Ok(Some(run))
}

/// Goes through the last window, in which every impact and every contact is looked at.
fn last(
    engine: &mut Engine,
    scenario: &Scenario,
    (begin, end): (f64, f64),
    run: &mut Run,
    progress: &Progress,
) -> Result<(), dynamics::Error> {
    let gaps = scenario.gaps();
    let (mut hit, mut touched) = (vec![false; gaps], vec![false; gaps]);
    let started = engine.counters().contact_phases;
    let mut known = started;
    let looks = ((end - begin) / LOOK) as u64;
    for look in 0..=looks {
        let until = if look == looks { end } else { begin + LOOK * look as f64 };
        // A contact phase begins at an impact: so after each the engine stops, and is asked.
        loop {
            let mut seen = None;
            engine.run(until, |impact| {
                seen = Some(impact);
                false
            })?;
            let Some(impact) = seen else { break };
            weigh(scenario, impact, run);
            hit[impact.gap] = true;
            let phases = engine.counters().contact_phases;
            if phases > known {
                known = phases;
                engine.contacts(impact.time).iter().for_each(|(gap, _)| touched[*gap] = true);
            }
            if progress.stopped() {
                return Ok(());
            }
        }
        if look < looks {
            let held = engine.contacts(until);
            held.iter().for_each(|(gap, _)| touched[*gap] = true);
            run.held += held.len() as u64;
            run.looks += 1;
        }
    }
    run.phases = known - started;
    run.distinct = count(&hit, |_| true);
    let able: Vec<bool> = (0..gaps).map(|gap| presses(scenario, gap)).collect();
    run.able = count(&able, |_| true);
    run.able_touched = count(&touched, |gap| able[gap]);
    run.others_touched = count(&touched, |gap| !able[gap]);
    Ok(())
}

fn count(marks: &[bool], of: impl Fn(usize) -> bool) -> u64 {
    marks.iter().enumerate().filter(|(gap, mark)| **mark && of(*gap)).count() as u64
}

/// Amplitudes of the force on a mass, from 1; those on a wall are zero.
fn force(scenario: &Scenario, mass: usize) -> [f64; 2] {
    let own = mass.checked_sub(1).and_then(|index| scenario.forcing.get(index));
    own.copied().unwrap_or([0.0; 2])
}

/// Whether d ω² + ΔF, the acceleration of a gap that is shut, is ever negative.
pub(super) fn presses(scenario: &Scenario, gap: usize) -> bool {
    let ([a, b], [c, d]) = (force(scenario, gap), force(scenario, gap + 1));
    let omega = scenario.natural_frequency;
    let least = scenario.spacing * omega * omega;
    (c - a) * (c - a) + (d - b) * (d - b) > least * least
}

/// Adds what an impact of two masses does to the balance of energy.
fn weigh(scenario: &Scenario, impact: Impact, run: &mut Run) {
    if impact.gap == 0 || impact.gap == scenario.forcing.len() {
        return;
    }
    let (omega, big_omega) = (scenario.natural_frequency, scenario.forcing_frequency);
    let factor = big_omega / (omega * omega - big_omega * big_omega);
    let (sin, cos) = pxfm::f_sincos(big_omega * impact.time);
    let velocity = |[a, b]: [f64; 2]| factor * (b * cos - a * sin);
    let forced = velocity(force(scenario, impact.gap)) - velocity(force(scenario, impact.gap + 1));
    run.squares += impact.closing_speed * impact.closing_speed;
    run.products += impact.closing_speed * forced;
}
