//! Searches next to resonance, which must end soon. Grazing and contact are in the scenes of the experiment `trials`.

use crate::{first, given};
use impact_chain::{Engine, Initial, Overtone, Scenario};
use impact_paper::params::Chain;

/// Next to resonance amplitudes are ten million times a gap that hardly moves: the certified steps must follow the gap
/// and not the amplitudes.
#[test]
fn next_to_resonance_a_gap_that_hardly_moves_is_soon_passed() {
    for (k, scale) in [(1.0, 1.65e-7), (2.0, 1.6e-7), (16.0, 1.1e-7), (64.0, 1.6e-7)] {
        let forcing =
            [[0.3, 0.2], [-0.25, 0.1], [0.1, -0.3]].map(|x| x.map(|x| x * scale * k / 8.0));
        let forcing_frequency = 1.0 + k * f64::EPSILON;
        let chain = Chain { masses: 3, forcing_frequency, ..Chain::default() };
        let mut engine = Engine::new(&Scenario::given(&chain, forcing.to_vec()).unwrap()).unwrap();
        engine.run(30.0, |_| true).unwrap();
        let counters = engine.counters();
        println!("k = {k}: {counters:?}");
        assert!(counters.impacts == 0 && counters.evaluations < 2_000_000, "k = {k}: {counters:?}");
    }
}

/// Two components of one frequency next to resonance nearly cancel for a hundred thousand periods: a leap that fails is
/// made shorter. Their sum as one component is hit at the same time.
#[test]
fn components_that_nearly_cancel_are_soon_passed() {
    let frequency = 1.0 - 2.0_f64.powi(-40);
    let from_rest = |forcing| {
        let base = given(vec![[0.0; 2]], vec![forcing]);
        let (initial, restitution) = (Initial::Rest, 0.5);
        Scenario { initial, restitution, forcing_frequency: frequency, ..base }
    };
    let whole = from_rest([0.5e-6, 2.1e-6]);
    let mut parts = from_rest([-2.7e-6, 7.5e-6]);
    parts.overtones.push(Overtone { frequency, amplitudes: vec![[3.2e-6, -5.4e-6]] });
    let [(sum, _), (hit, rate)] = [whole, parts].map(|scenario| {
        let mut engine = Engine::new(&scenario).unwrap();
        let hit = first(&mut engine, 1e6).expect("it closes in the end");
        (hit, engine.counters().evaluations as f64 / hit.time)
    });
    let error = (hit.time - sum.time).abs() * sum.closing_speed;
    println!("t = {}: {error:e}, {rate:.1} evaluations a unit of time", hit.time);
    assert!(hit.gap == sum.gap && error < 1e-6 && rate < 20.0, "{error:e}, {rate}");
}
