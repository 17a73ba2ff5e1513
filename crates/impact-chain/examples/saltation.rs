//! Computes the Lyapunov exponent of an orbit with impacts: a small deviation turns in flight, and
//! an impact multiplies it by the saltation matrix.

use impact_chain::{Engine, Error, Scenario};

const ORBIT: &str = r#"{"forcing": [[-14.2, 0]], "forcing_frequency": 2.5, "restitution": 0.5,
                        "walls": [0, 100]}"#;

/// Returns the exponent of a mass that hits the left wall, for times from 2500 to 5000.
fn exponent(scenario: &Scenario) -> Result<f64, Error> {
    let (omega, r) = (scenario.forcing_frequency, scenario.restitution);
    let impacts = Engine::new(scenario)?.impacts(5000.0)?;
    let (mut x, mut v, mut sum, middle) = (0.0, 1.0, 0.0, impacts.len() / 2);
    for (k, pair) in impacts.windows(2).enumerate() {
        let (sin, cos) = (pair[1].time - pair[0].time).sin_cos();
        (x, v) = (x * cos + v * sin, v * cos - x * sin);
        let acceleration = 1.0 + scenario.forcing[0][0] * (omega * pair[1].time).cos();
        (x, v) = (-r * x, -r * v - (1.0 + r) * acceleration / pair[1].closing_speed * x);
        let growth = f64::hypot(x, v);
        (x, v) = (x / growth, v / growth);
        sum += if k < middle { 0.0 } else { growth.ln() };
    }
    Ok(sum / (impacts[impacts.len() - 1].time - impacts[middle].time))
}

fn main() -> Result<(), Error> {
    println!("largest exponent: {:.6}", exponent(&Scenario::from_json(ORBIT)?)?);
    Ok(())
}

/// The monodromy of one impact of speed v in a period T has the determinant r² and the trace
/// -2 r cos T - (1 + r) sin T ((Ω² - 1) κ + Ω²/v), with κ = (1 + r) / (2 tan(T/2)).
#[test]
fn the_exponent_is_that_of_the_monodromy_and_of_the_decay() {
    let scenario = Scenario::from_json(ORBIT).unwrap();
    let impacts = Engine::new(&scenario).unwrap().impacts(5000.0).unwrap();
    let period = std::f64::consts::TAU / 2.5;
    let slope = 5.25 * 0.75 / (0.5 * period).tan() + 6.25 / impacts[1900].closing_speed;
    let trace = -period.cos() - 1.5 * period.sin() * slope;
    let largest = 0.5 * (trace - (trace * trace - 1.0).sqrt());
    let exponent = exponent(&scenario).unwrap();
    assert!((exponent - largest.abs().ln() / period).abs() < 1e-9, "{exponent}, {largest}");
    // The orbit itself comes nearer by the same factor.
    let step = |k: usize| impacts[k + 1].closing_speed - impacts[k].closing_speed;
    assert!((step(81) / step(80) - largest).abs() < 1e-6, "{largest}");
}
