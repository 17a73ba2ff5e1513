//! Evaluates the forcing of a scenario and its response, component by component.

use crate::Scenario;
use crate::flight::response;
use crate::search::clock::{Instant, Rate};
#[cfg(any(feature = "ensembles", feature = "methods"))]
use crate::topology::Topology;

/// Returns the forced response of each mass at t = 0: displacement and velocity.
pub fn response_at_zero(scenario: &Scenario) -> Vec<[f64; 2]> {
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
pub fn rotate_phases(scenario: &mut Scenario, instant: Instant) {
    let first = (scenario.forcing_frequency, &mut scenario.forcing);
    let further = scenario.overtones.iter_mut().map(|o| (o.frequency, &mut o.amplitudes));
    for (frequency, forces) in std::iter::once(first).chain(further) {
        let (sin, cos) = Rate::new(frequency).sin_cos(instant);
        for [alpha, beta] in forces {
            (*alpha, *beta) = (*alpha * cos + *beta * sin, *beta * cos - *alpha * sin);
        }
    }
}

/// One component with an amplitude of cos Ωt and one of sin Ωt for each body, 0 for the walls.
#[cfg(feature = "methods")]
pub struct Component {
    pub frequency: f64,
    pub rate: Rate,
    pub cos: Vec<f64>,
    pub sin: Vec<f64>,
}

#[cfg(feature = "methods")]
impl Component {
    pub fn forces(scenario: &Scenario) -> Vec<Component> {
        Component::list(scenario, |_, force| force)
    }

    pub fn responses(scenario: &Scenario) -> Vec<Component> {
        let w = scenario.natural_frequency;
        Component::list(scenario, |big_w, force| response(w, big_w, force))
    }

    /// Lists the components, with amplitudes that `transform` computes from frequency and force.
    fn list(scenario: &Scenario, transform: impl Fn(f64, [f64; 2]) -> [f64; 2]) -> Vec<Component> {
        let component = |(frequency, pairs): (f64, &[[f64; 2]])| {
            let walled = |i: usize| {
                let masses = pairs.iter().map(|pair| transform(frequency, *pair)[i]);
                std::iter::once(0.0).chain(masses).chain([0.0]).collect()
            };
            let rate = Rate::new(frequency);
            Component { frequency, rate, cos: walled(0), sin: walled(1) }
        };
        scenario.components().map(component).collect()
    }
}

/// (sin, cos) of the phase of each component of the forcing.
#[cfg(feature = "methods")]
pub type Phases = [(f64, f64); crate::scenario::COMPONENTS];

#[cfg(feature = "methods")]
pub fn phases(components: &[Component], instant: Instant) -> Phases {
    let mut phases = [(0.0, 1.0); crate::scenario::COMPONENTS];
    for (phase, component) in phases.iter_mut().zip(components) {
        *phase = component.rate.sin_cos(instant);
    }
    phases
}

/// Returns the amplitudes of cos ωt, sin ωt, cos Ωt and sin Ωt of each gap, in units of d.
#[cfg(any(feature = "ensembles", feature = "methods"))]
pub fn gap_amplitudes(scenario: &Scenario) -> Vec<[f64; 4]> {
    let topology = Topology::new(scenario.forcing.len(), scenario.boundary);
    let mut bodies = vec![[0.0; 4]; scenario.forcing.len() + 2];
    for (j, forces) in scenario.forcing.iter().enumerate() {
        let [a, b] = scenario.free_part(j);
        let [c, d] = response(scenario.natural_frequency, scenario.forcing_frequency, *forces);
        bodies[j + 1] = [a, b, c, d];
    }
    let gap = |gap| {
        let [left, right] = topology.sides(gap).map(|body| bodies[body]);
        std::array::from_fn(|i| (right[i] - left[i]) / scenario.spacing)
    };
    (0..topology.gaps()).map(gap).collect()
}
