//! Computes the largest Lyapunov exponent of a chain: a second chain starts close by, and is
//! brought back to that distance after each step.

use impact_chain::{Chain, Engine, Error, NormalPairs, Scenario, State};

const DISTANCE: f64 = 1e-8;

fn exponent(scenario: &Scenario, steps: u32, step: f64) -> Result<f64, Error> {
    let mut start = Engine::new(scenario)?;
    start.advance(100.0)?;
    let mut state = start.state(100.0)?;
    let mut other = state.clone();
    other.velocities[0] += DISTANCE;
    let mut sum = 0.0;
    for _ in 0..steps {
        let ends = [&state, &other].map(|state| -> Result<State, Error> {
            let mut engine = Engine::from_state(scenario, state)?;
            engine.advance(state.time + step)?;
            engine.state(state.time + step)
        });
        [state, other] = [ends[0].clone()?, ends[1].clone()?];
        let apart =
            |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum() };
        let squares =
            apart(&state.positions, &other.positions) + apart(&state.velocities, &other.velocities);
        let growth = squares.sqrt() / DISTANCE;
        sum += growth.ln();
        for (a, b) in
            [(&state.positions, &mut other.positions), (&state.velocities, &mut other.velocities)]
        {
            b.iter_mut().zip(a).for_each(|(b, a)| *b = a + (*b - a) / growth);
        }
    }
    Ok(sum / (f64::from(steps) * step))
}

fn main() -> Result<(), Error> {
    let chain = Chain { masses: 10, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.3, &mut NormalPairs::new("lyapunov", 1, 0));
    let exponent = exponent(&scenario, 400, 1.0)?;
    println!("largest exponent: {exponent:.3} per unit of time");
    assert!((0.05..0.5).contains(&exponent));
    Ok(())
}

#[test]
fn errors_grow() {
    main().unwrap();
}
