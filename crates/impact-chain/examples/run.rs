//! One run of ten masses: when which gap closes, and how fast.
//!
//!     cargo run --release -p impact-chain --example run

use impact_chain::{Chain, Engine, Error, Scenario};
use impact_numerics::random::NormalPairs;

fn main() -> Result<(), Error> {
    // Everything that is not said is as in the paper: walls, r = 0.8, Ω = √2, at rest at t = 0.
    let chain = Chain { masses: 10, ..Chain::default() };
    // The amplitudes α_j, β_j of the forcing: normal, with standard deviation σ = 0.3.
    let mut normals = NormalPairs::new("run", 2007, 0);
    let scenario = Scenario::draw(&chain, 0.3, &mut normals);

    let mut engine = Engine::new(&scenario)?;
    println!("    time  gap  closing speed");
    engine.run(30.0, |impact| {
        println!("{:8.4}  {:3}  {:.4}", impact.time, impact.gap, impact.closing_speed);
        true
    })?;

    let positions: Vec<String> = engine.positions(30.0).iter().map(|x| format!("{x:.3}")).collect();
    println!("positions at t = 30: {}", positions.join(" "));
    let counted = engine.counters();
    println!("{} impacts took {} searches", counted.impacts, counted.searches);
    Ok(())
}
