//! Balance of energy: the work of the force less the loss in impacts is the change of energy.

use impact_chain::{Chain, Engine, Error, NormalPairs, Scenario, State};

fn energy(state: &State, scenario: &Scenario) -> f64 {
    let mut sum = 0.0;
    for (j, (x, v)) in state.positions.iter().zip(&state.velocities).enumerate() {
        sum += 0.5 * (v * v + (x - scenario.place(j + 1)).powi(2));
    }
    sum
}

fn power(state: &State, scenario: &Scenario) -> f64 {
    let (sin, cos) = (scenario.forcing_frequency * state.time).sin_cos();
    scenario.forcing.iter().zip(&state.velocities).map(|([a, b], v)| (a * cos + b * sin) * v).sum()
}

/// Change of energy, work, and loss in impacts: of v²/2 at a wall, of v²/4 between masses.
fn balance(scenario: &Scenario, until: f64) -> Result<[f64; 3], Error> {
    const STEP: f64 = 1e-4;
    let mut engine = Engine::new(scenario)?;
    let lost = 1.0 - scenario.restitution.powi(2);
    let (mut work, mut loss, mut before) = (0.0, 0.0, State::of(scenario));
    for time in (1..=(until / STEP) as u32).map(|step| f64::from(step) * STEP) {
        while let Some(impact) = engine.next_impact(time)? {
            let share = if [0, scenario.forcing.len()].contains(&impact.gap) { 0.5 } else { 0.25 };
            loss += share * lost * impact.closing_speed.powi(2);
        }
        let after = engine.state(time)?;
        work += 0.5 * STEP * (power(&before, scenario) + power(&after, scenario));
        before = after;
    }
    Ok([energy(&before, scenario) - energy(&State::of(scenario), scenario), work, loss])
}

fn main() -> Result<(), Error> {
    let chain = Chain { masses: 10, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.3, &mut NormalPairs::new("energy", 1, 0));
    let [change, work, loss] = balance(&scenario, 50.0)?;
    println!("change {change:.4}, work {work:.4}, loss {loss:.4}");
    assert!((change + loss - work).abs() < 1e-2);
    Ok(())
}

#[test]
fn energy_is_work_less_loss() {
    main().unwrap();
}
