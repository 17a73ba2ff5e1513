//! Tests the rivals of the engine: each converges at its order, and fails as documented.

use crate::{drawn, given, run};
use impact_chain::methods::{
    Advancement, Certified, Cost, Method, MoreauJean, Penalty, RungeKutta, Sampled, Verlet,
    VerletSingle,
};
use impact_chain::{Boundary, Chain, Engine, Error, Impact, Scenario, State};

fn chain(masses: usize, boundary: Boundary, sigma: f64, index: u64) -> Scenario {
    drawn(&Chain { masses, boundary, ..Chain::default() }, sigma, "methods", index)
}

/// One mass between walls, or more, without forcing and from given free parts.
fn free(parts: &[[f64; 2]], restitution: f64) -> Scenario {
    Scenario { restitution, ..given(parts.to_vec(), vec![[0.0; 2]; parts.len()]) }
}

fn trace(
    method: &dyn Method,
    scenario: &Scenario,
    until: f64,
) -> (Vec<Impact>, Result<Cost, Error>) {
    let mut impacts = Vec::new();
    let cost = method.run((scenario, &State::of(scenario), until), &mut |impact| {
        impacts.push(impact);
        true
    });
    (impacts, cost)
}

fn impacts(method: &dyn Method, scenario: &Scenario, until: f64) -> Vec<Impact> {
    method.impacts((scenario, &State::of(scenario), until)).unwrap()
}

fn all() -> Vec<Box<dyn Method>> {
    vec![
        Box::new(Certified),
        Box::new(Sampled { step: 0.01, stop: 0.0 }),
        Box::new(Advancement { tolerance: 1e-13, stop: 0.0 }),
        Box::new(RungeKutta { tolerance: 1e-9, stop: 0.0 }),
        Box::new(MoreauJean { step: 1e-3 }),
        Box::new(Verlet { step: 1e-3 }),
        Box::new(VerletSingle { step: 1e-2 }),
        Box::new(Penalty { step: 1e-4 }),
    ]
}

/// Root mean square of the errors of the first impacts' times, over chains between walls and on
/// rings, and the cost of all runs. Panics if a gap differs.
fn error_of(method: &dyn Method) -> (f64, Cost) {
    let (mut sum, mut count, mut total) = (0.0, 0u32, Cost::default());
    for boundary in [Boundary::Walls, Boundary::Ring] {
        for index in 0..8 {
            let scenario = chain(6, boundary, 0.35, index);
            let exact = impacts(&Certified, &scenario, 6.0);
            let (found, cost) = trace(method, &scenario, 7.0);
            let cost = cost.unwrap();
            total.steps += cost.steps;
            total.evaluations += cost.evaluations;
            // Order within a step is lost: each gap has a list.
            for gap in 0..7 {
                let of_gap = |list: &[Impact]| -> Vec<f64> {
                    list.iter().filter(|i| i.gap == gap).map(|i| i.time).take(2).collect()
                };
                let (exact, found) = (of_gap(&exact), of_gap(&found));
                for (i, t) in exact.iter().enumerate() {
                    let other = found.get(i);
                    let name = method.name();
                    let other = other.unwrap_or_else(|| panic!("{name} has no {i} at gap {gap}"));
                    sum += (t - other) * (t - other);
                    count += 1;
                }
            }
        }
    }
    assert!(count > 60, "{count} impacts");
    ((sum / f64::from(count)).sqrt(), total)
}

#[test]
fn methods_have_their_order() {
    let grown = |methods: [&dyn Method; 2]| {
        let [(e, c), (f, d)] = methods.map(error_of);
        let (errors, steps) = (e / f, d.steps as f64 / c.steps as f64);
        [errors, steps]
    };
    let by_steps: [([&dyn Method; 2], f64); 3] = [
        ([&Verlet { step: 1e-3 }, &Verlet { step: 2e-5 }], 1.0),
        ([&MoreauJean { step: 1e-3 }, &MoreauJean { step: 2e-5 }], 1.0),
        ([&Penalty { step: 1e-3 }, &Penalty { step: 2e-5 }], 0.5),
    ];
    for (methods, expected) in by_steps {
        let [errors, steps] = grown(methods);
        let order = errors.ln() / steps.ln();
        assert!((order - expected).abs() < 0.1, "{}: {order}", methods[0].name());
    }
    // The error is the tolerance's, over five decades, and the steps are its fifth root.
    let tolerances =
        [&RungeKutta { tolerance: 1e-6, stop: 0.0 }, &RungeKutta { tolerance: 1e-11, stop: 0.0 }];
    let grown = grown(tolerances.map(|method| method as &dyn Method));
    let [error, steps] = grown.map(|x| x.log10() / 5.0);
    assert!((error - 1.0).abs() < 0.15 && (steps - 0.2).abs() < 0.03, "{error} {steps}");
}

/// A run that is stopped by its receiver ends right there, and one that goes on from a state in the
/// middle finds what the whole run finds: to its digits by a closed form, whatever the step.
#[test]
fn runs_stop_and_go_on() {
    for boundary in [Boundary::Walls, Boundary::Ring] {
        let scenario = chain(8, boundary, 0.3, 6);
        let mut engine = Engine::new(&scenario).unwrap();
        engine.run(30.0, |_| true).unwrap();
        let start = State {
            time: 30.0,
            positions: engine.positions(30.0).unwrap(),
            velocities: engine.velocities(30.0).unwrap(),
        };
        let exact = run(&mut engine, 40.0);
        let more: Box<dyn Method> = Box::new(Sampled { step: 0.1, stop: 0.0 });
        for method in all().into_iter().chain([more]) {
            let name = method.name();
            let mut found: Vec<Impact> = Vec::new();
            let cost = method.run((&scenario, &start, 40.0), &mut |impact| {
                found.push(impact);
                found.len() < 3
            });
            assert_eq!((cost.unwrap().impacts, found.len()), (3, 3), "{name}");
            let closed = ["certified", "sampled", "advancement"].contains(&name);
            let room = if closed { 1e-12 } else { 0.02 };
            for (exact, found) in exact.iter().zip(&found) {
                let off = (exact.time - found.time).abs();
                assert!(exact.gap == found.gap && off < room, "{name}: {exact:?} {found:?}");
            }
            assert_eq!(method.run((&scenario, &start, 29.0), &mut |_| true).unwrap().impacts, 0);
        }
    }
}

/// Methods find the same impacts to the last bit, whatever vectors the processor has.
#[test]
fn vectors_change_no_bits() {
    let found = || {
        let runs = all().into_iter().flat_map(|method| {
            let chains =
                [Boundary::Walls, Boundary::Ring].map(|boundary| chain(70, boundary, 0.3, 1));
            chains.map(|scenario| trace(&*method, &scenario, 10.0).0)
        });
        runs.collect::<Vec<_>>()
    };
    let wide = found();
    impact_chain::abreast::without_wide_vectors();
    assert!(wide == found() && wide.iter().all(|run| run.len() > 20));
}

#[test]
fn no_method_loops_or_panics_on_bad_data() {
    let good = chain(2, Boundary::Walls, 0.3, 0);
    let mut overlapped = State::of(&good);
    overlapped.positions.swap(0, 1);
    let broken = Scenario { restitution: f64::NAN, ..good.clone() };
    // A speed of 1e7 between walls: ten million impacts a unit of time, or none found.
    let hot = free(&[[0.0, 1e7]], 1.0);
    for method in all() {
        let name = method.name();
        let run = |scenario: &Scenario, start: &State, until: f64| {
            method.run((scenario, start, until), &mut |_| true)
        };
        let overlap = run(&good, &overlapped, 9.0);
        assert!(matches!(overlap, Err(Error::Overlap { gap: 1, .. })), "{name}");
        let other = State::of(&chain(3, Boundary::Walls, 0.1, 0));
        for refused in [run(&broken, &State::of(&good), 9.0), run(&good, &other, 9.0)] {
            assert!(matches!(refused, Err(Error::Input { .. })), "{name}");
        }
        assert!(run(&good, &State::of(&good), f64::NAN).is_err(), "{name}");
        match run(&hot, &State::of(&hot), 1.0) {
            Err(Error::Work { time, .. }) => assert!(time <= 1.0, "{name}"),
            other => assert!(other.is_ok(), "{name}: {other:?}"),
        }
        let ring = Scenario { boundary: Boundary::Ring, ..free(&[[0.3, 0.1]], 0.5) };
        assert_eq!(run(&ring, &State::of(&ring), 9.0).unwrap().impacts, 0, "{name}: one on a ring");
    }
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY, 2.0, 1e-300] {
        let wrong: [&dyn Method; 7] = [
            &Sampled { step, stop: 0.0 },
            &Advancement { tolerance: step, stop: 0.0 },
            &MoreauJean { step },
            &Verlet { step },
            &VerletSingle { step },
            &Penalty { step },
            &RungeKutta { tolerance: step, stop: 0.0 },
        ];
        for method in wrong {
            let error = trace(method, &good, 1.0).1.unwrap_err().to_string();
            let named = error.starts_with("step: ") || error.starts_with("tolerance: ");
            assert!(named, "{}: {error}", method.name());
        }
    }
}
