//! The forcing of a scenario, component by component, for all rivals.

use super::prelude::*;
pub use crate::scenario::COMPONENTS;

/// The forced response of each mass at t = 0: displacement and velocity.
pub fn response(scenario: &Scenario) -> Vec<[f64; 2]> {
    let mut response = vec![[0.0; 2]; scenario.forcing.len()];
    for component in Component::response(scenario) {
        for (j, [x, v]) in response.iter_mut().enumerate() {
            *x += component.cos[j + 1];
            *v += component.frequency * component.sin[j + 1];
        }
    }
    response
}

/// Rotates the phases of the forcing by those at the instant `at`, which becomes t = 0.
pub fn turn(scenario: &mut Scenario, at: Instant) {
    let first = (scenario.forcing_frequency, &mut scenario.forcing);
    let further = scenario.overtones.iter_mut().map(|o| (o.frequency, &mut o.amplitudes));
    for (big_w, amplitudes) in std::iter::once(first).chain(further) {
        let (sin, cos) = sin_cos_turn(Rate::new(big_w).turn(at));
        for [alpha, beta] in amplitudes {
            (*alpha, *beta) = (*alpha * cos + *beta * sin, *beta * cos - *alpha * sin);
        }
    }
}

/// One component with an amplitude of cos Ωt and one of sin Ωt for each body, 0 for the walls.
#[derive(Clone)]
pub struct Component {
    /// Ω.
    pub frequency: f64,
    pub rate: Rate,
    pub cos: Vec<f64>,
    pub sin: Vec<f64>,
}

impl Component {
    pub fn of(scenario: &Scenario) -> Vec<Component> {
        let padded = |pairs: &[[f64; 2]], part: usize| -> Vec<f64> {
            let amplitudes = pairs.iter().map(|pair| pair[part]);
            std::iter::once(0.0).chain(amplitudes).chain([0.0]).collect()
        };
        scenario
            .components()
            .map(|(frequency, pairs)| Component {
                frequency,
                rate: Rate::new(frequency),
                cos: padded(pairs, 0),
                sin: padded(pairs, 1),
            })
            .collect()
    }

    pub fn response(scenario: &Scenario) -> Vec<Component> {
        let mut components = Component::of(scenario);
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
        sin_cos_turn(self.rate.turn(at))
    }
}
