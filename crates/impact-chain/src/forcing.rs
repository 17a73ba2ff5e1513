//! Evaluates the forcing of a scenario and its response, component by component.

use crate::Scenario;
use crate::search::clock::{Instant, Rate};

/// Returns the forced response of each mass at t = 0: displacement and velocity.
pub fn response_at_zero(scenario: &Scenario) -> Vec<[f64; 2]> {
    let mut response = vec![[0.0; 2]; scenario.forcing.len()];
    for component in Component::responses(scenario) {
        for (j, [x, v]) in response.iter_mut().enumerate() {
            *x += component.cos[j + 1];
            *v += component.frequency * component.sin[j + 1];
        }
    }
    response
}

/// Rotates the phases of the forcing by those at the instant `at`, which becomes t = 0.
pub fn rotate_phases(scenario: &mut Scenario, at: Instant) {
    let forces = Component::forces(scenario);
    let further = scenario.overtones.iter_mut().map(|overtone| &mut overtone.amplitudes);
    let amplitudes = std::iter::once(&mut scenario.forcing).chain(further);
    for (component, amplitudes) in forces.iter().zip(amplitudes) {
        let (sin, cos) = component.phase(at);
        for [alpha, beta] in amplitudes {
            (*alpha, *beta) = (*alpha * cos + *beta * sin, *beta * cos - *alpha * sin);
        }
    }
}

/// One component with an amplitude of cos Ωt and one of sin Ωt for each body, 0 for the walls.
#[derive(Clone)]
pub struct Component {
    pub frequency: f64,
    pub rate: Rate,
    pub cos: Vec<f64>,
    pub sin: Vec<f64>,
}

impl Component {
    pub fn forces(scenario: &Scenario) -> Vec<Component> {
        let mut components = Vec::new();
        for (frequency, pairs) in scenario.components() {
            components.push(Component {
                frequency,
                rate: Rate::new(frequency),
                cos: between_walls(pairs.iter().map(|pair| pair[0])),
                sin: between_walls(pairs.iter().map(|pair| pair[1])),
            });
        }
        components
    }

    /// Lists the components of the forced response: the forces over ω² − Ω².
    pub fn responses(scenario: &Scenario) -> Vec<Component> {
        let mut components = Component::forces(scenario);
        for component in &mut components {
            let (w, big_w) = (scenario.natural_frequency, component.frequency);
            let factor = (w - big_w) * (w + big_w);
            for amplitude in component.cos.iter_mut().chain(&mut component.sin) {
                *amplitude /= factor;
            }
        }
        components
    }

    #[inline]
    pub fn phase(&self, at: Instant) -> (f64, f64) {
        self.rate.sin_cos(at)
    }
}

/// Puts a zero for each wall around the numbers of the masses.
fn between_walls(masses: impl Iterator<Item = f64>) -> Vec<f64> {
    std::iter::once(0.0).chain(masses).chain([0.0]).collect()
}
