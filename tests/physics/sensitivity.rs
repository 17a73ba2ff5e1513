//! `trace --sensitivity`: derivatives of impact times, against differences of runs whose forces differ a little.

use crate::reference::{Dd, Real, Reference};
use crate::{drawn, trace};
use impact_paper::dynamics::{Initial, Overtone, Scenario, Sensitivity, Simultaneous};
use impact_paper::params::{Boundary, Chain, Start};

/// The difference of forces, as a part of them.
const STEP: f64 = 1.0 / (1u64 << 34) as f64;

fn scaled(scenario: &Scenario, factor: f64, round: impl Fn(f64) -> f64) -> Scenario {
    let mut own = scenario.clone();
    let all = own.overtones.iter_mut().flat_map(|overtone| &mut overtone.amplitudes);
    for x in own.forcing.iter_mut().chain(all).flatten() {
        *x = round(*x * factor);
    }
    own
}

fn draw(chain: &Chain, index: u64) -> Scenario {
    drawn(&Chain { masses: 10, ..chain.clone() }, 0.3, "sensitivity", index)
}

/// Walls and ring, all starts, a small restitution, several components, the scales of all quantities; by differences
/// of motions to 106 bits, which leave the derivative fourteen digits and more.
#[test]
fn derivatives_are_those_of_the_true_motion() {
    let own = Chain::default();
    let mut several = draw(&own, 3);
    let amplitudes = several.forcing.iter().map(|[a, b]| [0.5 * b, -0.7 * a]).collect();
    several.overtones.push(Overtone { frequency: 3.0_f64.sqrt(), amplitudes });
    let scenarios = [
        draw(&own, 0),
        draw(&Chain { boundary: Boundary::Ring, ..own.clone() }, 1),
        draw(&Chain { restitution: 0.4, ..own.clone() }, 2),
        several,
        scaled(&draw(&Chain { start: Start::Zero, ..own.clone() }, 9), 1.6, |x| x),
        Scenario { initial: Initial::Free([[-0.2, -0.4], [0.1, 0.5]].repeat(5)), ..draw(&own, 5) },
        draw(&Chain { natural_frequency: 2.0, forcing_frequency: 3.1, spacing: 0.1, ..own }, 6),
    ];
    for (index, scenario) in scenarios.iter().enumerate() {
        // Amplitudes of few bits are scaled without rounding.
        let scenario = scaled(scenario, 1.0, |x| (x * 1024.0).round() / 1024.0);
        let until = 30.0 / scenario.natural_frequency;
        let [below, above] = [1.0 - STEP, 1.0 + STEP].map(|factor| {
            Reference::<Dd>::new(&scaled(&scenario, factor, |x| x)).run(until).unwrap()
        });
        let seen = trace(&scenario, until);
        let mut sensitivity = Sensitivity::new(&scenario).unwrap();
        assert!(seen.len() > 15 && below.len() == seen.len(), "{index}: {}", seen.len());
        for (k, own) in seen.iter().enumerate() {
            let found = sensitivity.shift(own).unwrap();
            let expected = (above[k].time - below[k].time).near() / (2.0 * STEP);
            assert_eq!([below[k].gap, above[k].gap], [own.gap; 2], "{index}: {k}");
            let error = (found - expected).abs() / (1.0 + expected.abs());
            assert!(error < 1e-9, "{index}, {k}: {found} {expected}");
        }
    }
}

/// Where a derivative does not exist, and what is said there: a mass that bounces to rest at a wall, a pair without
/// restitution, mirror images that hit the mass between them, and a pair that begins shut and is pressed.
#[test]
fn impacts_without_a_derivative_are_named() {
    let refused = |scenario: &Scenario| {
        let mut sensitivity = Sensitivity::new(scenario)?;
        trace(scenario, 70.0).iter().try_for_each(|own| sensitivity.shift(own).map(drop))
    };
    for (forces, more, words) in [
        ("[5.88,-4.94]", r#""restitution":0.2"#, "grazes"),
        // Faster than that, but of large amplitudes that nearly cancel.
        (
            "[0.017403290859207835,0.023204387812277117]",
            r#""forcing_frequency":1.000000001"#,
            "grazes",
        ),
        ("[0.6,0.3],[-0.6,0.4]", r#""restitution":0"#, "comes to rest"),
        ("[0.9,0.8],[0,0],[-0.9,-0.8]", r#""spacing":1"#, "together with a neighbour"),
        (
            "[1.5,0],[-1.5,0]",
            r#""forcing_frequency":2,"initial":{"free":[[1,0],[-1,0]]}"#,
            "starts in contact",
        ),
    ] {
        let json = format!(r#"{{"forcing":[{forces}],{more}}}"#);
        let scenario = Scenario::from_json(&json).unwrap();
        let error = refused(&scenario).unwrap_err().to_string();
        assert!(error.contains(words) && error.contains("no derivative"), "{json}: {error}");
        let joint = Scenario { simultaneous: Simultaneous::Joint, ..scenario };
        assert_eq!(error, refused(&joint).unwrap_err().to_string());
    }
}

/// Two masses that just touch half-way: all is in proportion to the forces, so τ′ = −d/V, and rounding of τ changes V by |Δ̈| E/V.
#[test]
fn rounding_leaves_what_is_promised_near_a_graze() {
    for big_w in [2.0_f64.sqrt(), 10.0, 100.0, 1000.0] {
        let mut seen = [0; 2];
        for k in 0..60 {
            let speed = big_w * 1.6e-6 * 1.15_f64.powi(k);
            let (sin, cos) = (1.0 + 0.02 * f64::from(k)).sin_cos();
            let force = 0.5 * (1.0 + (speed / big_w).powi(2)).sqrt() * (big_w * big_w - 1.0);
            let [a, b] = [force * cos, force * sin];
            let json = format!(
                r#"{{"forcing_frequency":{big_w:?},"initial":"zero","forcing":[[{a:?},{b:?}],[{:?},{:?}]]}}"#,
                -a, -b
            );
            let scenario = Scenario::from_json(&json).unwrap();
            let until = 7.0 / big_w;
            let truth = Reference::<Dd>::new(&scenario).run(until).unwrap();
            let own = trace(&scenario, until)[0];
            let found = Sensitivity::new(&scenario).unwrap().shift(&own);
            seen[usize::from(found.is_ok())] += 1;
            if let Ok(found) = found {
                let error = found * truth[0].closing_speed.near() + 1.0;
                // A tenth of what is promised: roundings do not conspire.
                assert!(error.abs() < 1e-5, "{big_w}, {}: {error:e}", own.closing_speed);
            }
        }
        assert!(seen.iter().all(|n| *n > 10), "{big_w}: {seen:?}");
    }
}
