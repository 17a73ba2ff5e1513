//! Prints the first impact as the amplitude of a response passes the one that grazes the wall: its
//! speed grows as the square root of the excess, so its slope is infinite at grazing.

use impact_chain::{Engine, Error, Impact, Scenario};
use std::f64::consts::TAU;

/// Returns the first impact in a period, for the amplitude 1 + `excess` before a wall at 1.
fn first_impact(excess: f64) -> Result<Option<Impact>, Error> {
    let force = (1.0 + excess) * (1.0 - 1.5 * 1.5);
    let scenario = Scenario::from_json(&format!(
        r#"{{"forcing": [[{force}, 0]], "forcing_frequency": 1.5, "walls": [0, 100], "initial": "zero"}}"#
    ))?;
    Engine::new(&scenario)?.next_impact(TAU / 1.5)
}

fn main() -> Result<(), Error> {
    for excess in [-1e-4, 1e-10, 1e-8, 1e-6, 1e-4] {
        println!("excess {excess:.0e}: {:?}", first_impact(excess)?);
    }
    Ok(())
}

/// A cos Ωt = -1 at cos Ωt = -1/A, with speed Ω √(A² - 1).
#[test]
fn the_speed_is_a_square_root() {
    for exponent in 1..=10 {
        let excess = 0.1_f64.powi(exponent);
        let impact = first_impact(excess).unwrap().unwrap();
        let rounding = 1e-15 / excess; // of A, in the excess
        let speed = 1.5 * (excess * (2.0 + excess)).sqrt();
        let time = (-1.0 / (1.0 + excess)).acos() / 1.5;
        assert!((impact.closing_speed / speed - 1.0).abs() < rounding, "{excess}: {impact:?}");
        assert!((impact.time - time).abs() < rounding * excess.sqrt(), "{excess}: {impact:?}");
        assert_eq!(first_impact(-excess), Ok(None));
    }
}
