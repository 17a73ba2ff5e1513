//! A state of the masses at any time, and the scenario that starts there.

use super::forcing;
use super::prelude::*;
use crate::scenario::within;

/// Positions and velocities of the masses 1..n at a time, from which a method starts.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Time t, from 0 to 1e12.
    pub time: f64,
    /// x_1..x_n, counted from the left wall.
    pub positions: Vec<f64>,
    /// Their rates.
    pub velocities: Vec<f64>,
}

/// A gap is shut up to rounding when its width is below this many roundings of its place, of a
/// displacement next to it, and of the distance it moves within the rounding of the time.
const UNITS: f64 = 16.0;

impl State {
    /// The start of a scenario, at t = 0.
    pub fn of(scenario: &Scenario) -> State {
        let w = scenario.natural_frequency;
        let mut state = State { time: 0.0, positions: Vec::new(), velocities: Vec::new() };
        for (j, [x, v]) in forcing::response(scenario).into_iter().enumerate() {
            let [u, v] = match &scenario.initial {
                Initial::Rest => [0.0; 2],
                Initial::Free(parts) => {
                    let [a, b] = parts.get(j).copied().unwrap_or_default();
                    [a + x, w * b + v]
                }
            };
            state.positions.push((j + 1) as f64 * scenario.spacing + u);
            state.velocities.push(v);
        }
        state
    }

    /// The displacements of all bodies from their places j d, from the left wall (0) to the right
    /// one (n + 1), with gaps that overlap by no more than rounding shut exactly.
    pub(super) fn displacements(&self, scenario: &Scenario) -> Result<Vec<f64>, Error> {
        scenario.validate()?;
        self.validate(scenario.forcing.len())?;
        let topology = Topology::new(scenario.forcing.len(), scenario.boundary);
        let d = scenario.spacing;
        let mut u = vec![0.0; self.positions.len() + 2];
        for (j, x) in self.positions.iter().enumerate() {
            u[j + 1] = x - (j + 1) as f64 * d;
        }
        for k in 0..topology.gaps() {
            let [left, right] = topology.sides(k);
            let width = d + (u[right] - u[left]);
            if width >= 0.0 {
                continue;
            }
            let place = (k + 1) as f64 * d + u[left].abs().max(u[right].abs());
            let speed = |m: usize| self.velocities.get(m.wrapping_sub(1)).map_or(0.0, |v| v.abs());
            if width < -self.rounding(place, speed(left).max(speed(right))) {
                return Err(Error::Overlap { gap: topology.label(k), depth: -width });
            }
            if topology.is_wall(right) {
                u[left] += width;
            } else {
                u[right] -= width;
            }
        }
        Ok(u)
    }

    /// How wide a gap from the place `place` on may be by rounding of this state, `speed` being that
    /// of the faster of its sides.
    pub(super) fn rounding(&self, place: f64, speed: f64) -> f64 {
        UNITS * f64::EPSILON * (place.abs() + self.time * speed)
    }

    fn validate(&self, n: usize) -> Result<(), Error> {
        within("start.time", self.time, 0.0, LATEST)?;
        for (field, values) in [("positions", &self.positions), ("velocities", &self.velocities)] {
            if values.len() != n || values.iter().any(|x| !x.is_finite()) {
                let problem = format!("{} values for {n} masses", values.len());
                let remedy = "give one finite number for each mass";
                return Err(Error::input(format!("start.{field}"), problem, remedy));
            }
        }
        Ok(())
    }

    /// The scenario that starts at t = 0 exactly where this state is: the forcing rotated by Ωt,
    /// the free parts derived.
    pub fn as_scenario(&self, scenario: &Scenario) -> Result<Scenario, Error> {
        let u = self.displacements(scenario)?;
        let mut moved = scenario.clone();
        forcing::turn(&mut moved, Instant::at(self.time));
        let forced = forcing::response(&moved);
        let parts = u[1..].iter().zip(&self.velocities).zip(forced);
        let free = parts.map(|((u, v), [x, y])| [u - x, (v - y) / scenario.natural_frequency]);
        let free = free.collect();
        moved.initial = Initial::Free(free);
        Ok(moved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Engine;
    use crate::{Chain, Start};
    use impact_numerics::random::NormalPairs;

    fn drawn(start: Start) -> Scenario {
        let chain = Chain { masses: 7, start, ..Chain::default() };
        Scenario::draw(&chain, 0.1, &mut NormalPairs::new("state", 1, 0))
    }

    #[test]
    fn a_start_is_what_the_engine_has() {
        for start in [Start::Rest, Start::Zero, Start::Random] {
            let scenario = drawn(start);
            let (state, engine) = (State::of(&scenario), Engine::new(&scenario).unwrap());
            let near = |a: &[f64], b: Vec<f64>| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
            assert!(near(&state.positions, engine.positions(0.0)), "{start:?}");
            assert!(near(&state.velocities, engine.velocities(0.0)), "{start:?}");
        }
    }
}
