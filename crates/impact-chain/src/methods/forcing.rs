//! Holds the forcing of a chain, or its response, component by component.

use crate::Scenario;
use crate::flight::response;
use crate::scenario::COMPONENTS;
use crate::search::clock::{Instant, Rate};

/// One component with an amplitude of cos Ωt and one of sin Ωt for each body, 0 for the walls.
pub struct Component {
    pub frequency: f64,
    pub rate: Rate,
    pub cos: Vec<f64>,
    pub sin: Vec<f64>,
}

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
pub type Phases = [(f64, f64); COMPONENTS];

pub fn phases(components: &[Component], instant: Instant) -> Phases {
    let mut phases = [(0.0, 1.0); COMPONENTS];
    for (phase, component) in phases.iter_mut().zip(components) {
        *phase = component.rate.sin_cos(instant);
    }
    phases
}
