//! Prints the bifurcation diagram of an impact oscillator: one mass before a wall, its places once
//! a period of the force. As the response shrinks, the orbit with one impact in a period doubles.

use impact_chain::{Engine, Error, Scenario};
use std::f64::consts::TAU;

const OMEGA: f64 = 2.5;
const R: f64 = 0.5;

/// Returns the places at 30 periods after 2000, for a response of this amplitude.
fn samples(amplitude: f64) -> Result<Vec<f64>, Error> {
    let force = amplitude * (1.0 - OMEGA * OMEGA);
    let scenario = Scenario::from_json(&format!(
        r#"{{"forcing": [[{force}, 0]], "forcing_frequency": {OMEGA}, "restitution": {R},
             "walls": [0, 100], "initial": "zero"}}"#
    ))?;
    let (mut engine, period) = (Engine::new(&scenario)?, TAU / OMEGA);
    let place = |time| Ok(engine.advance(time).and(engine.state(time))?.positions[0]);
    (2000..2030).map(|k| f64::from(k) * period).map(place).collect()
}

fn main() -> Result<(), Error> {
    for amplitude in (11..40).rev().map(|tenths| f64::from(tenths) / 10.0) {
        println!("{amplitude} {:.4?}", samples(amplitude)?);
    }
    Ok(())
}

/// Shaw and Holmes (1983): with one impact of speed v in a period T, (1 + κ v)² + (ν v)² = A²,
/// κ = (1 + r) / (2 tan(T/2)), ν = (1 - r) / 2Ω. It doubles where the monodromy has the trace
/// -2 r cos T - (1 + r) sin T ((Ω² - 1) κ + Ω²/v) = -(1 + r²).
#[test]
fn one_place_is_as_in_closed_form_until_there_are_two() {
    let (sin, cos) = (TAU / OMEGA).sin_cos();
    let (kappa, nu) = (0.5 * (1.0 + R) * (1.0 + cos) / sin, 0.5 * (1.0 - R) / OMEGA);
    let (squares, turn) = (kappa * kappa + nu * nu, (1.0 + R) * sin);
    let fast = 1.0 + R * R - 2.0 * R * cos - turn * (OMEGA * OMEGA - 1.0) * kappa;
    let speed = turn * OMEGA * OMEGA / fast;
    let doubling = (1.0 + kappa * speed).hypot(nu * speed);
    for share in [1.5, 1.1, 1.04, 1.02, 0.98, 0.96, 0.9] {
        let amplitude: f64 = share * doubling;
        let speed = ((amplitude * amplitude * squares - nu * nu).sqrt() - kappa) / squares;
        let (sin, cos) = ((TAU - (nu * speed).atan2(-1.0 - kappa * speed)) / OMEGA).sin_cos();
        let place = 1.0 + amplitude + speed * (kappa * cos + 0.5 * (1.0 + R) * sin);
        let samples = samples(amplitude).unwrap();
        let is_one = samples.iter().all(|sample| (sample - place).abs() < 1e-10);
        assert_eq!(is_one, share > 1.0, "{share}: {samples:?}");
    }
}
