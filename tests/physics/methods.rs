//! The rivals of the engine: each converges at its order, and fails where its documentation says.

use crate::{drawn, first, given, run};
use impact_paper::dynamics::methods::{
    Certified, Cost, Method, MoreauJean, Newton, Penalty, RungeKutta, Sampled, State, Verlet,
};
use impact_paper::dynamics::{Engine, Error, Impact, Scenario};
use impact_paper::params::{Boundary, Chain};

fn chain(masses: usize, boundary: Boundary, sigma: f64, index: u64) -> Scenario {
    drawn(&Chain { masses, boundary, ..Chain::default() }, sigma, "methods", index)
}

/// One mass between walls, or more, without forcing and from given free parts.
fn free(parts: &[[f64; 2]], restitution: f64) -> Scenario {
    Scenario { restitution, ..given(parts.to_vec(), vec![[0.0; 2]; parts.len()]) }
}

/// A mass that is pressed to the walls, where it chatters and comes to rest.
fn pressed() -> Scenario {
    Scenario { restitution: 0.2, forcing: vec![[5.88, -4.94]], ..chain(1, Boundary::Walls, 0.0, 0) }
}

fn trace(
    method: &dyn Method,
    scenario: &Scenario,
    until: f64,
) -> (Vec<Impact>, Result<Cost, Error>) {
    let mut impacts = Vec::new();
    let cost = method.run(scenario, &State::of(scenario), until, &mut |impact| {
        impacts.push(impact);
        true
    });
    (impacts, cost)
}

fn impacts(method: &dyn Method, scenario: &Scenario, until: f64) -> Vec<Impact> {
    let (impacts, cost) = trace(method, scenario, until);
    assert_eq!(cost.unwrap().impacts, impacts.len() as u64, "{}", method.name());
    impacts
}

fn all() -> Vec<Box<dyn Method>> {
    vec![
        Box::new(Certified),
        Box::new(Sampled { step: 0.01 }),
        Box::new(Newton { step: 0.05 }),
        Box::new(RungeKutta { tolerance: 1e-9 }),
        Box::new(MoreauJean { step: 1e-3 }),
        Box::new(Verlet { step: 1e-3 }),
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
            // Order within a step is lost: each gap has its own list.
            for gap in 0..7 {
                let own = |list: &[Impact]| -> Vec<f64> {
                    list.iter().filter(|i| i.gap == gap).map(|i| i.time).take(2).collect()
                };
                let (exact, found) = (own(&exact), own(&found));
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
fn time_stepping_has_its_order() {
    let order_of = |coarse: &dyn Method, fine: &dyn Method| {
        let ((e, c), (f, d)) = (error_of(coarse), error_of(fine));
        let order = (e / f).ln() / (d.steps as f64 / c.steps as f64).ln();
        println!("{}: error {e:.1e} to {f:.1e}, order {order:.2}", coarse.name());
        order
    };
    let verlet = order_of(&Verlet { step: 1e-3 }, &Verlet { step: 1e-5 });
    let moreau_jean = order_of(&MoreauJean { step: 1e-3 }, &MoreauJean { step: 1e-5 });
    let penalty = order_of(&Penalty { step: 1e-3 }, &Penalty { step: 1e-5 });
    assert!((verlet - 1.0).abs() < 0.1, "{verlet}");
    assert!((moreau_jean - 1.0).abs() < 0.1, "{moreau_jean}");
    assert!((penalty - 0.5).abs() < 0.1, "{penalty}");
}

/// The error is the tolerance's, and the steps are its fifth root.
#[test]
fn runge_kutta_is_of_order_five() {
    let tolerances = [1e-6, 1e-11];
    let [(e, c), (f, d)] = tolerances.map(|tolerance| error_of(&RungeKutta { tolerance }));
    let decades = (tolerances[0] / tolerances[1]).log10();
    let [error, steps] = [e / f, d.steps as f64 / c.steps as f64].map(|x| x.log10() / decades);
    println!("error {e:.1e} to {f:.1e}: powers {error:.2} and {steps:.3} of the tolerance");
    assert!((error - 1.0).abs() < 0.15, "{error}");
    assert!((steps - 0.2).abs() < 0.03, "{steps}");
}

/// The time of an impact from an exact state is that of the engine, whatever the step.
#[test]
fn closed_forms_have_no_order() {
    let rivals: [&dyn Method; 4] = [
        &Sampled { step: 0.001 },
        &Sampled { step: 0.1 },
        &Newton { step: 0.01 },
        &Newton { step: 0.2 },
    ];
    for method in rivals {
        let (missed, worst) = segments(method, 20, 0.3, 200);
        println!("{}: {missed} missed, |δt| speed ≤ {worst:e}", method.name());
        assert!(worst < 1e-13, "{}: {worst:e}", method.name());
        assert!(missed <= 8, "{}: {missed}", method.name());
    }
}

/// Restarted from the exact state after each impact of a run: how many next impacts are not found,
/// and the largest error of the others, times the closing speed.
fn segments(method: &dyn Method, masses: usize, sigma: f64, count: usize) -> (usize, f64) {
    let scenario = chain(masses, Boundary::Walls, sigma, 99);
    let mut engine = Engine::new(&scenario).unwrap();
    let (mut missed, mut worst) = (0, 0.0f64);
    let mut start = State::of(&scenario);
    for _ in 0..count {
        let exact = first(&mut engine, 1e4).unwrap();
        let mut found: Option<Impact> = None;
        method
            .run(&scenario, &start, exact.time + 1e-3, &mut |impact| {
                found = Some(impact);
                false
            })
            .unwrap();
        match found {
            Some(found) if found.gap == exact.gap => {
                worst = worst.max((found.time - exact.time).abs() * exact.closing_speed);
            }
            _ => missed += 1,
        }
        start = State {
            time: exact.time,
            positions: engine.positions(exact.time),
            velocities: engine.velocities(exact.time),
        };
    }
    (missed, worst)
}

/// How many of 50 masses hit the wall of gap 1 first that their free motion reaches up to `depth`
/// beyond (or, if negative, does not reach).
fn grazes(method: &dyn Method, depth: f64) -> usize {
    let hits = |phase: f64| {
        let amplitude = 1.0 + depth;
        let (a, b) = (-amplitude * phase.sin(), amplitude * phase.cos());
        let found = impacts(method, &free(&[[a, b]], 0.8), 3.0);
        found.first().is_some_and(|impact| impact.gap == 1)
    };
    (0..50).filter(|i| hits(0.5 + 0.0123456789 * f64::from(*i))).count()
}

#[test]
fn grazes_are_seen_by_proof_and_missed_by_looking() {
    for k in [2, 3, 5, 7, 9, 12] {
        assert_eq!(grazes(&Certified, 10f64.powi(-k)), 50, "depth 1e-{k}");
        assert_eq!(grazes(&Certified, -(10f64.powi(-k))), 0, "depth -1e-{k}");
    }
    // A dip of depth δ is below zero for 2 √(2δ) = 0.0089 at δ = 1e-5: a step of 0.1 sees a tenth.
    let seen = grazes(&Sampled { step: 0.1 }, 1e-5);
    assert!((1..15).contains(&seen), "{seen}");
    assert_eq!(grazes(&Sampled { step: 0.01 }, 1e-3), 50, "deeper dips than the step's are seen");
    // Steps that a tolerance of 1e-9 allows are longer than that.
    let seen = grazes(&RungeKutta { tolerance: 1e-9 }, 1e-5);
    assert!(seen < 15, "{seen}");
    assert_eq!(grazes(&RungeKutta { tolerance: 1e-9 }, 1e-2), 50);
    // Newton finds grazes where the parabola guesses them, and loses deeper dips to a wrong root.
    assert_eq!(grazes(&Newton { step: 0.2 }, 1e-5), 50);
    let seen = grazes(&Newton { step: 0.2 }, 1e-3);
    assert!((20..50).contains(&seen), "{seen}");
    // Time stepping also hits what only comes near, to some h²/8: by the error of its flight, or by
    // the forecast of its steps.
    let near: [[&dyn Method; 2]; 3] = [
        [&Verlet { step: 0.01 }, &Verlet { step: 0.001 }],
        [&Penalty { step: 0.01 }, &Penalty { step: 0.001 }],
        [&MoreauJean { step: 0.01 }, &MoreauJean { step: 0.001 }],
    ];
    for [coarse, fine] in near {
        let seen = [coarse, fine].map(|method| grazes(method, -1e-6));
        assert!(seen[0] > 10 && seen[1] == 0, "{}: {seen:?}", coarse.name());
    }
}

/// Late by half a step, and as much for the way back: a step for each impact, in the mean.
#[test]
fn verlet_is_late_by_a_step_an_impact() {
    let scenario = free(&[[0.0, 1.5]], 1.0);
    let exact = impacts(&Certified, &scenario, 300.0)[199].time;
    let drift = |i: i32| {
        let step = 0.002 + 1e-4 * f64::from(i);
        let found = impacts(&Verlet { step }, &scenario, 300.0)[199].time;
        (found - exact) / (200.0 * step)
    };
    let drifts: Vec<f64> = (0..40).map(drift).collect();
    assert!(drifts.iter().all(|drift| (0.0..2.1).contains(drift)), "{drifts:?}");
    let mean = drifts.iter().sum::<f64>() / 40.0;
    assert!((mean - 1.0).abs() < 0.3, "{mean}");
}

/// A mass hits a second one 0.004 before a third: with r = 1 the speed goes through to the last.
#[test]
fn penalty_springs_mix_impacts_that_overlap() {
    let scenario = free(&[[0.99, 5.0], [0.0, 0.0], [-0.996, 0.0]], 1.0);
    let exact = impacts(&Certified, &scenario, 0.5);
    assert_eq!(exact.iter().map(|i| i.gap).collect::<Vec<_>>(), [1, 2, 3]);
    let second = |step| {
        let found = impacts(&Penalty { step }, &scenario, 0.5);
        found.iter().find(|i| i.gap == 2).unwrap().closing_speed / exact[1].closing_speed
    };
    // A contact takes 0.02, then 0.0002; the way to the third mass 0.0008.
    let (soft, hard) = (second(1e-3), second(1e-7));
    assert!(soft < 0.5, "{soft}");
    assert!((hard - 1.0).abs() < 1e-3, "{hard}");
}

/// A penalty spring has the restitution that it is tuned to, but for the steps of its contact.
#[test]
fn penalty_springs_have_their_restitution() {
    for r in [0.3, 0.8, 1.0] {
        let speed = |method: &dyn Method| {
            let found = impacts(method, &free(&[[0.0, 1.5]], r), 5.0);
            found[1].closing_speed
        };
        let ratio = speed(&Penalty { step: 1e-5 }) / speed(&Certified);
        assert!((ratio - 1.0).abs() < 0.015, "r = {r}: {ratio}");
    }
}

/// At the wall: contact for the engine, an end of the run for events, one flip a step for Verlet,
/// a lost root and a way through the wall for Newton.
#[test]
fn contact_is_where_events_end() {
    let until = 20.0;
    let exact = impacts(&Certified, &pressed(), until).len();
    for method in [&Sampled { step: 0.01 } as &dyn Method, &RungeKutta { tolerance: 1e-9 }] {
        let (found, cost) = trace(method, &pressed(), until);
        match cost {
            Err(Error::Work { gap: 0, time, .. }) => assert!((1.9..2.1).contains(&time), "{time}"),
            other => panic!("{}: {other:?}", method.name()),
        }
        // The chatter before it is the same; the engine cuts it short.
        assert!((8..40).contains(&found.len()), "{}: {}", method.name(), found.len());
    }
    assert!(impacts(&Verlet { step: 1e-3 }, &pressed(), until).len() > 10 * exact);
    let found = impacts(&MoreauJean { step: 1e-3 }, &pressed(), until);
    assert!((10..exact).contains(&found.len()), "{}", found.len());
    // Both walls in turn, as it should be.
    assert!(found.iter().any(|i| i.gap == 0) && found.iter().any(|i| i.gap == 1));
    let lost = impacts(&Newton { step: 0.05 }, &pressed(), until);
    let exact = impacts(&Certified, &pressed(), until);
    let strong = |list: &[Impact]| list.iter().filter(|i| i.closing_speed > 0.1).count();
    assert_ne!(strong(&lost), strong(&exact), "Newton loses its way after the first contact");
}

#[test]
fn every_method_repeats_its_bits() {
    for boundary in [Boundary::Walls, Boundary::Ring] {
        let scenario = chain(8, boundary, 0.3, 5);
        for method in all() {
            let run = || trace(&*method, &scenario, 20.0);
            let (first, cost) = run();
            assert!(first.len() > 5 && first.windows(2).all(|w| w[0].time <= w[1].time));
            let labels = if boundary == Boundary::Walls { 0..=8 } else { 1..=8 };
            assert!(first.iter().all(|i| labels.contains(&i.gap) && i.closing_speed > 0.0));
            assert_eq!((first, cost), run(), "{}", method.name());
        }
    }
}

/// A run that is stopped by its receiver ends right there, and one that goes on from a state in the
/// middle finds what the whole run finds.
#[test]
fn runs_stop_and_go_on() {
    let scenario = chain(8, Boundary::Ring, 0.3, 6);
    let mut engine = Engine::new(&scenario).unwrap();
    engine.run(30.0, |_| true).unwrap();
    let start = State {
        time: 30.0,
        positions: engine.positions(30.0),
        velocities: engine.velocities(30.0),
    };
    let exact = run(&mut engine, 35.0);
    for method in all() {
        let mut found = Vec::new();
        let cost = method.run(&scenario, &start, 35.0, &mut |impact| {
            found.push(impact);
            found.len() < 3
        });
        assert_eq!((cost.unwrap().impacts, found.len()), (3, 3), "{}", method.name());
        for (exact, found) in exact.iter().zip(&found) {
            assert_eq!(exact.gap, found.gap, "{}", method.name());
            assert!(
                (exact.time - found.time).abs() < 0.02,
                "{}: {exact:?} {found:?}",
                method.name()
            );
        }
        assert_eq!(method.run(&scenario, &start, 29.0, &mut |_| true).unwrap().impacts, 0);
    }
}

/// A look or a step may end with the last bit of an impact's time, when the gap is shut but opens.
#[test]
fn runs_may_end_at_an_impact() {
    let scenario = chain(20, Boundary::Walls, 0.3, 7);
    for step in [0.01, 0.1] {
        let sampled = Sampled { step };
        for impact in impacts(&sampled, &scenario, 10.0) {
            let mut until = impact.time.next_down();
            for _ in 0..5 {
                until = until.next_up();
                let found = impacts(&sampled, &scenario, until);
                assert!(found.iter().all(|i| i.time <= until && i.closing_speed > 0.0));
            }
        }
    }
    let runge_kutta = RungeKutta { tolerance: 1e-9 };
    for impact in impacts(&runge_kutta, &scenario, 10.0) {
        for after in [0.0, 1e-15, 1e-14] {
            impacts(&runge_kutta, &scenario, impact.time + after);
        }
    }
}

#[test]
fn no_method_loops_or_panics_on_bad_data() {
    let good = chain(2, Boundary::Walls, 0.3, 0);
    let mut overlapped = State::of(&good);
    overlapped.positions.swap(0, 1);
    let broken = Scenario { restitution: f64::NAN, ..good.clone() };
    // A speed of 1e7 between walls: ten million impacts a unit of time, or none at all that is seen.
    let hot = free(&[[0.0, 1e7]], 1.0);
    for method in all() {
        let name = method.name();
        let run = |scenario: &Scenario, start: &State, until: f64| {
            method.run(scenario, start, until, &mut |_| true)
        };
        assert!(
            matches!(run(&good, &overlapped, 9.0), Err(Error::Overlap { gap: 1, .. })),
            "{name}"
        );
        assert!(matches!(run(&broken, &State::of(&good), 9.0), Err(Error::Input { .. })), "{name}");
        let other = State::of(&chain(3, Boundary::Walls, 0.1, 0));
        assert!(matches!(run(&good, &other, 9.0), Err(Error::Input { .. })), "{name}");
        assert!(run(&good, &State::of(&good), f64::NAN).is_err(), "{name}");
        match run(&hot, &State::of(&hot), 1.0) {
            Err(Error::Work { time, .. }) => assert!(time <= 1.0, "{name}"),
            other => assert!(other.is_ok(), "{name}: {other:?}"),
        }
        let ring = Scenario { boundary: Boundary::Ring, ..free(&[[0.3, 0.1]], 0.5) };
        assert_eq!(run(&ring, &State::of(&ring), 9.0).unwrap().impacts, 0, "{name}: one on a ring");
    }
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY, 2.0, 1e-300] {
        let steps: [&dyn Method; 5] = [
            &Sampled { step },
            &Newton { step },
            &MoreauJean { step },
            &Verlet { step },
            &Penalty { step },
        ];
        for method in steps {
            let error = trace(method, &good, 1.0).1.unwrap_err().to_string();
            assert!(error.starts_with("step: "), "{}: {error}", method.name());
        }
        let error = trace(&RungeKutta { tolerance: step }, &good, 1.0).1.unwrap_err().to_string();
        assert!(error.starts_with("tolerance: "), "{error}");
    }
}
