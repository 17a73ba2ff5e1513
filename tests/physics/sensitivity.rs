//! `trace --sensitivity`: derivatives of impact times, against differences of runs whose forces differ a little.

use impact_paper::dynamics::methods::State;
use impact_paper::dynamics::{
    Engine, Impact, Initial, Overtone, Scenario, Sensitivity, Simultaneous,
};
use impact_paper::experiments::accuracy::truth::Truth;
use impact_paper::numerics::random::NormalPairs;
use impact_paper::params::{Boundary, Chain, Start};

fn impacts(scenario: &Scenario, until: f64) -> Vec<Impact> {
    let mut found = Vec::new();
    let mut engine = Engine::new(scenario).unwrap();
    engine
        .run(until, |impact| {
            found.push(impact);
            true
        })
        .unwrap();
    found
}

fn scaled(scenario: &Scenario, factor: f64) -> Scenario {
    let mut own = scenario.clone();
    let all = own.overtones.iter_mut().flat_map(|overtone| &mut overtone.amplitudes);
    for x in own.forcing.iter_mut().chain(all).flatten() {
        *x *= factor;
    }
    own
}

fn draw(chain: &Chain, index: u64) -> Scenario {
    let chain = Chain { masses: 10, ..chain.clone() };
    Scenario::draw(&chain, 0.3, &mut NormalPairs::new("sensitivity", 1, index))
}

/// Walls and ring, all starts, a small restitution, several components, the scales of all quantities.
#[test]
fn derivatives_are_what_differences_tend_to() {
    let own = Chain::default();
    let mut several = draw(&own, 3);
    let amplitudes = several.forcing.iter().map(|[a, b]| [0.5 * b, -0.7 * a]).collect();
    several.overtones.push(Overtone { frequency: 3.0_f64.sqrt(), amplitudes });
    let scenarios = [
        draw(&own, 0),
        draw(&Chain { boundary: Boundary::Ring, ..own.clone() }, 1),
        draw(&Chain { restitution: 0.4, ..own.clone() }, 2),
        several,
        scaled(&draw(&Chain { start: Start::Zero, ..own.clone() }, 9), 1.6),
        Scenario { initial: Initial::Free([[-0.2, -0.4], [0.1, 0.5]].repeat(5)), ..draw(&own, 5) },
        draw(&Chain { natural_frequency: 2.0, forcing_frequency: 3.1, spacing: 0.1, ..own }, 6),
    ];
    for (index, scenario) in scenarios.iter().enumerate() {
        let step = 1e-7;
        let until = 30.0 / scenario.natural_frequency;
        let [below, at, above] =
            [1.0 - step, 1.0, 1.0 + step].map(|factor| impacts(&scaled(scenario, factor), until));
        let mut sensitivity = Sensitivity::new(scenario).unwrap();
        assert!(at.len() > 15, "{index}: {}", at.len());
        for (k, own) in at.iter().enumerate() {
            let found = sensitivity.shift(own).unwrap();
            let expected = (above[k].time - below[k].time) / (2.0 * step);
            assert_eq!([below[k].gap, above[k].gap], [own.gap; 2], "{index}: {k}");
            let room = 1e-4 * expected.abs() + 1e-6;
            assert!((found - expected).abs() < room, "{index}, {k}: {found} {expected}");
        }
    }
}

/// Differences of motions to 106 bits leave the derivative fourteen digits and more. Amplitudes of few bits are scaled without rounding.
#[test]
fn derivatives_are_those_of_the_true_motion() {
    let mut scenario = draw(&Chain { masses: 10, ..Chain::default() }, 7);
    for x in scenario.forcing.iter_mut().flatten() {
        *x = (*x * 1024.0).round() / 1024.0;
    }
    let step = 2.0_f64.powi(-34);
    let [below, at, above] = [1.0 - step, 1.0, 1.0 + step].map(|factor| {
        let own = scaled(&scenario, factor);
        Truth::of(&own, &State::of(&own)).run(40.0).unwrap()
    });
    let seen = impacts(&scenario, 40.0);
    let mut sensitivity = Sensitivity::new(&scenario).unwrap();
    assert!(at.len() > 40 && seen.len() == at.len());
    let mut worst = 0.0_f64;
    for (k, own) in seen.iter().enumerate() {
        let found = sensitivity.shift(own).unwrap();
        let expected = (above[k].0.time - below[k].0.time).to_f64() / (2.0 * step);
        worst = worst.max((found - expected).abs() / (1.0 + expected.abs()));
    }
    assert!(worst < 1e-11, "{worst:e}");
}

/// Where a derivative does not exist, and what is said there.
#[test]
fn impacts_without_a_derivative_are_named() {
    let refused = |scenario: &Scenario, until: f64| {
        let mut sensitivity = Sensitivity::new(scenario)?;
        impacts(scenario, until).iter().try_for_each(|own| sensitivity.shift(own).map(drop))
    };
    // A mass that bounces to rest at a wall, a pair without restitution, mirror images that hit the mass between them, and a pair that
    // begins shut and is pressed.
    for (json, words) in [
        (r#"{"restitution":0.2,"forcing":[[5.88,-4.94]]}"#, "grazes"),
        (r#"{"restitution":0,"forcing":[[0.6,0.3],[-0.6,0.4]]}"#, "comes to rest"),
        (r#"{"forcing":[[0.9,0.8],[0,0],[-0.9,-0.8]]}"#, "together with a neighbour"),
        (
            r#"{"forcing":[[1.5,0],[-1.5,0]],"forcing_frequency":2,"initial":{"free":[[1,0],[-1,0]]}}"#,
            "starts in contact",
        ),
    ] {
        let scenario = Scenario::from_json(json).unwrap();
        let error = refused(&scenario, 60.0).unwrap_err().to_string();
        assert!(error.contains(words) && error.contains("no derivative"), "{json}: {error}");
        let joint = Scenario { simultaneous: Simultaneous::Joint, ..scenario };
        assert_eq!(error, refused(&joint, 60.0).unwrap_err().to_string());
    }
}
