//! The engine against the reference of higher precision.

use crate::reference::{Big, Dd, Real, Reference};
use impact_paper::dynamics::{Engine, Impact, Scenario};
use impact_paper::numerics::random::NormalPairs;
use impact_paper::params::{Boundary, Chain, Start};

#[test]
fn double_double_sine_and_cosine_agree_with_dashu() {
    let mut worst: f64 = 0.0;
    for i in 0..200 {
        let x = f64::from(i * i) * 0.37 - 900.0 + 1.0 / f64::from(i + 3);
        let (s, c) = Dd::of(x).sin_cos();
        let (big_s, big_c) = Big::of(x).sin_cos();
        for (small, big) in [(s, big_s), (c, big_c)] {
            let [hi, lo] = small.parts();
            let error = (Big::of(hi) + Big::of(lo) - big).near().abs();
            worst = worst.max(error / x.abs().max(1.0));
        }
    }
    assert!(worst < 2e-32, "{worst:e}");
}

/// What the engine says.
fn engine_trace(scenario: &Scenario, until: f64) -> Vec<Impact> {
    let mut impacts = Vec::new();
    let mut engine = Engine::new(scenario).unwrap();
    engine
        .run(until, |impact| {
            impacts.push(impact);
            true
        })
        .unwrap();
    impacts
}

/// One chain, what is drawn for it, how long the engine must agree, and a least number of impacts.
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

#[test]
fn impacts_have_the_order_and_times_of_the_reference() {
    let mut worst: f64 = 0.0;
    for (i, Case { chain, sigma, index, until, least }) in cases().into_iter().enumerate() {
        let mut normals = NormalPairs::new("reference", 1, index);
        let scenario = Scenario::draw(&chain, sigma, &mut normals);
        let ours = engine_trace(&scenario, until);
        let theirs = Reference::<Dd>::new(&scenario).run(until).unwrap();
        let late = theirs.iter().filter(|hit| hit.time.near() > 0.9 * until).count();
        println!("case {i}: {} impacts", theirs.len());
        assert!(theirs.len() >= least && late > 0, "case {i} is too quiet: {}", theirs.len());
        assert_eq!(ours.len(), theirs.len(), "case {i}");
        for (a, b) in ours.iter().zip(&theirs) {
            assert_eq!(a.gap, b.gap, "case {i} at t = {}", a.time);
            let error = (Dd::of(a.time) - b.time).near().abs();
            assert!(error < 1e-9, "case {i}, t = {}: {error:e}", a.time);
            let speed = (Dd::of(a.closing_speed) - b.closing_speed).near().abs();
            assert!(speed < 1e-8, "case {i}, t = {}: closing speed off by {speed:e}", a.time);
            worst = worst.max(error);
        }
    }
    println!("largest error of a time: {worst:.1e}");
}

#[test]
fn early_impacts_have_all_their_digits() {
    // Before chaos has had time, times and speeds are off by a few roundings and no more.
    for index in 0..40 {
        let mut normals = NormalPairs::new("reference", 2, index);
        let scenario = Scenario::draw(&Chain { masses: 20, ..Chain::default() }, 0.3, &mut normals);
        let ours = engine_trace(&scenario, 5.0);
        let theirs = Reference::<Dd>::new(&scenario).run(5.0).unwrap();
        for (a, b) in ours.iter().zip(&theirs) {
            let error = (Dd::of(a.time) - b.time).near().abs() * b.closing_speed.near();
            let speed = (Dd::of(a.closing_speed) - b.closing_speed).near().abs();
            let speed = speed * b.closing_speed.near();
            assert!(error < 1e-13 && speed < 1e-13, "{index}: {a:?} {error:e} {speed:e}");
        }
    }
}

#[test]
fn the_two_precisions_of_the_reference_agree() {
    let chain = Chain { masses: 6, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.4, &mut NormalPairs::new("reference", 1, 0));
    let small = Reference::<Dd>::new(&scenario).run(12.0).unwrap();
    let big = Reference::<Big>::new(&scenario).run(12.0).unwrap();
    assert!(small.len() > 10);
    assert_eq!(small.len(), big.len());
    for (a, b) in small.iter().zip(&big) {
        let [hi, lo] = a.time.parts();
        let error = (Big::of(hi) + Big::of(lo) - b.time.clone()).near().abs();
        assert!(a.gap == b.gap && error < 1e-26, "t = {hi}: {error:e}");
    }
}
