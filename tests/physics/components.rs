//! Forcing of several components, Eq. (3), against the reference; and invalid ones, which are refused.

use crate::reference::Real;
use crate::trace;
use crate::traces::held;
use impact_chain::{Engine, Overtone, Scenario};
use impact_numerics::random::NormalPairs;
use impact_paper::params::{Boundary, Chain, Start};

/// A chain whose components share the mean square displacement that σ = `sigma` gives.
pub fn drawn(chain: &Chain, sigma: f64, frequencies: &[f64], index: u64) -> Scenario {
    let mut normals = NormalPairs::new("components", 1, index);
    let mut scenario = Scenario::draw(chain, sigma, &mut normals);
    let w = scenario.natural_frequency;
    let share = sigma / (frequencies.len() as f64).sqrt();
    let mut component = |frequency: f64| -> Vec<[f64; 2]> {
        let size = share * (w * w - frequency * frequency).abs();
        (0..chain.masses).map(|_| normals.pair().map(|x| size * x)).collect()
    };
    scenario.forcing_frequency = frequencies[0];
    scenario.forcing = component(frequencies[0]);
    scenario.overtones = frequencies[1..]
        .iter()
        .map(|&frequency| Overtone { frequency, amplitudes: component(frequency) })
        .collect();
    scenario
}

/// Eight incommensurable frequencies on both sides of ω = 1.
pub const EIGHT: [f64; 8] = [std::f64::consts::SQRT_2, 0.3, 0.618, 0.9, 1.17, 2.23, 3.7, 5.1];

#[test]
fn two_and_eight_components_have_the_impacts_of_the_reference() {
    let chain = |masses| Chain { masses, ..Chain::default() };
    let cases = [
        (chain(12), 0.3, &EIGHT[..2], 60.0),
        (chain(5), 0.3, &EIGHT[..], 30.0),
        (Chain { start: Start::Zero, ..chain(4) }, 0.35, &EIGHT[..], 30.0),
        (Chain { boundary: Boundary::Ring, restitution: 0.3, ..chain(8) }, 0.5, &EIGHT[1..4], 60.0),
        (Chain { natural_frequency: 1.3, spacing: 2.0, ..chain(6) }, 1.0, &[0.7, 2.9], 40.0),
    ];
    let mut early = 0;
    for (i, (chain, sigma, frequencies, until)) in cases.into_iter().enumerate() {
        // The first that starts without overlap and is not too quiet.
        let busy = |scenario: &Scenario| {
            Engine::new(scenario).is_ok() && trace(scenario, until).len() > 30
        };
        let mut draws = (0..50).map(|index| drawn(&chain, sigma, frequencies, index));
        let theirs = held(&draws.find(busy).unwrap(), until, &format!("case {i}"));
        early += theirs.iter().filter(|hit| hit.time.near() < 4.0).count();
    }
    assert!(early > 10, "{early}");
}
