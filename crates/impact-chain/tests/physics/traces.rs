//! Compares the impacts of the engine with those of the reference of higher precision.

use crate::reference::{Dd, Hit, Reference};
use crate::{drawn, trace};
use impact_chain::methods::truth::TrueMotion;
use impact_chain::{Boundary, Chain, Engine, Overtone, Scenario, Start, State};
use impact_numerics::random::{NormalPairs, Seed};

/// Compares the impacts of a scenario with those of the reference, which are returned.
fn compared(scenario: &Scenario, until: f64, case: &str) -> Vec<Hit> {
    let ours = trace(scenario, until);
    let theirs = Reference::new(scenario).run(until).unwrap();
    assert_eq!(ours.len(), theirs.len(), "{case}");
    for (a, b) in ours.iter().zip(&theirs) {
        assert_eq!(a.gap, b.gap, "{case} at t = {}", a.time);
        let error = (Dd::from(a.time) - b.time).hi.abs();
        let speed = (Dd::from(a.closing_speed) - b.closing_speed).hi.abs();
        assert!(error < 1e-9 && speed < 1e-8, "{case}: {a:?} {error:e} {speed:e}");
        // Before chaos has had time, times and speeds are off by a few roundings and no more.
        let digits = [error, speed].map(|x| x * b.closing_speed.hi);
        assert!(a.time > 4.0 || digits[0] < 4e-14, "{case}: {a:?} {digits:?}");
        let plain = scenario.overtones.is_empty();
        let few = digits[0].max(digits[1]) < 1e-13;
        assert!(!plain || a.time > 5.0 || few, "{case}: {a:?} {digits:?}");
    }
    theirs
}

/// In each horizon chaos leaves times nine decimals: errors grow tenfold in 7 to 15.
#[test]
fn impacts_have_the_order_and_times_of_the_reference() {
    let of = |masses| Chain { masses, ..Chain::default() };
    let slow = Chain { natural_frequency: 1.3, forcing_frequency: 0.7, spacing: 2.0, ..of(20) };
    let fast = Chain { natural_frequency: 0.6, forcing_frequency: 2.9, spacing: 0.5, ..of(7) };
    // A chain with its draw, how long the engine must agree, and a least number of impacts.
    for (i, (chain, sigma, index, until, least)) in [
        (of(20), 0.3, 1, 80.0, 300),
        (of(20), 0.3, 2, 80.0, 300),
        (of(20), 0.3, 3, 80.0, 300),
        (of(100), 0.2, 1, 50.0, 600),
        (Chain { restitution: 0.0, ..of(20) }, 0.2, 1, 200.0, 250),
        (Chain { restitution: 0.2, ..of(20) }, 0.2, 1, 180.0, 250),
        (Chain { restitution: 1.0, ..of(20) }, 0.2, 1, 55.0, 300),
        (Chain { boundary: Boundary::Ring, ..of(20) }, 0.25, 1, 80.0, 300),
        (Chain { start: Start::Zero, ..of(20) }, 0.25, 2, 80.0, 150),
        (Chain { start: Start::Random, ..of(20) }, 0.18, 1, 80.0, 100),
        (slow, 0.8, 1, 80.0, 100),
        (Chain { boundary: Boundary::Ring, ..fast }, 1.2, 29, 30.0, 100),
        (of(1), 1.1, 3, 80.0, 30),
        (of(2), 0.5, 3, 80.0, 40),
    ]
    .into_iter()
    .enumerate()
    {
        let theirs =
            compared(&drawn(&chain, sigma, "reference", index), until, &format!("case {i}"));
        let late = theirs.iter().filter(|hit| hit.time.hi > 0.9 * until).count();
        assert!(theirs.len() >= least && late > 0, "case {i} is too quiet: {}", theirs.len());
    }
}

/// The true motion and the reference share no code; chaos enlarges 1e-31 by a factor of 1e4 or so.
#[test]
fn the_true_motion_has_digits_beyond_doubles() {
    let chain = Chain { masses: 20, natural_frequency: 1.3, spacing: 2.0, ..Chain::default() };
    let scenario = drawn(&chain, 0.3, "truth", 1);
    let start = State::from_scenario(&scenario);
    let truth = TrueMotion::from_state(&scenario, &start).run(50.0).unwrap();
    let exact = Reference::new(&scenario).run(50.0).unwrap();
    assert!(truth.len() > 100 && truth.len() == exact.len(), "{} {}", truth.len(), exact.len());
    for ((hit, _), exact) in truth.iter().zip(&exact) {
        let error = (hit.time - exact.time).hi.abs();
        assert!(hit.gap == exact.gap && error < 1e-24, "{hit:?}: {error:e}");
    }
    // d, and parts of 5 and 10 of each mass, the latter over ω² − Ω² = −1.
    let two = crate::given(vec![[3.0, 4.0], [-3.0, -4.0]], vec![[6.0, 8.0], [-6.0, -8.0]]);
    let motion = TrueMotion::from_state(&two, &State::from_scenario(&two));
    assert_eq!([0, 1, 2].map(|gap| motion.scale(gap).round()), [16.0, 31.0, 16.0]);
}

/// A chain whose components share the mean square displacement that σ = `sigma` gives.
pub fn several(chain: &Chain, sigma: f64, frequencies: &[f64], index: u64) -> Scenario {
    let mut normals = NormalPairs::new("components", Seed(1), index);
    let mut scenario = Scenario::draw(chain, sigma, &mut normals);
    let w = scenario.natural_frequency;
    let share = sigma / (frequencies.len() as f64).sqrt();
    let mut component = |frequency: f64| -> Vec<[f64; 2]> {
        let size = share * (w * w - frequency * frequency).abs();
        (0..chain.masses).map(|_| normals.pair().map(|x| size * x)).collect()
    };
    scenario.forcing_frequency = frequencies[0];
    scenario.forcing = component(frequencies[0]);
    scenario.overtones = frequencies[1..]
        .iter()
        .map(|&frequency| Overtone { frequency, amplitudes: component(frequency) })
        .collect();
    scenario
}

/// Eight incommensurable frequencies on both sides of ω = 1.
pub const EIGHT: [f64; 8] = [std::f64::consts::SQRT_2, 0.3, 0.618, 0.9, 1.17, 2.23, 3.7, 5.1];

#[test]
fn two_and_eight_components_have_the_impacts_of_the_reference() {
    let chain = |masses| Chain { masses, ..Chain::default() };
    let cases = [
        (chain(12), 0.3, &EIGHT[..2], 60.0),
        (chain(5), 0.3, &EIGHT[..], 30.0),
        (Chain { start: Start::Zero, ..chain(4) }, 0.35, &EIGHT[..], 30.0),
        (Chain { boundary: Boundary::Ring, restitution: 0.3, ..chain(8) }, 0.5, &EIGHT[1..4], 60.0),
        (Chain { natural_frequency: 1.3, spacing: 2.0, ..chain(6) }, 1.0, &[0.7, 2.9], 40.0),
    ];
    let mut early = 0;
    for (i, (chain, sigma, frequencies, until)) in cases.into_iter().enumerate() {
        // The first that starts without overlap and is not too quiet.
        let busy = |scenario: &Scenario| {
            Engine::new(scenario).is_ok() && trace(scenario, until).len() > 30
        };
        let mut draws = (0..50).map(|index| several(&chain, sigma, frequencies, index));
        let theirs = compared(&draws.find(busy).unwrap(), until, &format!("case {i}"));
        early += theirs.iter().filter(|hit| hit.time.hi < 4.0).count();
    }
    assert!(early > 10, "{early}");
}
