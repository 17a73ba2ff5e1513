//! Tests the rivals of the engine: each converges at its order, and fails as documented.

use crate::{drawn, given, unforced};
use impact_chain::methods::{
    Advancement, Certified, Cost, CountedSteps, Method, MoreauJean, Penalty, RungeKutta, Sampled,
    Task, Verlet, VerletAbreast,
};
use impact_chain::{
    Boundary, Chain, Engine, Error, HitGaps, Impact, Initial, NormalPairs, Scenario, Seed, State,
};

fn chain(masses: usize, boundary: Boundary, sigma: f64, index: u64) -> Scenario {
    let (spacing, w) = if boundary == Boundary::Ring { (2.0, 1.25) } else { (1.0, 1.0) };
    let chain = Chain { masses, boundary, spacing, natural_frequency: w, ..Chain::default() };
    let chain = Chain { forcing_frequency: w * chain.forcing_frequency, ..chain };
    drawn(&chain, sigma * spacing * w * w, "methods", index)
}

type Trace = (Vec<Impact>, Result<Cost, Error>);

fn trace(method: &dyn Method, scenario: &Scenario, until: f64) -> Trace {
    let mut impacts = Vec::new();
    let task = Task { scenario, start: &State::from_scenario(scenario), until };
    let cost = method.run(task, &mut |impact| {
        impacts.push(impact);
        true
    });
    (impacts, cost)
}

fn impacts(method: &dyn Method, scenario: &Scenario, until: f64) -> Vec<Impact> {
    method.impacts(Task { scenario, start: &State::from_scenario(scenario), until }).unwrap()
}

/// All methods, of which the first has no step; `size` changes steps and tolerances.
fn methods(size: impl Fn(f64) -> f64) -> Vec<Box<dyn Method>> {
    vec![
        Box::new(Certified),
        Box::new(Sampled { step: size(0.01), least_rebound: 0.0 }),
        Box::new(Advancement { tolerance: size(1e-13), least_rebound: 0.0 }),
        Box::new(RungeKutta { tolerance: size(1e-9), least_rebound: 0.0 }),
        Box::new(MoreauJean { step: size(1e-3) }),
        Box::new(Verlet { step: size(1e-3) }),
        Box::new(VerletAbreast { step: size(1e-2) }),
        Box::new(Penalty { step: size(1e-4) }),
    ]
}

/// Root mean square of the errors of the first impacts' times at each gap, and the cost.
fn error_of(method: &dyn Method) -> (f64, Cost) {
    let (mut sum, mut count, mut total) = (0.0, 0u32, Cost::default());
    for boundary in [Boundary::Walls, Boundary::Ring] {
        for index in 0..8 {
            let scenario = chain(6, boundary, 0.35, index);
            let exact = impacts(&Certified, &scenario, 6.0);
            let (impacts, cost) = trace(method, &scenario, 7.0);
            let cost = cost.unwrap();
            total.steps += cost.steps;
            total.evaluations += cost.evaluations;
            // Order within a step is lost: the first two impacts of each gap are compared.
            for (i, hit) in exact.iter().enumerate() {
                let of_gap = |other: &&Impact| other.gap == hit.gap;
                let place = exact[..i].iter().filter(of_gap).count();
                if place < 2 {
                    let name = method.name();
                    let other = impacts.iter().filter(of_gap).nth(place);
                    let other = other.unwrap_or_else(|| panic!("{name} has no {hit:?}"));
                    sum += (hit.time - other.time).powi(2);
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
        [e / f, d.steps as f64 / c.steps as f64]
    };
    let by_steps: [([&dyn Method; 2], f64); 4] = [
        // 3 for times, 2 for speeds.
        ([&VerletAbreast { step: 0.2 }, &VerletAbreast { step: 0.05 }], 2.5),
        ([&Verlet { step: 1e-3 }, &Verlet { step: 2e-5 }], 1.0),
        ([&MoreauJean { step: 1e-3 }, &MoreauJean { step: 2e-5 }], 1.0),
        ([&Penalty { step: 1e-3 }, &Penalty { step: 2e-5 }], 0.5),
    ];
    for (methods, expected) in by_steps {
        let [errors, steps] = grown(methods);
        let order = errors.ln() / steps.ln();
        let off = (order - expected).abs() / expected.max(1.0);
        assert!(off < 0.1, "{}: {order}", methods[0].name());
    }
    // The error is the tolerance's, over five decades, and the steps are its fifth root.
    let [coarse, fine] =
        [1e-6, 1e-11].map(|tolerance| RungeKutta { tolerance, least_rebound: 0.0 });
    let [error, steps] = grown([&coarse, &fine]).map(|x| x.log10() / 5.0);
    assert!((error - 1.0).abs() < 0.15 && (steps - 0.2).abs() < 0.03, "{error} {steps}");
}

/// It ends where its receiver stops it, and from a state finds what the whole run finds.
#[test]
fn runs_stop_and_go_on() {
    for boundary in [Boundary::Walls, Boundary::Ring] {
        let scenario = chain(8, boundary, 0.3, 6);
        let mut engine = Engine::new(&scenario).unwrap();
        engine.advance(30.0).unwrap();
        let start = engine.state(30.0).unwrap();
        let exact = engine.impacts(40.0).unwrap();
        let more: Box<dyn Method> = Box::new(Sampled { step: 0.1, least_rebound: 0.0 });
        for method in methods(|size| size).into_iter().chain([more]) {
            let name = method.name();
            let mut impacts: Vec<Impact> = Vec::new();
            let task = Task { scenario: &scenario, start: &start, until: 40.0 };
            let cost = method.run(task, &mut |impact| {
                impacts.push(impact);
                impacts.len() < 3
            });
            assert_eq!((cost.unwrap().impacts, impacts.len()), (3, 3), "{name}");
            let closed = ["certified", "sampled", "advancement"].contains(&name);
            let room = if closed { 1e-12 } else { 0.02 };
            for (exact, impact) in exact.iter().zip(&impacts) {
                let off = (exact.time - impact.time).abs();
                assert!(exact.gap == impact.gap && off < room, "{name}: {exact:?} {impact:?}");
            }
            let refused = method.impacts(Task { until: 29.0, ..task }).unwrap_err();
            assert!(refused.to_string().starts_with("until: 29.0"), "{name}: {refused}");
        }
    }
}

/// Methods find the same impacts to the last bit, whatever vectors the processor has.
#[test]
fn vectors_change_no_bits() {
    let traces = || {
        let chains = [Boundary::Walls, Boundary::Ring].map(|boundary| chain(70, boundary, 0.3, 1));
        let runs = methods(|size| size)
            .into_iter()
            .flat_map(|method| chains.each_ref().map(|scenario| trace(&*method, scenario, 10.0).0));
        runs.collect::<Vec<_>>()
    };
    let wide = traces();
    impact_chain::without_wide_vectors();
    assert!(wide == traces() && wide.iter().all(|run| run.len() > 20));
}

#[test]
fn no_method_loops_or_panics_on_bad_data() {
    let good = chain(2, Boundary::Walls, 0.3, 0);
    let mut overlapped = State::from_scenario(&good);
    overlapped.positions.swap(0, 1);
    let broken = Scenario { restitution: f64::NAN, ..good.clone() };
    // A speed of 1e7 between walls: ten million impacts a unit of time, or none found.
    let hot = unforced(&[[0.0, 1e7]], 1.0);
    for method in methods(|size| size) {
        let name = method.name();
        let run = |scenario: &Scenario, start: &State, until: f64| {
            method.run(Task { scenario, start, until }, &mut |_| true)
        };
        let overlap = run(&good, &overlapped, 9.0);
        assert!(matches!(overlap, Err(Error::Overlap { gap: 1, .. })), "{name}");
        let other = State::from_scenario(&chain(3, Boundary::Walls, 0.1, 0));
        for refused in [run(&broken, &State::from_scenario(&good), 9.0), run(&good, &other, 9.0)] {
            assert!(matches!(refused, Err(Error::Input { .. })), "{name}");
        }
        assert!(run(&good, &State::from_scenario(&good), f64::NAN).is_err(), "{name}");
        match run(&hot, &State::from_scenario(&hot), 1.0) {
            Err(Error::Work { time, .. }) => assert!(time <= 1.0, "{name}"),
            other => assert!(other.is_ok(), "{name}: {other:?}"),
        }
        let ring = Scenario { boundary: Boundary::Ring, ..unforced(&[[0.3, 0.1]], 0.5) };
        let alone = run(&ring, &State::from_scenario(&ring), 9.0).unwrap();
        assert_eq!(alone.impacts, 0, "{name}: one on a ring");
    }
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY, 2.0, 1e-300] {
        for method in &methods(|_| step)[1..] {
            let error = trace(&**method, &good, 1.0).1.unwrap_err().to_string();
            let named = error.starts_with("step: ") || error.starts_with("tolerance: ");
            assert!(named, "{}: {error}", method.name());
        }
    }
}

/// θ = 1/2 turns a free part by 2 arctan(ωh/2) a step, and responds as to (2/h) tan(Ωh/2).
#[test]
fn a_flight_by_the_implicit_midpoint_rule_is_known_in_closed_form() {
    let (w, big_w, h) = (1.3, 0.7, 0.2);
    let (turn, rate) = (2.0 * (0.5_f64 * w * h).atan(), 2.0 / h * (0.5_f64 * big_w * h).tan());
    let one = given(vec![[0.0; 2]], vec![[0.42, -0.5]]);
    let one = Scenario { natural_frequency: w, forcing_frequency: big_w, ..one };
    let [c, s] = one.forcing[0].map(|force| force / (w * w - rate * rate));
    for [a, b] in [[0.5, 0.0], [-0.1, 0.49], [0.3, -0.42], [-0.46, -0.1]] {
        let motion = |n: f64| {
            let ((sin, cos), (big_sin, big_cos)) =
                ((n * turn).sin_cos(), (n * h * big_w).sin_cos());
            let v = w * (b * cos - a * sin) + rate * (s * big_cos - c * big_sin);
            [a * cos + b * sin + c * big_cos + s * big_sin, v]
        };
        let [u, v] = motion(0.0);
        let start = State { time: 0.0, positions: vec![1.0 + u], velocities: vec![v] };
        let task = Task { scenario: &one, start: &start, until: 40.0 };
        let hit = MoreauJean { step: h }.impacts(task).unwrap()[0];
        let mut steps = (0..200).map(f64::from).map(|n| (n, motion(n)));
        let (n, [_, v]) = steps.find(|(_, [u, v])| (u + 0.5 * h * v).abs() >= 1.0).unwrap();
        let off = (hit.closing_speed - v.abs()).abs().max((hit.time - (n + 0.5) * h).abs());
        assert!(n > 9.0 && off < 1e-12 && hit.gap == usize::from(v > 0.0), "{n}: {hit:?}");
    }
}

/// Evaluations of three masses and four gaps where nothing moves.
#[test]
fn costs_are_counted_as_declared() {
    for method in &methods(|size| size)[1..] {
        let cost = trace(&**method, &unforced(&[[0.0; 2]; 3], 0.5), 1.0).1.unwrap();
        let expected = match method.name() {
            // The first step looks at each gap at both of its ends.
            "sampled" => 4 + cost.steps * 4 + 2 * 4,
            "advancement" => 4,
            "runge-kutta" => 3 + cost.steps * (6 * 3 + 4),
            _ => cost.steps * (3 + 4),
        };
        assert_eq!(cost.evaluations, expected, "{}: {cost:?}", method.name());
    }
}

/// A gap is evaluated again at the zero of the parabola below it, or never if it is safe.
#[test]
fn an_advance_goes_to_the_zero_of_the_parabola() {
    let (frequencies, mut safe) = ([1.1, 0.6], 0);
    for index in 0..100 {
        let mut normals = NormalPairs::new("advance", Seed(1), index);
        let parts = [(); 2].map(|()| [(); 3].map(|()| normals.pair().map(|x| 0.25 * x)));
        let forcing = parts[1].map(|part| part.map(|x| (1.21 - 0.36) * x)).to_vec();
        let one = Scenario { forcing_frequency: 0.6, ..given(parts[0].to_vec(), forcing) };
        let one = Scenario { natural_frequency: 1.1, ..one };
        let wait = |gap: usize| {
            let [mut f, mut g, mut reach, mut bend] = [1.0, 0.0, 0.0, 0.0];
            for (w, part) in frequencies.iter().zip(&parts) {
                let side = |m: usize| if m.is_multiple_of(4) { [0.0; 2] } else { part[m - 1] };
                let [left, right] = [side(gap), side(gap + 1)];
                let [x, y] = [right[0] - left[0], right[1] - left[1]];
                (f, g, reach) = (f + x, g + w * y, reach + x.hypot(y));
                bend += w * w * x.hypot(y);
            }
            if reach < 1.0 { f64::INFINITY } else { (g + (g * g + 2.0 * f * bend).sqrt()) / bend }
        };
        let wait = (0..4).map(wait).fold(f64::INFINITY, f64::min);
        let method = Advancement { tolerance: 1e-13, least_rebound: 0.0 };
        let ends = [1.0 - 1e-6, 1.0 + 1e-6].map(|factor| (factor * wait).min(1e3));
        let evaluations = ends.map(|end| trace(&method, &one, end).1.map(|cost| cost.evaluations));
        safe += usize::from(evaluations[0].is_ok() && wait.is_infinite());
        let expected = [Ok(4), Ok(4 + u64::from(wait.is_finite()))];
        let is_right = evaluations[0].is_err() || evaluations == expected;
        assert!(is_right, "{index}: {wait}, {evaluations:?}");
    }
    assert!((5..60).contains(&safe), "{safe}");
}

/// Between walls 2000 apart a mass of amplitude A hits each at a sample, to rounding, and must not
/// twice. A ball at 1/20 above a wall, to which it is pulled by 20, bounces ten times in a step.
#[test]
fn impacts_at_samples_and_within_a_step_are_found_once() {
    for amplitude in (1..40).map(|i| 1000.0 + 37.0 * f64::from(i)) {
        let orbit = Scenario { spacing: 1000.0, ..unforced(&[[0.0, amplitude]], 1.0) };
        let half = (1000.0 / amplitude).asin();
        let hits = impacts(&Sampled { step: half / 4.0, least_rebound: 0.0 }, &orbit, 40.5 * half);
        // Between samples ten evaluations an impact are enough, looks at ends of steps included.
        let between = Sampled { step: half / 3.7, least_rebound: 0.0 };
        let cost = trace(&between, &orbit, 40.5 * half).1.unwrap();
        assert!(cost.evaluations - 2 * cost.steps <= 200, "{amplitude}: {cost:?}");
        let off = |(i, hit): (u32, &Impact)| (hit.time - f64::from(2 * i + 1) * half).abs();
        let worst = (0..).zip(&hits).map(off).fold(0.0, f64::max);
        assert!(hits.len() == 20 && worst < 1e-11, "{amplitude}: {worst:e}, {hits:?}");
    }
    let ball = given(vec![[-0.95 + 20.0, 0.0]], vec![[-20.0 + 1e-3, 0.0]]);
    let ball = Scenario { forcing_frequency: 1e-2, restitution: 0.5, ..ball };
    let methods: [&dyn Method; 2] = [&Sampled { step: 0.5, least_rebound: 0.0 }, &Certified];
    let [sampled, exact] = methods.map(|method| trace(method, &ball, 0.5).0);
    let off = |i: usize| (sampled[i].time - exact[i].time).abs() * exact[i].closing_speed;
    assert!((0..10).all(|i| sampled[i].gap == 0 && off(i) < 1e-14), "{sampled:?}, {exact:?}");
}

/// A mass at a sin t hits at arcsin(1/a), also if it comes through a wall and back in a step.
#[test]
fn impacts_are_placed_within_the_steps_of_verlet_abreast() {
    let mut sums = [0.0; 2];
    for a in (0..200).map(|i| 1.0003 + 0.0002 * f64::from(i * i)) {
        let orbit = unforced(&[[0.0, a]], 0.5);
        let exact = (1.0 / a).asin();
        let methods: [&dyn Method; 2] = [&VerletAbreast { step: 0.1 }, &Verlet { step: 0.1 }];
        let [hit, late] = methods.map(|method| impacts(method, &orbit, 9.0).first().copied());
        let hit = hit.unwrap();
        let (off, speed) = ((hit.time - exact).abs(), (a * a - 1.0).sqrt());
        assert!(hit.gap == 1 && off * speed < 1e-5 * a, "{a}: {off:e}");
        assert!((hit.closing_speed - speed).abs() < 1e-3 * a, "{a}: {hit:?}");
        sums[0] += off;
        sums[1] += late.map_or(0.1, |late| late.time.min(exact + 0.1) - exact);
    }
    assert!(sums[1] > 100.0 * sums[0], "{sums:?}");
    // The force counts within a step too: here it is 8 and more.
    for part in (0..24).map(|i| 0.26 * f64::from(i)).map(f64::sin_cos) {
        let orbit = given(vec![[0.0, 0.3]], vec![[8.0 * part.0, 8.0 * part.1]]);
        let orbit = Scenario { forcing_frequency: 3.0, ..orbit };
        let methods: [&dyn Method; 2] = [&VerletAbreast { step: 0.1 }, &Certified];
        let [hit, exact] = methods.map(|method| impacts(method, &orbit, 9.0)[0]);
        let off = (hit.time - exact.time).abs() * exact.closing_speed;
        assert!(exact.time < 0.01 || off < 3e-4, "{hit:?} {exact:?}");
    }
}

/// A blow goes through a row of masses that nearly touch within one step.
#[test]
fn verlet_abreast_carries_a_blow_through_a_row() {
    let row: Vec<_> = (0..6).map(|j| [2.4975 - 0.999 * f64::from(j), 0.0]).collect();
    let mut blow = unforced(&row, 0.9);
    blow.initial = Initial::Free([&[[row[0][0], 4.0]], &row[1..]].concat());
    let gaps = |method: &dyn Method| -> Vec<usize> {
        impacts(method, &blow, 0.05).iter().map(|impact| impact.gap).collect()
    };
    assert_eq!(gaps(&VerletAbreast { step: 0.05 }), [1, 2, 3, 4, 5]);
    assert_eq!(gaps(&Certified), [1, 2, 3, 4, 5]);
}

/// A chain has the same bits alone and beside others, and the gaps that are counted are its own.
#[test]
fn chains_abreast_do_not_touch() {
    let walls = |index: u64| chain(30, Boundary::Walls, [0.3, 0.02][index as usize % 5 / 4], index);
    let chains: Vec<Scenario> = (0..40).map(walls).collect();
    let method = VerletAbreast { step: 0.25 };
    let mut together = vec![Vec::new(); chains.len()];
    let mut receive = |chain: usize, impact: Impact| {
        together[chain].push(impact);
        together[chain].len() < 200 - 4 * chain
    };
    method.run_all(&chains, 30.0, &mut receive).unwrap();
    let counts = [HitGaps::All, HitGaps::One].map(|until| {
        let steps = CountedSteps { from: 10.0, until };
        method.count_gaps(&chains, 30.0, steps).unwrap().1
    });
    for (chain, (scenario, together)) in chains.iter().zip(&together).enumerate() {
        let alone = impacts(&method, scenario, 30.0);
        assert!(alone[..alone.len().min(200 - 4 * chain)] == *together, "{chain}");
        let gaps = (0..31).filter(|gap| alone.iter().any(|i| i.gap == *gap && i.time > 10.0));
        assert_eq!(counts[0][chain] as usize, gaps.count(), "{chain}");
        assert_eq!(counts[1][chain] > 0, counts[0][chain] > 0, "{chain}");
    }
    assert!(together.iter().flatten().count() > 1000 && together[4].is_empty());
    let other = [chains[0].clone(), Scenario { restitution: 0.5, ..chains[1].clone() }];
    assert!(method.run_all(&other, 30.0, &mut |_, _| true).is_err());
}
