//! A run in two halves: the state in the middle, as JSON, goes on to the same impacts.

use impact_chain::{Chain, Engine, Error, NormalPairs, Scenario};

fn main() -> Result<(), Error> {
    let chain = Chain { masses: 20, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.3, &mut NormalPairs::new("restart", 1, 0));
    let mut engine = Engine::new(&scenario)?;
    engine.run(50.0, |_| true)?;
    let saved = engine.state(50.0)?.as_scenario(&scenario)?.to_json();
    let mut again = Engine::new(&Scenario::from_json(&saved)?)?;
    // Chaos enlarges the rounding of the state tenfold in a dozen units of time.
    for impact in engine.impacts(70.0)? {
        let found = again.next_impact(30.0)?.expect("the same impacts");
        let late = 50.0 + found.time - impact.time;
        println!("{:9.4}  gap {:2}  off by {late:8.1e}", impact.time, impact.gap);
        assert!(found.gap == impact.gap && late.abs() < 1e-9);
    }
    Ok(())
}

#[test]
fn both_halves_are_the_whole() {
    main().unwrap();
}
