//! Prints the Poincaré section of one mass between walls, its places once a period of the force, as
//! the force grows through the first graze: one point, four, two, many.

use impact_chain::{Chain, Engine, Error, Scenario, Start};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

const FREQUENCY: f64 = 3.0;

/// Places at 80 periods after 1000, in units of 1e-5, for a force over that which grazes.
fn section(force: f64) -> Result<BTreeSet<i64>, Error> {
    // Only impacts damp the motion, so start without a free part.
    let chain = Chain {
        masses: 1,
        forcing_frequency: FREQUENCY,
        restitution: 0.5,
        start: Start::Zero,
        ..Chain::default()
    };
    // The response has the amplitude β/(Ω² − ω²), and grazes both walls where that is d.
    let beta = force * (FREQUENCY.powi(2) - 1.0);
    let mut engine = Engine::new(&Scenario::given(&chain, vec![[0.0, -beta]])?)?;
    let mut points = BTreeSet::new();
    for period in 1000..1080 {
        let time = f64::from(period) * TAU / FREQUENCY;
        engine.advance(time)?;
        points.insert((engine.state(time)?.positions[0] * 1e5).round() as i64);
    }
    Ok(points)
}

fn main() -> Result<(), Error> {
    for force in [0.99, 1.01, 1.2, 1.3, 1.4, 1.7] {
        let points = section(force)?;
        let places: Vec<f64> = points.iter().take(4).map(|x| *x as f64 / 1e5).collect();
        println!("{force} of the force that grazes: {} points, {places:?}", points.len());
    }
    Ok(())
}

#[test]
fn periods_change_as_the_force_grows() {
    assert_eq!(section(0.99).unwrap(), BTreeSet::from([100_000]));
    let points = [1.2, 1.3, 1.4].map(|force| section(force).unwrap().len());
    assert_eq!(points, [1, 4, 2]);
    assert!(section(1.7).unwrap().len() > 40);
}
