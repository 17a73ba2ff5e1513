//! Tests the engine: by a second simulator, by laws of any arithmetic, and by mechanics.

mod abreast;
mod certified;
mod contact;
mod invariants;
mod methods;
mod reference;
mod starts;
mod traces;
mod windows;

use impact_chain::{Chain, Engine, Impact, Initial, Scenario};
use impact_numerics::random::{NormalPairs, Seed};

fn drawn(chain: &Chain, sigma: f64, stream: &str, index: u64) -> Scenario {
    Scenario::draw(chain, sigma, &mut NormalPairs::new(stream, Seed(1), index))
}

/// A chain of the paper's parameters with given free parts and forcing.
fn given(free: Vec<[f64; 2]>, forcing: Vec<[f64; 2]>) -> Scenario {
    let initial = Initial::Free(free);
    Scenario { initial, forcing, ..drawn(&Chain::default(), 0.0, "given", 0) }
}

/// A chain without forcing, from given free parts.
fn unforced(free: &[[f64; 2]], restitution: f64) -> Scenario {
    Scenario { restitution, ..given(free.to_vec(), vec![[0.0; 2]; free.len()]) }
}

fn ran(scenario: &Scenario, until: f64) -> (Engine, Vec<Impact>) {
    let mut engine = Engine::new(scenario).unwrap();
    let impacts = engine.impacts(until).unwrap();
    (engine, impacts)
}

fn trace(scenario: &Scenario, until: f64) -> Vec<Impact> {
    ran(scenario, until).1
}
