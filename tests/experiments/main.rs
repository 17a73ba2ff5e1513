//! Tests what the experiments make of engine and theory: ensembles, scenes, saved motions, and the
//! numbers of the theory.

mod ensembles;
mod judge;
#[path = "../../crates/impact-chain/tests/physics/reference/mod.rs"]
mod reference;
mod scenes;
mod segments;
mod theory;

use impact_chain::{Engine, Impact, Scenario};

fn trace(scenario: &Scenario, until: f64) -> Vec<Impact> {
    Engine::new(scenario).unwrap().impacts(until).unwrap()
}
