//! Starts: from a state, from places and velocities in a file, and when the force is lowered.

use crate::drawn;
use impact_chain::{Engine, Initial, Overtone, Scenario, State};
use impact_numerics::random::NormalPairs;
use impact_paper::params::{Chain, Start};

#[test]
fn the_state_at_the_start_is_that_of_the_engine() {
    for start in [Start::Rest, Start::Zero, Start::Random] {
        let scenario = drawn(&Chain { masses: 7, start, ..Chain::default() }, 0.1, "state", 0);
        let (state, engine) = (State::of(&scenario), Engine::new(&scenario).unwrap());
        let near = |a: &[f64], b: Vec<f64>| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
        assert!(near(&state.positions, engine.positions(0.0)), "{start:?}");
        assert!(near(&state.velocities, engine.velocities(0.0)), "{start:?}");
    }
}

#[test]
fn a_file_sets_positions_and_velocities() {
    let at = r#"{"positions":[0.9,2.2],"velocities":[0.5,-0.25]}"#;
    let json = format!(r#"{{"forcing":[[0.3,0.2],[-0.1,0.4]],"initial":{{"at":{at}}}}}"#);
    let engine = Engine::new(&Scenario::from_json(&json).unwrap()).unwrap();
    let found = [engine.positions(0.0), engine.velocities(0.0)];
    for (found, given) in found.iter().flatten().zip([0.9, 2.2, 0.5, -0.25]) {
        assert!((found - given).abs() < 1e-15, "{found} {given}");
    }
}

/// Displacement of mass j at time t, by Eq. (2) with ω = 1.
fn displacement(scenario: &Scenario, free: [f64; 2], j: usize, t: f64) -> f64 {
    let mut sum = free[0] * t.cos() + free[1] * t.sin();
    for (big_w, forces) in scenario.components() {
        let force = forces[j][0] * (big_w * t).cos() + forces[j][1] * (big_w * t).sin();
        sum += force / (1.0 - big_w * big_w);
    }
    sum
}

#[test]
fn positions_and_velocities_are_continuous_when_the_force_is_lowered() {
    let chain = Chain { masses: 5, ..Chain::default() };
    let mut normals = NormalPairs::new("test of history", 1, 1);
    let mut hot = Scenario::draw(&chain, 0.3, &mut normals);
    let amplitudes = (0..5).map(|_| normals.pair()).collect();
    hot.overtones = vec![Overtone { frequency: 2.3, amplitudes }];
    let free: Vec<[f64; 2]> = (0..5).map(|_| normals.pair()).collect();
    let (time, h) = (7.3, 1e-5);
    let after = hot.lowered(&free, time, 0.4);
    let Initial::Free(parts) = &after.initial else { panic!("it has free parts") };
    for j in 0..5 {
        let before = |t| displacement(&hot, free[j], j, t);
        let then = |t| displacement(&after, parts[j], j, t);
        assert!((before(time) - then(0.0)).abs() < 1e-12);
        let speeds = [before(time + h) - before(time - h), then(h) - then(-h)];
        assert!((speeds[0] - speeds[1]).abs() < 1e-9 * h.sqrt(), "{speeds:?}");
    }
}
