//! The true impacts of a scenario, for `benches/peers`: computed with 106 bits by the simulator of
//! the tests, which shares no code with the engine.
//!
//! `cargo run --release -p impact-bench --bin reference -- SCENARIO.json UNTIL` prints
//! {"impacts": [[t, gap], …], "segments": [{"t", "u", "v", "next_t", "next_gap"}, …]}.
//! A segment starts right after an impact: displacements u from equilibrium and velocities v of all
//! masses, rounded to doubles, and the impact that follows. There are at most a thousand, evenly
//! spaced.

#[path = "../crates/impact-chain/tests/physics/reference/mod.rs"]
mod reference;

use impact_chain::Scenario;
use reference::{Dd, Reference};
use serde_json::json;

/// More segments than this add nothing.
const SEGMENTS: usize = 1000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, until] = &arguments[..] else {
        return Err("usage: reference SCENARIO.json UNTIL".into());
    };
    let scenario = Scenario::from_json(&std::fs::read_to_string(file)?)?;
    let until = Dd::from(until.parse::<f64>()?);
    let mut chain = Reference::new(&scenario);
    let (mut impacts, mut states) = (Vec::new(), Vec::new());
    while let Some(hit) = chain.step(until)? {
        impacts.push((hit.time.hi, hit.gap));
        states.push(chain.state(hit.time));
    }
    let stride = impacts.len().div_ceil(SEGMENTS).max(1);
    let segments: Vec<_> = impacts
        .windows(2)
        .zip(&states)
        .step_by(stride)
        .map(|(pair, state)| {
            let part = |i: usize| state.iter().map(|x| x[i].hi).collect::<Vec<f64>>();
            json!({"t": pair[0].0, "u": part(0), "v": part(1),
                   "next_t": pair[1].0, "next_gap": pair[1].1})
        })
        .collect();
    println!("{}", json!({"impacts": impacts, "segments": segments}));
    Ok(())
}
