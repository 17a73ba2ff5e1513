//! The engine against the reference of higher precision.

use crate::reference::{Big, Dd, Hit, Real, Reference};
use crate::{drawn, trace};
use impact_chain::Scenario;
use impact_paper::params::{Boundary, Chain, Start};

/// One chain with its draw, how long the engine must agree with the reference, and a least number of impacts.
struct Case {
    chain: Chain,
    sigma: f64,
    index: u64,
    until: f64,
    least: usize,
}

fn case(masses: usize, sigma: f64, index: u64, until: f64, least: usize) -> Case {
    Case { chain: Chain { masses, ..Chain::default() }, sigma, index, until, least }
}

/// The declared horizons: in each the chaos of the case leaves times their nine decimals (a tenfold
/// growth of errors takes 7 to 15 units of time), with some room.
fn cases() -> Vec<Case> {
    let with = |change: fn(&mut Chain), mut case: Case| {
        change(&mut case.chain);
        case
    };
    vec![
        case(20, 0.3, 1, 80.0, 300),
        case(20, 0.3, 2, 80.0, 300),
        case(20, 0.3, 3, 80.0, 300),
        case(100, 0.2, 1, 50.0, 600),
        with(|c| c.restitution = 0.0, case(20, 0.2, 1, 200.0, 250)),
        with(|c| c.restitution = 0.2, case(20, 0.2, 1, 180.0, 250)),
        with(|c| c.restitution = 1.0, case(20, 0.2, 1, 55.0, 300)),
        with(|c| c.boundary = Boundary::Ring, case(20, 0.25, 1, 80.0, 300)),
        with(|c| c.start = Start::Zero, case(20, 0.25, 2, 80.0, 150)),
        with(|c| c.start = Start::Random, case(20, 0.18, 1, 80.0, 100)),
        with(
            |c| {
                c.spacing = 2.0;
                c.natural_frequency = 1.3;
                c.forcing_frequency = 0.7;
            },
            case(20, 0.8, 1, 80.0, 100),
        ),
        with(
            |c| {
                c.spacing = 0.5;
                c.natural_frequency = 0.6;
                c.forcing_frequency = 2.9;
                c.boundary = Boundary::Ring;
            },
            case(7, 1.2, 29, 30.0, 100),
        ),
        case(1, 1.1, 3, 80.0, 30),
        case(2, 0.5, 3, 80.0, 40),
    ]
}

/// Compares the impacts of a scenario with those of the reference, which are returned.
pub fn held(scenario: &Scenario, until: f64, of: &str) -> Vec<Hit<Dd>> {
    let ours = trace(scenario, until);
    let theirs = Reference::<Dd>::new(scenario).run(until).unwrap();
    assert_eq!(ours.len(), theirs.len(), "{of}");
    let mut worst: f64 = 0.0;
    for (a, b) in ours.iter().zip(&theirs) {
        assert_eq!(a.gap, b.gap, "{of} at t = {}", a.time);
        let error = (Dd::of(a.time) - b.time).near().abs();
        let speed = (Dd::of(a.closing_speed) - b.closing_speed).near().abs();
        assert!(error < 1e-9 && speed < 1e-8, "{of}: {a:?} {error:e} {speed:e}");
        // Before chaos has had time, times and speeds are off by a few roundings and no more.
        let digits = [error, speed].map(|x| x * b.closing_speed.near());
        assert!(a.time > 4.0 || digits[0] < 4e-14, "{of}: {a:?} {digits:?}");
        let plain = scenario.overtones.is_empty();
        let few = digits[0].max(digits[1]) < 1e-13;
        assert!(!plain || a.time > 5.0 || few, "{of}: {a:?} {digits:?}");
        worst = worst.max(error);
    }
    println!("{of}: {} impacts, largest error of a time {worst:.1e}", theirs.len());
    theirs
}

#[test]
fn impacts_have_the_order_and_times_of_the_reference() {
    for (i, Case { chain, sigma, index, until, least }) in cases().into_iter().enumerate() {
        let theirs = held(&drawn(&chain, sigma, "reference", index), until, &format!("case {i}"));
        let late = theirs.iter().filter(|hit| hit.time.near() > 0.9 * until).count();
        assert!(theirs.len() >= least && late > 0, "case {i} is too quiet: {}", theirs.len());
    }
}

#[test]
fn the_two_precisions_of_the_reference_agree() {
    let chain = Chain { masses: 6, ..Chain::default() };
    let scenario = drawn(&chain, 0.4, "reference", 0);
    let small = Reference::<Dd>::new(&scenario).run(12.0).unwrap();
    let big = Reference::<Big>::new(&scenario).run(12.0).unwrap();
    assert!(small.len() > 10);
    assert_eq!(small.len(), big.len());
    for (a, b) in small.iter().zip(&big) {
        let Dd { hi, lo } = a.time;
        let error = (Big::of(hi) + Big::of(lo) - b.time.clone()).near().abs();
        assert!(a.gap == b.gap && error < 1e-26, "t = {hi}: {error:e}");
    }
}
