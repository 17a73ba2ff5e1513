//! Where methods fail: grazing, tiny separation speeds, contact, long waits, exact zeros, no work
//! at all, too much work. Each scene is built so that the outcome is known beforehand.

use crate::reference::{Big, Dd, Gap, Real, Reference};
use crate::{first, given, run};
use impact_paper::dynamics::methods::State;
use impact_paper::dynamics::{Counters, Engine, Error, Initial, Scenario};
use impact_paper::numerics::first_root::{Next, Search, Work};
use impact_paper::numerics::local_frame::{Frame, Frequencies};
use impact_paper::numerics::random::NormalPairs;
use impact_paper::params::Chain;

/// One mass between walls, with free part (a, b) and forcing (α, β).
fn one(free: [f64; 2], forcing: [f64; 2], restitution: f64) -> Scenario {
    Scenario { restitution, ..given(vec![free], vec![forcing]) }
}

#[test]
fn dips_of_any_depth_are_hit_or_missed_rightly() {
    // A dip of gap 0 is moved to ±10^-k by the choice of d; the reference knows its depth.
    let mut normals = NormalPairs::new("dips", 1, 0);
    let (mut dips, mut worst) = (0, 0.0f64);
    while dips < 40 {
        let (free, forcing) = (normals.pair(), normals.pair());
        let scene = |d: f64| Scenario { spacing: d, ..one(free, forcing, 0.8) };
        // The first dip: the lowest place of the displacement after its first fall.
        let displacement = |t: f64| Reference::<Dd>::new(&scene(1.0)).gap(0).jet(&Dd::of(t));
        let at = |t: f64| displacement(t).map(|x| x.near());
        let mut t = 0.3;
        while t < 8.0 && !(at(t)[1] < 0.0 && at(t + 0.05)[1] >= 0.0) {
            t += 0.05;
        }
        for _ in 0..40 {
            let [_, g, h] = at(t);
            t -= g / h.abs().max(1e-3);
        }
        let [low, slope, bend] = at(t);
        let depth = 1.0 - low;
        // Only clear dips that nothing comes before, of a mass that stays away from the other wall.
        let clear = slope.abs() < 1e-12 && bend > 0.3 && depth > 0.5 && (0.5..8.0).contains(&t);
        let before = (0..=(t / 0.01) as usize).map(|i| at(0.01 * i as f64)[0] - 1.0);
        if !clear || before.clone().any(|u| u > 0.9 * depth || u < -depth * 1.000_000_1) {
            continue;
        }
        if before.take((t / 0.01) as usize - 40).any(|u| u < -0.95 * depth) {
            continue;
        }
        dips += 1;
        for k in 2..=14 {
            for sign in [1.0, -1.0] {
                let scenario = scene(depth + sign * 10f64.powi(-k));
                let until = t + 0.3;
                let theirs = Reference::<Dd>::new(&scenario).gap(0);
                let theirs = theirs.first_root(&Dd::of(0.0), &Dd::of(until)).unwrap();
                assert_eq!(theirs.is_some(), sign < 0.0, "the scene itself, k = {k}");
                let ours = first(&mut Engine::new(&scenario).unwrap(), until);
                assert_eq!(ours.is_some(), sign < 0.0, "dip {dips}, depth {sign}e-{k}");
                if let (Some(ours), Some(theirs)) = (ours, theirs) {
                    let speed = (2.0 * 10f64.powi(-k) * bend).sqrt();
                    let error = (Dd::of(ours.time) - theirs).near().abs();
                    let units = error * speed / (f64::EPSILON * (2.0 * depth + 1.0));
                    worst = worst.max(units);
                    assert!(units < 8.0, "dip {dips}, depth 1e-{k}: {units}");
                }
            }
        }
    }
    println!("grazing times: |δt| ≤ {worst:.2} ε (d + R1 + R2) / |Δ'|");
}

/// The chain of one mass that leaves the left wall at t = 0 with speed v under −5 of acceleration:
/// with Ω = 2 all its numbers are exact.
fn thrown(v: f64) -> Scenario {
    Scenario { forcing_frequency: 2.0, ..one([-3.0, v], [-6.0, 0.0], 0.5) }
}

#[test]
fn tiny_separation_speeds_keep_their_waiting_times() {
    for k in 1..=15 {
        let v = 10f64.powi(-k);
        let scenario = thrown(v);
        let gap = Reference::<Big>::new(&scenario).gap(0);
        let exact = gap.first_root(&Big::of(0.0), &Big::of(1.0)).unwrap().expect("it falls back");
        // The search itself: relative, however short the wait.
        let search = Search::new(Frequencies::new(1.0, [2.0]));
        let forced = [[2.0, 0.0]];
        let bound = 16.0 * 2.0 + 3.1;
        let frame = Frame { f0: 0.0, g0: v, alpha: -3.0, forced, bound, size: 15.0 };
        let mut work = Work::default();
        let Next::Root { s, .. } = search.first_root(&frame, &mut work) else {
            panic!("v = 1e-{k}: no root");
        };
        let relative = ((Big::of(s) - exact.clone()) / exact.clone()).near().abs();
        assert!(relative < 1e-13, "v = 1e-{k}: relative error {relative:e} of the search");
        // The engine: the same up to one tick of its clock, 2^-80.
        let hit = first(&mut Engine::new(&scenario).unwrap(), 1.0).expect("it falls back");
        let error = (Big::of(hit.time) - exact.clone()).near().abs();
        let allowed = 1e-13 * exact.near() + 2.0 * 2f64.powi(-80);
        assert!(error < allowed, "v = 1e-{k}: {error:e}, allowed {allowed:e}");
    }
}

#[test]
fn at_a_shut_gap_speed_decides_then_acceleration() {
    // x_1 = 0 at t = 0 exactly, pulled off by the spring: Δ'' = 1 with β alone.
    for (v, hits_now) in [(0.5, false), (0.0, false), (-0.5, true)] {
        // x' = b + β Ω/(ω² − Ω²) = b − 2 β/3 with Ω = 2.
        let scenario =
            Scenario { forcing_frequency: 2.0, ..one([-1.0, 0.25 + v], [0.0, 0.375], 0.8) };
        let mut engine = Engine::new(&scenario).unwrap();
        let theirs = Reference::<Dd>::new(&scenario).run(20.0).unwrap();
        for (i, b) in theirs.iter().enumerate() {
            let a = first(&mut engine, 20.0).expect("as many impacts as the reference");
            assert_eq!(i == 0 && a.time == 0.0, i == 0 && hits_now, "v = {v}: {a:?}");
            assert_eq!(a.gap, b.gap);
            assert!((Dd::of(a.time) - b.time).near().abs() < 1e-11, "v = {v}: {a:?}");
        }
        assert!(theirs.len() > 2 && first(&mut engine, 20.0).is_none());
    }
    // Pressed against the wall at rest: contact from the start, with force Ω² c + ω² a = 5.
    let engine = Engine::new(&thrown(0.0)).unwrap();
    assert_eq!(engine.counters().contact_phases, 1);
    let contacts = engine.contacts(0.0);
    assert!(contacts.len() == 1 && contacts[0].0 == 0, "{contacts:?}");
    assert!((contacts[0].1 - 5.0).abs() < 1e-14, "{contacts:?}");
}

#[test]
fn chattering_ends_in_contact_and_contact_in_release() {
    let [alpha, beta] = [5.88, -4.94];
    let scenario = Scenario { initial: Initial::Rest, ..one([0.0; 2], [alpha, beta], 0.2) };
    let w = scenario.forcing_frequency;
    let force = |t: f64| alpha * (w * t).cos() + beta * (w * t).sin();
    // What presses the mass on the wall of a gap: −Δ'' at Δ = 0.
    let pressure = |gap: usize, t: f64| if gap == 0 { -1.0 - force(t) } else { force(t) - 1.0 };
    let mut engine = Engine::new(&scenario).unwrap();
    let (mut held, mut releases): (Option<usize>, usize) = (None, 0);
    let step = 1.0 / 512.0;
    for i in 1..(40.0 / step) as usize {
        let t = step * i as f64;
        run(&mut engine, t);
        let x = engine.positions(t)[0];
        assert!((-1e-14..=2.0 + 1e-14).contains(&x), "x = {x} at {t}");
        let contacts = engine.contacts(t);
        if let [(gap, f)] = contacts[..] {
            assert!(f >= 0.0 && (f - pressure(gap, t)).abs() < 1e-12, "force {f} at {t}");
            assert_eq!(x, if gap == 0 { 0.0 } else { 2.0 });
            held = Some(gap);
        } else if let Some(gap) = held.take() {
            // Released since the last look, in which the force changed its sign.
            releases += 1;
            let kept = pressure(gap, t - step) >= 0.0 && pressure(gap, t) <= 0.0;
            assert!(kept, "released at {t}");
        }
    }
    let counters = engine.counters();
    println!("{counters:?}, {releases} releases");
    assert!(releases >= 3 && counters.contact_phases as usize >= releases);
    assert!(counters.impacts < 2000, "a chatter is cut short: {counters:?}");
}

#[test]
fn squeezed_clusters_press_and_never_overlap() {
    for (index, n) in [(0, 3), (1, 3), (2, 5), (3, 8)] {
        let chain = Chain { masses: n, restitution: 0.2, ..Chain::default() };
        let mut scenario = Scenario::draw(&chain, 2.0, &mut NormalPairs::new("squeeze", 1, index));
        for (j, pair) in scenario.forcing.iter_mut().enumerate() {
            // Towards the middle at t = 0.
            pair[0] += 2.0 * ((n - 1) as f64 - 2.0 * j as f64);
        }
        let mut engine = Engine::new(&scenario).unwrap();
        for i in 1..2000 {
            let t = f64::from(i) / 50.0;
            engine.run(t, |_| true).unwrap();
            let mut x = vec![0.0];
            x.extend(engine.positions(t));
            x.push((n + 1) as f64);
            for (gap, pair) in x.windows(2).enumerate() {
                let width = pair[1] - pair[0];
                assert!(width > -1e-12, "n = {n}: gap {gap} overlaps by {width:e} at {t}");
            }
            for (gap, force) in engine.contacts(t) {
                assert!(force >= -1e-12, "n = {n}: force {force:e} in gap {gap} at {t}");
                assert!((x[gap + 1] - x[gap]).abs() < 1e-12, "contact is shut");
            }
        }
        assert!(engine.counters().contact_phases > 5, "{:?}", engine.counters());
    }
}

#[test]
fn long_quasi_periodic_waits_end_at_the_first_root() {
    let mut worst: f64 = 0.0;
    let mut rates: Vec<f64> = Vec::new();
    for (k, index) in [(2, 0), (3, 1), (4, 2), (5, 3), (6, 4)] {
        let mut normals = NormalPairs::new("wait", 1, index);
        let [[p, q], [x, y]] = [normals.pair(), normals.pair()];
        // R1 = 0.4 and R2 = 0.6 + 10^-k; the reference computes with the rounded numbers.
        let [r1, r2] = [0.4 / p.hypot(q), -(0.6 + 10f64.powi(-k)) / x.hypot(y)];
        let scenario = one([r1 * p, r1 * q], [r2 * x, r2 * y], 0.8);
        let exact = Reference::<Dd>::new(&scenario).step(&Dd::of(1e6)).unwrap().unwrap();
        let mut engine = Engine::new(&scenario).unwrap();
        let hit = first(&mut engine, 1e6).expect("it closes in the end");
        let t = exact.time.near();
        assert_eq!(hit.gap, exact.gap, "k = {k}");
        let error = (Dd::of(hit.time) - exact.time).near().abs() - 0.5 * (t.next_up() - t);
        let units = error * exact.closing_speed.near() / (f64::EPSILON * 2.0);
        worst = worst.max(units);
        let counters = engine.counters();
        let work = counters.searches + counters.pieces + counters.evaluations;
        let rate = work as f64 / t;
        println!("k = {k}: first impact at t = {t:.0}, {rate:.2} pieces of work a unit of time");
        assert!(units < 8.0, "k = {k}, t = {t}: {units}");
        rates.push(rate);
    }
    // Long waits, of hundreds of windows, cost no more for each than short ones, and almost nothing.
    assert!(rates[0] < 5.0 && rates[1..].iter().all(|rate| *rate < 0.3), "{rates:?}");
    println!("long waits: |δt| ≤ {worst:.2} ε (d + R1 + R2) / |Δ'| beyond the rounding of t");
}

#[test]
fn gaps_that_cannot_close_cost_nothing() {
    let chain = Chain { masses: 50, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.04, &mut NormalPairs::new("quiet", 1, 0));
    let mut engine = Engine::new(&scenario).unwrap();
    engine.run(1e9, |_| true).unwrap();
    // Not one search, piece or evaluation.
    assert_eq!(engine.counters(), Counters::default());
}

#[test]
fn work_is_bounded_and_says_where() {
    // A mass with a speed of 1e7 between walls hits them ten million times a unit of time.
    let mut engine = Engine::new(&one([0.0, 1e7], [0.0, 0.0], 1.0)).unwrap();
    match engine.run(10.0, |_| true) {
        Err(Error::Work { gap, time, bound }) => {
            assert!(gap <= 1 && (0.0..1.0).contains(&time));
            assert!(engine.counters().impacts <= bound);
            let said = Error::Work { gap, time, bound }.to_string();
            assert!(said.contains(&format!("gap {gap};")), "{said}");
            assert!(said.contains(&format!("t = {time}")), "{said}");
        }
        other => panic!("{other:?}"),
    }
    // An almost elastic chatter, and a hard squeeze: finished, and cheaply.
    for r in [0.99, 0.9, 0.0] {
        let scenario = Scenario { initial: Initial::Rest, ..one([0.0; 2], [5.88, -4.94], r) };
        let mut engine = Engine::new(&scenario).unwrap();
        engine.run(100.0, |_| true).unwrap();
        assert!(engine.counters().impacts < 60_000, "r = {r}: {:?}", engine.counters());
    }
}

#[test]
fn a_wait_is_as_exact_from_a_million_million_as_from_zero() {
    // A mass at its centre with speed 1/2: each wall in absolute time, with 77 digits.
    let scenario = one([0.0; 2], [0.6, -0.5], 0.8);
    let mut worst: f64 = 0.0;
    for time in [0.0, 1e4, 1e6 + 0.5, 1e8, 1e10 + 0.25, 1e12 - 128.0] {
        let start = State { time, positions: vec![1.0], velocities: vec![0.5] };
        let hit = first(&mut Engine::new(&start.as_scenario(&scenario).unwrap()).unwrap(), 20.0);
        let hit = hit.expect("it comes to a wall");
        let t = Big::of(time);
        let [w, big_w] = [Big::of(1.0), Big::of(scenario.forcing_frequency)];
        let factor = w.clone() - big_w.clone() * big_w.clone();
        let forced = scenario.forcing[0].map(|x| Big::of(x) / factor.clone());
        let response = Gap {
            spacing: Big::of(0.0),
            frequencies: vec![w.clone(), big_w],
            amplitudes: vec![[Big::of(0.0), Big::of(0.0)], forced],
        };
        let [place, rate, _] = response.jet(&t);
        let (u, v) = (-place, Big::of(0.5) - rate);
        let (s, c) = t.sin_cos();
        let free = [u.clone() * c.clone() - v.clone() * s.clone(), u * s + v * c];
        let [own, forced] = [free, response.amplitudes[1].clone()];
        // Gap 0 is x, gap 1 is 2 − x.
        let signed = |pair: &[Big; 2], sign: f64| pair.clone().map(|x| x * Big::of(sign));
        let walls = [1.0, -1.0].map(|sign| Gap {
            spacing: w.clone(),
            frequencies: response.frequencies.clone(),
            amplitudes: vec![signed(&own, sign), signed(&forced, sign)],
        });
        let until = t.clone() + Big::of(20.0);
        let roots = walls.map(|wall| wall.first_root(&t, &until).unwrap());
        let exact = roots[hit.gap].clone().expect("the same wall") - t.clone();
        let other = roots[1 - hit.gap].clone().map(|root| (root - t).near());
        assert!(other.is_none_or(|other| other > exact.near()), "the other wall comes first");
        let error = (Big::of(hit.time) - exact).near().abs() * hit.closing_speed;
        let units = error / (f64::EPSILON * 3.0);
        worst = worst.max(units);
        assert!(units < 4.0, "from t = {time}: {units}");
    }
    println!("waits from up to t = 1e12: |δs| ≤ {worst:.2} ε (d + R1 + R2) / |Δ'|");
}
