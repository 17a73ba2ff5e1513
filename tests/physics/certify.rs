//! `trace --certify`: what it says can be trusted is true, and what is regular is trusted.

use crate::reference::{Dd, Real, Reference};
use crate::{drawn, given};
use impact_paper::dynamics::{Certificate, Impact, Scenario, TOLERANCE, certify};
use impact_paper::params::{Boundary, Chain};

fn draw(chain: &Chain, sigma: f64, index: u64) -> Scenario {
    drawn(chain, sigma, "certificates", index)
}

fn certified(scenario: &Scenario, until: f64) -> (Vec<Impact>, Certificate) {
    let mut ours = Vec::new();
    let certificate = certify(scenario, until, |impact| {
        ours.push(impact);
        true
    });
    (ours, certificate.unwrap())
}

/// Impacts of the run that are right: the gap, and the time within the tolerance.
fn right(ours: &[Impact], scenario: &Scenario, until: f64) -> u64 {
    let mut reference = Reference::<Dd>::new(scenario);
    let tolerance = TOLERANCE / scenario.natural_frequency;
    let right = ours.iter().take_while(|own| {
        let hit = reference.step(&Dd::of(until + 1.0)).unwrap();
        hit.is_some_and(|hit| {
            own.gap == hit.gap && (Dd::of(own.time) - hit.time).near().abs() <= tolerance
        })
    });
    right.count() as u64
}

/// A margin too small would show here: one of many runs would be trusted too long.
#[test]
fn the_horizon_is_not_beyond_the_true_one() {
    let chain = |masses| Chain { masses, ..Chain::default() };
    let mut scenarios = vec![
        (draw(&chain(20), 0.3, 0), 250.0),
        (draw(&chain(20), 0.3, 1), 250.0),
        (draw(&chain(40), 0.2, 2), 250.0),
        (draw(&Chain { restitution: 1.0, ..chain(8) }, 0.3, 3), 150.0),
        (draw(&Chain { boundary: Boundary::Ring, ..chain(12) }, 0.3, 4), 250.0),
        (
            draw(&Chain { natural_frequency: 2.0, forcing_frequency: 3.1, ..chain(10) }, 2.0, 5),
            120.0,
        ),
    ];
    let (alike, from) = (12, scenarios.len());
    for index in 10..10 + alike {
        // Some of them so near resonance that the twins' first roundings are as large as they may be.
        let near = Chain { forcing_frequency: 1.0 - 5e-8, ..chain(12) };
        let chain = if index % 4 == 0 { near } else { chain(12) };
        scenarios.push((draw(&chain, 0.35, index), 250.0));
    }
    let (mut trusted, mut true_ones) = (0, 0);
    for (i, (scenario, until)) in scenarios.into_iter().enumerate() {
        let (ours, certificate) = certified(&scenario, until);
        let right = right(&ours, &scenario, until);
        println!("{i}: {certificate:?}, {right} of {} are right", ours.len());
        assert!(certificate.impacts <= right, "{i}: {certificate:?}, but {right} are right");
        (trusted, true_ones) = (trusted + certificate.impacts, true_ones + right);
        if i >= from {
            continue;
        }
        assert!(right < ours.len() as u64, "{i}: too short a run to lose its way");
        assert!(certificate.impacts * 10 > right * 7, "{i}: {certificate:?} of {right}: too shy");
        let horizon = certificate.horizon.expect("a chaotic run has one");
        let next = &ours[certificate.impacts as usize];
        assert!(horizon <= next.time && next.time - horizon < 5.0, "{i}: {horizon} {next:?}");
        let growth = certificate.growth.expect("errors grow");
        assert!((0.05..2.0).contains(&growth), "{i}: {growth}");
    }
    assert!(trusted * 10 > true_ones * 7, "{trusted} of {true_ones}: too shy");
}

#[test]
fn what_is_regular_or_quiet_is_trusted_to_its_end() {
    let chain = |masses| Chain { masses, ..Chain::default() };
    // A mass that bounces at one wall without forcing: no chaos, and the times drift by roundings.
    let bouncing = Scenario { restitution: 1.0, ..given(vec![[0.0, 1.5]], vec![[0.0; 2]]) };
    // A mirror image keeps its exact ties.
    let mut mirror = draw(&chain(6), 0.3, 3);
    for j in 0..3 {
        mirror.forcing[5 - j] = mirror.forcing[j].map(|x| -x);
    }
    let quiet = draw(&chain(30), 0.04, 1);
    for (scenario, until, least) in [(bouncing, 1e4, 1000), (mirror, 20.0, 10), (quiet, 1e9, 0)] {
        let (ours, certificate) = certified(&scenario, until);
        println!("{}: {certificate:?}", ours.len());
        assert!(ours.len() >= least, "{}", ours.len());
        assert_eq!((certificate.impacts, certificate.horizon), (ours.len() as u64, None));
        assert!(certificate.growth.is_none_or(|rate| rate < 0.5), "{certificate:?}");
    }
}
