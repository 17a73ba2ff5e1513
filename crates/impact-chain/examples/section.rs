//! Prints the Poincaré section of one mass between walls: its state once a period of the force, as
//! the force grows through the first graze.

use impact_chain::{Chain, Engine, Error, Scenario, Start};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// Positions at 40 periods after 400, to six digits.
fn section(amplitude: f64) -> Result<BTreeSet<i64>, Error> {
    // Only impacts damp the motion, so start without a free part.
    let start = Start::Zero;
    let chain = Chain { masses: 1, forcing_frequency: 2.0, start, ..Chain::default() };
    // The response is amplitude/3 sin 2t: it grazes both walls at amplitude 3.
    let mut engine = Engine::new(&Scenario::given(&chain, vec![[0.0, -amplitude]])?)?;
    let mut points = BTreeSet::new();
    for period in 400..440 {
        let time = f64::from(period) * TAU / 2.0;
        engine.run(time, |_| true)?;
        points.insert((engine.state(time)?.positions[0] * 1e6).round() as i64);
    }
    Ok(points)
}

fn main() -> Result<(), Error> {
    for amplitude in [2.9, 2.99, 3.01, 3.1, 3.5, 4.0] {
        let points = section(amplitude)?;
        println!("amplitude {amplitude}: {} points, {:?}", points.len(), points.first());
    }
    Ok(())
}

#[test]
fn below_the_graze_the_section_is_one_point() {
    assert_eq!(section(2.99).unwrap(), BTreeSet::from([1_000_000]));
    assert!(section(3.1).unwrap().iter().all(|x| *x != 1_000_000));
    main().unwrap();
}
