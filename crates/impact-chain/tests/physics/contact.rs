//! Tests contact of pairs and clusters, and gaps that close at one instant. Ω = 2 and cosine
//! forcing only, so a mass under F cos Ωt is at j d + a − F/3 at t = 0, and forces are known.

use crate::{drawn, given, ran};
use impact_chain::{Boundary, Chain, End, Engine, Event, Impact, Initial, Scenario, State};
use std::collections::BTreeSet;
use std::ops::ControlFlow::{Break, Continue};

fn scene(masses: &[(f64, f64)], forces: &[f64], restitution: f64) -> Scenario {
    let free = masses
        .iter()
        .zip(forces)
        .enumerate()
        .map(|(i, ((x, v), force))| [x - (i + 1) as f64 + force / 3.0, *v])
        .collect();
    let forcing = forces.iter().map(|f| [*f, 0.0]).collect();
    Scenario { forcing_frequency: 2.0, restitution, ..given(free, forcing) }
}

/// The gaps in contact at a time, all with a force that presses.
fn held(engine: &mut Engine, t: f64) -> Vec<usize> {
    assert!(engine.impacts(t).unwrap().is_empty(), "an impact before {t}");
    let contacts = engine.contacts(t).unwrap();
    assert!(contacts.iter().all(|c| c.1 >= 0.0), "{contacts:?} at {t}");
    contacts.into_iter().map(|c| c.0).collect()
}

/// Gaps in contact while cos 2t is above a number; factor and constant of their forces.
type Held = (f64, &'static [(usize, f64, f64)]);

#[test]
fn clusters_are_released_gap_by_gap_where_a_force_changes_its_sign() {
    // A pair; three, of which gap 2 opens first; and two at the wall, of which the left one would
    // leave it without the other: K = (1, 2), g = (1 + 3c, 1 − 10c).
    let pair: [Held; 1] = [(1.0 / 3.0, &[(1, 1.5, -0.5)])];
    let three: [Held; 2] =
        [(0.25, &[(1, 5.0, -1.0), (2, 4.0, -1.0)]), (1.0 / 6.0, &[(1, 3.0, -0.5)])];
    let wall: [Held; 2] = [(0.75, &[(0, 4.0, -3.0), (1, 7.0, -2.0)]), (0.1, &[(1, 5.0, -0.5)])];
    for (masses, forces, phases) in [
        (vec![(1.5, 0.1); 2], vec![1.5, -1.5], &pair[..]),
        (vec![(2.0, 0.0); 3], vec![6.0, 0.0, -3.0], &three),
        (vec![(0.0, 0.0); 2], vec![3.0, -7.0], &wall),
    ] {
        let mut engine = Engine::new(&scene(&masses, &forces, 0.8)).unwrap();
        let mut from = 0.0;
        for (end, gaps) in phases {
            let to = 0.5 * end.acos();
            let after = if from == 0.0 { 0.0 } else { from + 1e-12 };
            for t in [after, 0.5 * (from + to), to - 1e-12] {
                let gaps_held: Vec<usize> = gaps.iter().map(|(gap, ..)| *gap).collect();
                assert_eq!(held(&mut engine, t), gaps_held, "{forces:?} at {t}");
                for ((_, force), (_, factor, constant)) in
                    engine.contacts(t).unwrap().iter().zip(*gaps)
                {
                    let expected = factor * (2.0 * t).cos() + constant;
                    assert!((force - expected).abs() < 1e-13, "{forces:?} at {t}: {force}");
                }
            }
            from = to;
        }
        assert!(held(&mut engine, from + 1e-12).is_empty(), "{forces:?}");
        assert_eq!(engine.counters().contact_phases as usize, phases[0].1.len(), "one a gap");
    }
}

/// With Ω = √2 neither responses nor sums are doubles, so such a pair is apart by some 1e-16.
#[test]
fn a_pair_that_is_shut_but_for_rounding_is_shut() {
    let big_w = std::f64::consts::SQRT_2;
    for i in 1..=50 {
        let force = 0.7 + 0.0313 * f64::from(i);
        let response = force / ((1.0 - big_w) * (1.0 + big_w));
        let mut scenario = scene(&[(1.5, 0.0), (1.5, 0.0)], &[force, -force], 0.8);
        scenario.forcing_frequency = big_w;
        scenario.initial = Initial::Free(vec![[0.5 - response, 0.0], [-0.5 + response, 0.0]]);
        let mut engine = Engine::new(&scenario).unwrap();
        assert_eq!(held(&mut engine, 1e-3), [1], "force {force}");
    }
}

/// Two hits in a row multiply both rates by a matrix with μ² − (1 + r)/2 μ + r = 0: closing speeds
/// fall by the larger root, and waits by the roots' ratio.
#[test]
fn three_masses_collapse_in_a_geometric_series() {
    let masses = [(2.0 - 1e-3, 1.0), (2.0, 0.0), (2.0 + 2e-3, -1.0)];
    for r in [0.0, 0.02, 0.05] {
        // Pressed together, so that contact follows; the middle one between the others.
        let (engine, impacts) = ran(&scene(&masses, &[9.0, 0.0, -9.0], r), 0.1);
        assert!(impacts.len() < 80, "r = {r}: a collapse is cut short, {}", impacts.len());
        let contacts = engine.contacts(0.1).unwrap();
        assert_eq!(contacts.iter().map(|c| c.0).collect::<Vec<_>>(), [1, 2], "r = {r}");
        for (_, force) in contacts {
            assert!((force - (9.0 * 0.2f64.cos() - 1.0)).abs() < 1e-12, "force {force}");
        }
        let x = engine.state(0.1).unwrap().positions;
        assert!((x[1] - x[0]).abs() < 2e-15 && (x[2] - x[1]).abs() < 2e-15, "{x:?}");
        if r == 0.0 {
            continue;
        }
        // The first whose rebound is slower than 1e-10 settles the other gap too, below 1e-9.
        let mut slow = impacts.iter().filter(|hit| r * hit.closing_speed <= 1e-10).skip(1);
        assert!(slow.all(|hit| hit.closing_speed > 1e-9), "r = {r}: {impacts:?}");
        let half = 0.25 * (1.0 + r);
        let root = (half * half - r).sqrt();
        let (mu, ratio) = (half + root, (half - root) / (half + root));
        // Those that alternate, past the first few and above the speed of contact.
        let series: Vec<&Impact> = impacts.iter().filter(|hit| hit.closing_speed > 1e-3).collect();
        let tail = &series[series.len() - 4..];
        assert!(series.len() > 6 && tail.windows(2).all(|pair| pair[0].gap != pair[1].gap));
        let speeds: Vec<f64> = tail.iter().map(|hit| hit.closing_speed).collect();
        let waits: Vec<f64> = tail.windows(2).map(|pair| pair[1].time - pair[0].time).collect();
        for (name, series, factor, room) in
            [("speeds", speeds, mu, 1e-2), ("waits", waits, ratio, 0.05)]
        {
            let is_near = |two: &[f64]| (two[1] / two[0] / factor - 1.0).abs() < room;
            assert!(series.windows(2).all(is_near), "r = {r}: {name} {series:?}, by {factor}");
        }
    }
    // Above 7 − 4√3 and not pressed, the three part.
    let (engine, impacts) = ran(&scene(&masses, &[0.0; 3], 0.2), 0.1);
    assert!((2..8).contains(&impacts.len()), "{impacts:?}");
    assert_eq!(engine.counters().contact_phases, 0);
}

#[test]
fn without_restitution_a_pair_sticks_only_while_it_is_pressed() {
    // d + ΔF > 0 at the impact: they part at once. < 0: they stay together.
    for (force, sticks) in [(0.0, false), (0.4, false), (0.6, true), (3.0, true)] {
        let masses = [(1.5 - 1e-3, 0.5), (1.5 + 1e-3, -0.5)];
        let (engine, impacts) = ran(&scene(&masses, &[force, -force], 0.0), 0.01);
        assert_eq!(impacts.len(), 1, "force {force}");
        assert_eq!(engine.contacts(0.01).unwrap().len(), usize::from(sticks), "force {force}");
        // A contact that a force would end as soon as it begins must not begin.
        assert_eq!(engine.counters().contact_phases, u64::from(sticks), "force {force}");
        let State { positions: x, velocities: v, .. } = engine.state(0.01).unwrap();
        let rate = v[1] - v[0];
        let s = 0.01 - impacts[0].time;
        let expected = if sticks { 0.0 } else { (1.0 - 2.0 * force) * s };
        assert!((rate - expected).abs() < 1e-5, "force {force}: {rate} {expected}");
        assert!(sticks && (x[1] - x[0]).abs() < 2e-15 || x[0] < x[1], "force {force}: {x:?}");
    }
}

/// At the second release the first gap is open by 1e-50 and lifted by its third derivative alone.
#[test]
fn gaps_that_are_released_together_part_without_a_crawl() {
    for big_w in [2.0, std::f64::consts::SQRT_2] {
        let scenario = Scenario {
            forcing_frequency: big_w,
            restitution: 0.0,
            initial: Initial::Rest,
            ..scene(&[(1.0, 0.0), (2.0, 0.0)], &[3.0, -3.0], 0.0)
        };
        let (engine, impacts) = ran(&scenario, 30.0);
        // The masses meet and stick, part, reach both walls at once and stick there, for ever.
        let hard: Vec<usize> =
            impacts.iter().filter(|impact| impact.closing_speed > 1.0).map(|i| i.gap).collect();
        let has_rounds = hard.chunks_exact(3).all(|round| round == [1, 0, 2]);
        assert!(hard.len() > 12 && has_rounds, "{hard:?}");
        assert!(engine.counters().searches < 1000, "{:?}", engine.counters());
    }
}

/// It would be shut again and released at the same instant for ever, by large forces beside it.
#[test]
fn a_released_gap_is_not_shut_by_rounding() {
    for pressing in [1e3, 1e4, 1e5] {
        let mut opened = 0;
        for i in 0..60 {
            let q = 2.0 + 0.01 * f64::from(i);
            let forces = [pressing + q, -pressing, -q];
            let (engine, _) = ran(&scene(&[(2.0, 0.0); 3], &forces, 0.8), 0.7);
            opened += usize::from(engine.contacts(0.7).unwrap().iter().all(|c| c.0 != 2));
            assert!(engine.counters().searches < 1000, "{forces:?}: {:?}", engine.counters());
        }
        assert_eq!(opened, 60, "{pressing}");
    }
}

/// A load p (1 − cos Ωt + q sin Ωt) presses from zero up until tan(Ωt/2) = −q again.
#[test]
fn a_force_that_grows_from_zero_holds() {
    for (i, q) in (1..40).flat_map(|i| [1e-15, -1e-15, 0.1, 10.0].map(|q: f64| (i, q))) {
        let (load, big_w) = (0.37 * f64::from(i), 8.1);
        let plain = given(vec![[0.0; 2]], vec![[load, -q * load]]);
        let places = Some(vec![0.0, -load, 1e3]);
        let plain = Scenario { forcing_frequency: big_w, places, ..plain };
        let rest = State { time: 0.0, positions: vec![0.0], velocities: vec![0.0] };
        let mut engine = Engine::new(&rest.as_scenario(&plain).unwrap()).unwrap();
        let end = (std::f64::consts::TAU - 2.0 * q.max(1e-3).atan()) / big_w;
        assert_eq!(held(&mut engine, 0.999 * end), [0], "{load}, {q}");
        let counters = engine.counters();
        assert!(counters.contact_phases == 1 && counters.searches < 7, "{load}: {counters:?}");
        assert_eq!(held(&mut engine, 1.001 * end).len(), usize::from(q < 0.1), "{load}, {q}");
    }
}

/// Every contact force is a parabola along the row times (F cos Ωt − 1): all end at once.
#[test]
fn long_runs_that_are_released_at_once_part() {
    for (n, force) in [(100, 1.04), (300, 1.31), (1600, 1.3)] {
        let middle = f64::from(n) / 2.0;
        let forces: Vec<f64> = (0..n).map(|i| -force * (f64::from(i) - middle)).collect();
        let place = f64::from(n + 1) / 2.0;
        let masses = vec![(place, 0.0); forces.len()];
        let mut engine = Engine::new(&scene(&masses, &forces, 0.0)).unwrap();
        assert_eq!(engine.contacts(0.0).unwrap().len(), forces.len() - 1);
        let t = 0.5 * (1.0 / force).acos() + 0.01;
        engine.impacts(t).unwrap();
        assert!(engine.contacts(t).unwrap().is_empty(), "{n}");
        assert!(engine.counters().searches < 20 * n as u64, "{n}: {:?}", engine.counters());
    }
}

fn draw(masses: usize, sigma: f64, index: u64) -> Scenario {
    drawn(&Chain { masses, ..Chain::default() }, sigma, "simultaneous", index)
}

/// A drawn chain made symmetric; an odd one has a mass at rest in the middle.
fn mirror(masses: usize, sigma: f64, index: u64) -> Scenario {
    let mut scenario = draw(masses, sigma, index);
    for j in masses / 2..masses {
        let twin = scenario.forcing[masses - 1 - j];
        scenario.forcing[j] = if 2 * j + 1 == masses { [0.0; 2] } else { twin.map(|x| -x) };
    }
    scenario
}

/// The declared law, fastest gap first: the gaps with their speeds; gap 0 is at a wall.
fn sequential(v: &mut [f64], r: f64) -> Vec<(usize, f64)> {
    let mut hits = Vec::new();
    loop {
        let closing = |k: usize, v: &[f64]| if k == 0 { -v[0] } else { v[k - 1] - v[k] };
        let gap = (0..v.len()).rev().max_by(|&a, &b| closing(a, v).total_cmp(&closing(b, v)));
        let gap = gap.unwrap();
        let speed = closing(gap, v);
        if speed < 1e-12 {
            return hits;
        }
        let jump = (1.0 + r) * speed;
        if gap == 0 {
            v[0] += jump;
        } else {
            v[gap - 1] -= 0.5 * jump;
            v[gap] += 0.5 * jump;
        }
        hits.push((gap, speed));
        assert!(hits.len() < 1_000_000);
    }
}

/// The complementarity problem of r = 0 between a wall and masses in one point: of all velocities
/// that rise along the row from 0 or more, those nearest to `v`. Runs that fall are averaged.
fn inelastic(v: &[f64]) -> Vec<f64> {
    let mut runs: Vec<(f64, usize)> = Vec::new();
    for &velocity in v {
        let mut run = (velocity, 1);
        while let Some(&(mean, count)) = runs.last().filter(|(mean, _)| *mean >= run.0) {
            let members = (count + run.1) as f64;
            run = ((mean * count as f64 + run.0 * run.1 as f64) / members, count + run.1);
            runs.pop();
        }
        runs.push(run);
    }
    runs.iter().flat_map(|&(mean, count)| vec![mean.max(0.0); count]).collect()
}

/// Masses at a wall, all in one point, with random velocities: many gaps close at one instant.
#[test]
fn velocities_after_a_collective_hit_are_those_of_the_law() {
    for n in [2, 5, 12] {
        for index in 0..10 {
            let random = draw(n, 1.0, index).forcing;
            for r in [0.0, 0.1, 0.5, 0.9, 1.0] {
                let mut v: Vec<f64> = random.iter().map(|pair| pair[0]).collect();
                let masses: Vec<(f64, f64)> = v.iter().map(|&v| (0.0, v)).collect();
                let (engine, impacts) = ran(&scene(&masses, &vec![0.0; n], r), 1e-11);
                let expected = if r == 0.0 {
                    inelastic(&v)
                } else {
                    let hits = sequential(&mut v, r);
                    let alike = hits.iter().zip(&impacts).filter(|(a, b)| a.0 == b.gap).count();
                    assert!(alike >= hits.len().min(10), "{r}: {hits:?} {impacts:?}");
                    v
                };
                for (a, b) in engine.state(1e-11).unwrap().velocities.iter().zip(&expected) {
                    assert!((a - b).abs() < 3e-8, "n = {n}, r = {r}: {a} for {b}");
                }
            }
        }
    }
}

/// Masses in contact, pressed against a wall, and one that arrives: impacts at that instant.
#[test]
fn a_collective_hit_takes_a_small_power_of_the_masses() {
    for r in [0.0, 0.1, 0.5, 0.9] {
        for n in [3, 10, 30] {
            let mut masses = vec![(0.0, 0.0); n];
            masses.push((1e-3, -1.0));
            let mut engine = Engine::new(&scene(&masses, &vec![-100.0; n + 1], r)).unwrap();
            assert_eq!(engine.contacts(0.0).unwrap().len(), n);
            let hits = engine.impacts(2e-3).unwrap();
            let first = hits.iter().take_while(|hit| hit.time == hits[0].time).count();
            assert!(first <= 10 * (n + 1).pow(3), "r = {r}, n = {n}: {first}");
            assert!(r > 0.0 || first == n + 1, "without rebound each gap is hit once: {first}");
            let ties = engine.counters().simultaneous as usize;
            assert!((first - 1..=hits.len()).contains(&ties), "{ties} of {first}");
        }
    }
}

/// Ties of an even number of masses are none of neighbours: each impact has its twin.
#[test]
fn an_even_mirror_image_keeps_its_symmetry() {
    for (masses, index) in [(21, 1), (20, 3)] {
        let (engine, impacts) = ran(&mirror(masses, 0.3, index), 300.0);
        assert!(impacts.len() > 300, "{}", impacts.len());
        let x = engine.state(300.0).unwrap().positions;
        let off = |j: usize| (x[j] + x[masses - 1 - j] - (masses + 1) as f64).abs();
        let worst = (0..masses).map(off).fold(0.0, f64::max);
        // In an odd one the middle mass is hit from both sides, one after the other.
        let odd = masses % 2 == 1;
        assert_eq!((worst > 1e-3, engine.counters().simultaneous > 0), (odd, odd));
        assert!(odd || worst < 1e-14, "{worst:e}");
    }
}

/// Events are in order, as foretold, and add up to contacts, counters and impacts.
#[test]
fn events_tell_the_whole_run() {
    for (boundary, restitution) in [(Boundary::Walls, 0.2), (Boundary::Ring, 0.5)] {
        let chain = Chain { masses: 6, restitution, boundary, ..Chain::default() };
        let scenario = drawn(&chain, 2.0, "events", 0);
        let mut engine = Engine::new(&scenario).unwrap();
        let (mut impacts, mut pressed, mut sticks) = (Vec::new(), BTreeSet::new(), 0);
        for step in 1..=400 {
            let (until, mut last) = (0.1 * f64::from(step), engine.time());
            let foretold = engine.next_event_time(until).unwrap();
            let mut first = None;
            let ended = engine.run(until, |event, engine| {
                let time = event.time();
                assert!(time >= last && time == engine.time(), "{event:?} after {last}");
                assert!(engine.state(time).is_ok());
                (first, last) = (first.or(Some(time)), time);
                match event {
                    Event::Impact(impact) => impacts.push(*impact),
                    Event::Stick { gaps, .. } => {
                        sticks += gaps.len() as u64;
                        assert!(gaps.iter().all(|gap| pressed.insert(*gap)), "{event:?}");
                    }
                    Event::Release { gaps, .. } => {
                        assert!(gaps.iter().all(|gap| pressed.remove(gap)), "{event:?}");
                    }
                    _ => panic!("{event:?}"),
                }
                Continue(())
            });
            assert_eq!((ended, first), (Ok(End::Reached), foretold), "{until}");
            let contacts = engine.contacts(until).unwrap().into_iter().map(|(gap, _)| gap);
            assert!(contacts.eq(pressed.iter().copied()), "{until}: {pressed:?}");
        }
        let mut plain = Engine::new(&scenario).unwrap();
        assert!(sticks > 10 && sticks == engine.counters().contact_phases, "{sticks}");
        assert_eq!(plain.run(40.0, |_, _| Break(())), Ok(End::Stopped));
        assert_eq!(plain.time(), impacts[0].time);
        assert_eq!(plain.impacts(40.0).unwrap(), impacts[1..]);
    }
}
