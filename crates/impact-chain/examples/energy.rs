//! Balance of energy: the work of the force less the loss in impacts is the change of energy.

use impact_chain::{Chain, Engine, Error, NormalPairs, Scenario, State};

const STEP: f64 = 1e-4;

fn energy(state: &State, scenario: &Scenario) -> f64 {
    let one =
        |(j, (x, v)): (usize, (&f64, &f64))| 0.5 * (v * v + (x - scenario.place(j + 1)).powi(2));
    state.positions.iter().zip(&state.velocities).enumerate().map(one).sum()
}

fn power(state: &State, scenario: &Scenario) -> f64 {
    let (sin, cos) = (scenario.forcing_frequency * state.time).sin_cos();
    scenario.forcing.iter().zip(&state.velocities).map(|([a, b], v)| (a * cos + b * sin) * v).sum()
}

/// Change of energy, work, loss.
fn balance(scenario: &Scenario, until: f64) -> Result<[f64; 3], Error> {
    let mut engine = Engine::new(scenario)?;
    let (mut work, mut loss) = (0.0, 0.0);
    let mut before = engine.state(0.0)?;
    for step in 1..=(until / STEP) as u32 {
        let time = f64::from(step) * STEP;
        engine.run(time, |impact| {
            // Of v²/2 at a wall, of v²/4 between masses.
            let share = if [0, scenario.forcing.len()].contains(&impact.gap) { 0.5 } else { 0.25 };
            loss += share * (1.0 - scenario.restitution.powi(2)) * impact.closing_speed.powi(2);
            true
        })?;
        let state = engine.state(time)?;
        work += 0.5 * STEP * (power(&before, scenario) + power(&state, scenario));
        before = state;
    }
    let first = energy(&State::of(scenario), scenario);
    Ok([energy(&before, scenario) - first, work, loss])
}

fn main() -> Result<(), Error> {
    let chain = Chain { masses: 10, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.3, &mut NormalPairs::new("energy", 1, 0));
    let [change, work, loss] = balance(&scenario, 50.0)?;
    println!("change {change:.4}, work {work:.4}, loss {loss:.4}");
    assert!((change - (work - loss)).abs() < 1e-2);
    Ok(())
}

#[test]
fn energy_is_work_less_loss() {
    main().unwrap();
}
