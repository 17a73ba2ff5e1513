//! Describes a state of the masses at any time, and the scenario that starts there.

use crate::error::{Error, check_range};
use crate::flight::response;
use crate::scenario::{Initial, Scenario};
use crate::search::clock::{Instant, LATEST, Rate};
use crate::topology::Topology;

/// Positions and velocities of the masses 1..n at a time, from which a method starts.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[must_use]
pub struct State {
    /// Time t, from 0 to 1e12.
    pub time: f64,
    /// x_1..x_n, counted from the left wall.
    pub positions: Vec<f64>,
    /// v_1..v_n.
    pub velocities: Vec<f64>,
}

/// Rate of a shut gap, over the speed of its faster side, up to which it is at rest.
pub(crate) const AT_REST: f64 = 1e-12;

/// A gap is shut up to rounding when its width is below this many roundings of its place, of a
/// displacement next to it, and of the distance it moves within the rounding of the time.
const UNITS: f64 = 16.0;

impl State {
    /// Returns the state of a scenario at t = 0.
    ///
    /// # Panics
    /// Panics if `places`, or the amplitudes of an overtone, are fewer than the scenario's bodies.
    /// [`Scenario::validate`] refuses these.
    pub fn from_scenario(scenario: &Scenario) -> State {
        let w = scenario.natural_frequency;
        let mut state = State { time: 0.0, positions: Vec::new(), velocities: Vec::new() };
        for (j, [x, v]) in response_at_zero(scenario).into_iter().enumerate() {
            let [u, v] = match &scenario.initial {
                Initial::Rest => [0.0; 2],
                Initial::Free(parts) => {
                    let [a, b] = parts.get(j).copied().unwrap_or_default();
                    [a + x, w * b + v]
                }
            };
            state.positions.push(scenario.place(j + 1) + u);
            state.velocities.push(v);
        }
        state
    }

    /// Returns the displacements of bodies from the left wall (0) to the right one (n + 1). Gaps
    /// that overlap by no more than rounding are shut exactly, and so are gaps at rest as narrow.
    pub(crate) fn displacements(&self, scenario: &Scenario) -> Result<Vec<f64>, Error> {
        scenario.validate()?;
        self.validate(scenario.forcing.len())?;
        let topology = Topology::new(scenario.forcing.len(), scenario.boundary);
        let d = scenario.spacing;
        let mut u = vec![0.0; self.positions.len() + 2];
        for (j, x) in self.positions.iter().enumerate() {
            u[j + 1] = x - scenario.place(j + 1);
        }
        for k in 0..topology.gaps() {
            let [left, right] = topology.sides(k);
            let at_rest = d + (scenario.shift(right) - scenario.shift(left));
            let width = at_rest + (u[right] - u[left]);
            let place = (k + 1) as f64 * d + u[left].abs().max(u[right].abs());
            let velocity =
                |m: usize| self.velocities.get(m.wrapping_sub(1)).copied().unwrap_or(0.0);
            let [before, after] = [left, right].map(velocity);
            let fastest = before.abs().max(after.abs());
            let rounding = UNITS * f64::EPSILON * (place.abs() + self.time * fastest);
            if width < -rounding {
                let (field, gap) = ("positions".to_string(), topology.label(k));
                return Err(Error::Overlap { field, gap, depth: -width });
            }
            if width > rounding || width >= 0.0 && (after - before).abs() > AT_REST * fastest {
                continue;
            }
            if topology.is_wall(right) {
                u[left] += width;
            } else {
                u[right] -= width;
            }
        }
        Ok(u)
    }

    fn validate(&self, n: usize) -> Result<(), Error> {
        check_range("time", self.time, 0.0, LATEST)?;
        for (field, values) in [("positions", &self.positions), ("velocities", &self.velocities)] {
            let remedy = "give one finite number for each mass";
            if values.len() != n {
                let problem = format!("it has {} values for {n} masses", values.len());
                return Err(Error::input(field, problem, remedy));
            }
            if let Some(j) = values.iter().position(|x| !x.is_finite()) {
                let problem = format!("{:?} is not finite", values[j]);
                return Err(Error::input(format!("{field}[{j}]"), problem, remedy));
            }
        }
        Ok(())
    }

    /// Returns the scenario that starts at t = 0 exactly at this state, its forcing rotated by Ωt.
    ///
    /// # Errors
    /// [`Error::Input`] for a scenario or a state outside the model, [`Error::Overlap`] for an
    /// overlapping state.
    pub fn as_scenario(&self, scenario: &Scenario) -> Result<Scenario, Error> {
        let u = self.displacements(scenario)?;
        let mut moved = scenario.clone();
        rotate_phases(&mut moved, Instant::at(self.time));
        let mut free = Vec::with_capacity(self.velocities.len());
        for (j, [x, y]) in response_at_zero(&moved).into_iter().enumerate() {
            free.push([u[j + 1] - x, (self.velocities[j] - y) / scenario.natural_frequency]);
        }
        moved.initial = Initial::Free(free);
        Ok(moved)
    }
}

/// Returns the forced response of each mass at t = 0: displacement and velocity.
fn response_at_zero(scenario: &Scenario) -> Vec<[f64; 2]> {
    let mut responses = vec![[0.0; 2]; scenario.forcing.len()];
    for (frequency, forces) in scenario.components() {
        for ([x, v], force) in responses.iter_mut().zip(forces) {
            let [c, s] = response(scenario.natural_frequency, frequency, *force);
            *x += c;
            *v += frequency * s;
        }
    }
    responses
}

/// Rotates the phases of the forcing by those at an instant, which becomes t = 0.
fn rotate_phases(scenario: &mut Scenario, instant: Instant) {
    let first = (scenario.forcing_frequency, &mut scenario.forcing);
    let further = scenario.overtones.iter_mut().map(|o| (o.frequency, &mut o.amplitudes));
    for (frequency, forces) in std::iter::once(first).chain(further) {
        let (sin, cos) = Rate::new(frequency).sin_cos(instant);
        for [alpha, beta] in forces {
            (*alpha, *beta) = (*alpha * cos + *beta * sin, *beta * cos - *alpha * sin);
        }
    }
}
