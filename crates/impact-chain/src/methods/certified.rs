//! Runs the engine of this project under the trait of its rivals.

use super::method::{Cost, Method, Task};
use super::steps::check_end;
use crate::topology::Topology;
use crate::{Engine, Error, Graze, Impact, Scenario, Sink, State};

/// The exact event-driven engine: flight in closed form, the first root of each gap certified.
///
/// - Source: this project, [`crate::Engine`].
/// - Order: none, it has no step. The time of an impact is off by a few roundings of the gap over
///   its speed.
/// - Fails: nowhere within the model; a run that needs more events than its bound is an error.
#[derive(Clone, Copy, Debug, Default)]
pub struct Certified;

/// Closing speed, in units of d ω, up to which rounding of a start explains it.
const AT_REST: f64 = 1e-12;

impl Method for Certified {
    fn name(&self) -> &'static str {
        "certified"
    }

    fn run(&self, (scenario, start, until): Task, sink: Sink) -> Result<Cost, Error> {
        check_end(until)?;
        let mut cost = Cost::default();
        let same = *start == State::of(scenario);
        let moved = if same { None } else { Some(start.as_scenario(scenario)?) };
        let mut engine = Engine::new(moved.as_ref().unwrap_or(scenario))?;
        let resting = if same { Vec::new() } else { resting(scenario, start) };
        let speed = AT_REST * scenario.spacing * scenario.natural_frequency;
        engine
            .run(until - start.time, |impact| {
                if impact.closing_speed <= speed && resting.contains(&impact.gap) {
                    return true;
                }
                cost.impacts += 1;
                sink(Impact { time: start.time + impact.time, ..impact })
            })
            .map_err(|error| match error {
                Error::Work { gap, time, bound } => {
                    Error::Work { gap, time: start.time + time, bound }
                }
                other => other,
            })?;
        let counters = engine.counters();
        Ok(Cost {
            steps: counters.searches,
            evaluations: counters.evaluations,
            simultaneous: counters.simultaneous,
            undecided: counters.undecided,
            first_graze: engine
                .first_graze()
                .map(|graze| Graze { time: start.time + graze.time, ..graze }),
            ..cost
        })
    }
}

/// Finds the gaps that are shut and at rest up to rounding: in contact, or hit with r = 0. Rounding
/// may close them again at once, which is no impact.
fn resting(scenario: &Scenario, start: &State) -> Vec<usize> {
    let topology = Topology::new(scenario.forcing.len(), scenario.boundary);
    let d = scenario.spacing;
    let motion = |m: usize| {
        if topology.is_wall(m) {
            return [0.0; 2];
        }
        [start.positions[m - 1] - m as f64 * d, start.velocities[m - 1]]
    };
    let mut resting = Vec::new();
    for k in 0..topology.gaps() {
        let [left, right] = topology.sides(k).map(motion);
        let (width, rate) = (d + (right[0] - left[0]), right[1] - left[1]);
        let place = (k + 1) as f64 * d + left[0].abs().max(right[0].abs());
        let speed = left[1].abs().max(right[1].abs());
        if width.abs() <= start.rounding(place, speed)
            && rate.abs() <= AT_REST * d * scenario.natural_frequency
        {
            resting.push(topology.label(k));
        }
    }
    resting
}
