//! Neighbouring gaps that close at exactly the same instant, under both laws. The scenes are exact:
//! masses in one point at t = 0, or mirror images.

use crate::reference::{Dd, Reference};
use crate::{drawn, first, run, trace};
use impact_paper::dynamics::{Engine, Impact, Initial, Scenario, Simultaneous};
use impact_paper::numerics::random::NormalPairs;
use impact_paper::params::{Boundary, Chain};

const LAWS: [Simultaneous; 2] = [Simultaneous::Sequential, Simultaneous::Joint];

fn draw(masses: usize, sigma: f64, index: u64) -> Scenario {
    drawn(&Chain { masses, ..Chain::default() }, sigma, "simultaneous", index)
}

/// A drawn chain made its own mirror image; an odd one has a mass at rest in the middle.
fn mirror(masses: usize, sigma: f64, index: u64) -> Scenario {
    let mut scenario = draw(masses, sigma, index);
    for j in 0..masses.div_ceil(2) {
        scenario.forcing[masses - 1 - j] = match 2 * j + 1 == masses {
            true => [0.0; 2],
            false => scenario.forcing[j].map(|x| -x),
        };
    }
    scenario
}

/// Newton's law one gap after the other, lowest gap first, until none closes: the declared law.
fn sequential(mut v: [f64; 3], r: f64) -> Vec<(usize, f64)> {
    let mut hits = Vec::new();
    while let Some(gap) = (1..=2).find(|&gap| v[gap] < v[gap - 1] - 1e-12) {
        let closing = v[gap - 1] - v[gap];
        v[gap - 1] -= 0.5 * (1.0 + r) * closing;
        v[gap] += 0.5 * (1.0 + r) * closing;
        hits.push((gap, closing));
        assert!(hits.len() < 100);
    }
    hits
}

#[test]
fn a_three_way_impact_under_both_laws() {
    let forcing = vec![[0.4, 0.3], [0.0; 2], [-0.4, -0.3]];
    let scene = Scenario { forcing, ..draw(3, 1.0, 0) };
    for r in [0.0, 0.3, 0.8, 1.0] {
        let speeds = LAWS.map(|law| {
            let scene = Scenario { restitution: r, simultaneous: law, ..scene.clone() };
            let mut engine = Engine::new(&scene).unwrap();
            let hits = std::iter::from_fn(|| first(&mut engine, 100.0));
            let Some(first) = hits.into_iter().find(|hit| [1, 2].contains(&hit.gap)) else {
                panic!("{law:?}, r = {r}: the middle mass is not hit")
            };
            // The rest of it: under the joint law at the same tick.
            let mut block = vec![first];
            block.extend(run(&mut engine, first.time + 1e-13));
            let v = engine.velocities(engine.time());
            let closing = first.closing_speed;
            assert_eq!(engine.counters().simultaneous, 1, "{law:?}, r = {r}");
            let gaps: Vec<usize> = block.iter().map(|hit| hit.gap).collect();
            assert!(gaps.starts_with(&[1, 2]), "{law:?}, r = {r}: {gaps:?}");
            if law == Simultaneous::Joint {
                let both = Impact { gap: 2, ..first };
                assert_eq!(block, [first, both]);
                for (v, expected) in v.iter().zip([-r * closing, 0.0, r * closing]) {
                    assert!((v - expected).abs() < 1e-14, "r = {r}: {v} {expected}");
                }
            } else if r > 0.5 {
                // With less restitution the three collapse into contact.
                let expected = sequential([closing, 0.0, -closing], r);
                assert!(gaps.iter().eq(expected.iter().map(|(gap, _)| gap)), "r = {r}: {gaps:?}");
                for (hit, (_, speed)) in block.iter().zip(expected) {
                    assert!((hit.closing_speed - speed).abs() < 1e-13, "r = {r}: {hit:?} {speed}");
                }
                // The reference follows the same law.
                let ours = trace(&scene, first.time + 0.1);
                let theirs = Reference::<Dd>::new(&scene).run(first.time + 0.1).unwrap();
                assert!(ours.iter().map(|hit| hit.gap).eq(theirs.iter().map(|hit| hit.gap)));
            } else {
                assert!(gaps.len() > 2, "r = {r}: {gaps:?}");
            }
            v
        });
        // The laws differ wherever there is anything to restitute but all.
        let apart = (speeds[0][1] - speeds[1][1]).abs();
        assert_eq!(apart > 1e-3, r > 0.0 && r < 1.0, "r = {r}: {speeds:?}");
    }
}

/// An unforced chain whose masses from..=to are in one point, at these velocities.
fn heap(n: usize, boundary: Boundary, members: &[(usize, f64, f64)], r: f64) -> Scenario {
    let mut free = vec![[0.0; 2]; n];
    for &(j, place, v) in members {
        free[j - 1] = [place - j as f64, v];
    }
    let scenario = Scenario {
        boundary,
        restitution: r,
        initial: Initial::Free(free),
        simultaneous: Simultaneous::Joint,
        ..draw(n, 0.0, 0)
    };
    assert!(scenario.forcing.iter().flatten().all(|x| *x == 0.0));
    scenario
}

fn energy(v: &[f64]) -> f64 {
    0.5 * v.iter().map(|x| x * x).sum::<f64>()
}

/// Every gap of the run opens at r times the rate at which it closed, and what no wall is part of keeps its
/// momentum: as many equations as velocities.
#[test]
fn the_joint_law_is_newtons_for_any_run() {
    let (n, mut normals) = (9, NormalPairs::new("heaps", 1, 0));
    let places =
        [(0, Boundary::Walls), (2, Boundary::Walls), (2, Boundary::Ring), (5, Boundary::Ring)];
    for (count, (shift, boundary)) in (2..7).flat_map(|count| places.map(|place| (count, place))) {
        for r in [0.0, 0.4, 1.0] {
            let at_wall = boundary == Boundary::Walls && shift == 0;
            // Velocities that fall along the run, so that every gap of it closes.
            let mut v = 0.0;
            let members: Vec<(usize, f64, f64)> = (1..=count)
                .map(|i| {
                    v -= 0.05 + normals.pair()[0].abs();
                    let j = i + shift;
                    // On a ring the run may pass from mass n to mass 1, one turn on.
                    let place = if at_wall { 0.0 } else { (shift + 3) as f64 };
                    if j > n { (j - n, place - n as f64, v) } else { (j, place, v) }
                })
                .collect();
            let mut engine = Engine::new(&heap(n, boundary, &members, r)).unwrap();
            let seen: Vec<usize> = run(&mut engine, 0.0).iter().map(|hit| hit.gap).collect();
            let mut gaps: Vec<usize> = members[..count - 1].iter().map(|m| m.0).collect();
            gaps.extend(at_wall.then_some(0));
            gaps.sort_unstable();
            assert_eq!(seen, gaps, "{boundary:?}, r = {r}");
            assert_eq!(engine.counters().simultaneous, u64::from(gaps.len() > 1));
            let all = engine.velocities(0.0);
            let mut before: Vec<f64> = members.iter().map(|m| m.2).collect();
            let mut after: Vec<f64> = members.iter().map(|m| all[m.0 - 1]).collect();
            assert!(energy(&after) <= energy(&before) * (1.0 + 1e-14), "r = {r}");
            let momentum = |v: &[f64]| v.iter().sum::<f64>();
            let kept = (momentum(&after) - momentum(&before)).abs() < 1e-13;
            assert!(kept || at_wall, "{before:?} {after:?}");
            if at_wall {
                before.insert(0, 0.0);
                after.insert(0, 0.0);
            }
            for (before, after) in before.windows(2).zip(after.windows(2)) {
                let error = (after[1] - after[0]) + r * (before[1] - before[0]);
                assert!(error.abs() < 5e-14, "{boundary:?}, r = {r}: {before:?} {after:?}");
            }
        }
    }
}

#[test]
fn energy_never_grows_and_nothing_is_left_closing() {
    // Velocities in any order: some gaps of the heap close, some open, some are driven shut again.
    let mut normals = NormalPairs::new("heaps", 2, 0);
    let mut more = 0;
    for round in 0..300 {
        let count = 3 + round % 5;
        let r = [1.0, 0.9, 0.6, 0.0][round % 4];
        let members: Vec<(usize, f64, f64)> =
            (0..count).map(|i| (i + 2, 4.0, normals.pair()[0])).collect();
        let before: Vec<f64> = members.iter().map(|m| m.2).collect();
        let mut engine = Engine::new(&heap(9, Boundary::Walls, &members, r)).unwrap();
        let impacts = run(&mut engine, 0.0);
        assert!(impacts.iter().all(|hit| hit.time == 0.0));
        let closing = before.windows(2).filter(|pair| pair[1] < pair[0]).count();
        more += usize::from(impacts.len() > closing);
        let after = &engine.velocities(0.0)[1..=count];
        let bound = energy(&before) * (1.0 + 1e-13);
        assert!(energy(after) <= bound, "{before:?}, r = {r}");
        assert!((energy(after) >= bound * (1.0 - 1e-12)) || r < 1.0 || impacts.is_empty());
        let momentum = |v: &[f64]| v.iter().sum::<f64>();
        assert!((momentum(after) - momentum(&before)).abs() < 1e-13);
        assert!(after.windows(2).all(|pair| pair[1] - pair[0] > -1e-9), "{before:?}: {after:?}");
    }
    assert!(more > 30, "{more} heaps with an impact after the first");
}

/// Masses in one point with forces that press the middle together: Ω = 2, so x = a − F/3 at t = 0.
fn pressed(velocities: &[f64], forces: &[f64], r: f64) -> Scenario {
    let n = velocities.len();
    let members: Vec<(usize, f64, f64)> = (1..=n)
        .map(|j| (j, 0.5 * (n + 1) as f64 + forces[j - 1] / 3.0, velocities[j - 1]))
        .collect();
    let forcing = forces.iter().map(|&f| [f, 0.0]).collect();
    Scenario { forcing, forcing_frequency: 2.0, ..heap(n, Boundary::Walls, &members, r) }
}

#[test]
fn masses_in_contact_take_part_in_a_joint_impact() {
    for r in [0.0, 0.5, 1.0] {
        // Two in contact, hit from both sides at once: they stay where they are.
        let scenario = pressed(&[2.0, 0.0, 0.0, -2.0], &[0.0, 3.0, -3.0, 0.0], r);
        let mut engine = Engine::new(&scenario).unwrap();
        assert_eq!(engine.contacts(0.0).len(), 1);
        let gaps: Vec<usize> = run(&mut engine, 0.0).iter().map(|hit| hit.gap).collect();
        assert_eq!(gaps, [1, 3], "r = {r}");
        assert_eq!(engine.counters().simultaneous, 1);
        let v = engine.velocities(0.0);
        for (v, expected) in v.iter().zip([-2.0 * r, 0.0, 0.0, 2.0 * r]) {
            assert!((v - expected).abs() < 1e-14, "r = {r}: {v} {expected}");
        }
        let held: Vec<usize> = engine.contacts(0.0).iter().map(|c| c.0).collect();
        assert!(held.contains(&2), "{held:?}");
        // One hit on two in contact: they go on as one body of mass 2.
        let hit = |law| {
            let scenario = pressed(&[3.0, 0.0, 0.0], &[0.0, 3.0, -3.0], r);
            let mut engine = Engine::new(&Scenario { simultaneous: law, ..scenario }).unwrap();
            let impacts = run(&mut engine, 0.0);
            (impacts.len(), engine.velocities(0.0), engine.counters().simultaneous)
        };
        let (impacts, v, ties) = hit(Simultaneous::Joint);
        assert_eq!((impacts, ties), (1, 0));
        for (v, expected) in v.iter().zip([1.0 - 2.0 * r, 1.0 + r, 1.0 + r]) {
            assert!((v - expected).abs() < 1e-14, "r = {r}: {v} {expected}");
        }
        // Passed on from mass to mass instead.
        let (impacts, v, _) = hit(Simultaneous::Sequential);
        assert!(r == 0.0 || impacts > 1 && v[2] > v[1] + 1e-3, "r = {r}: {impacts}, {v:?}");
    }
}

/// Under the joint law a mirror image stays one, and each impact has its twin: an odd one, whose middle mass is hit
/// from both sides at once, and an even one, whose ties are none of neighbours and so the same under both laws.
#[test]
fn a_mirror_image_keeps_its_symmetry_under_the_joint_law() {
    for (masses, index) in [(21, 1), (20, 3)] {
        let [sequential, joint] = LAWS.map(|law| {
            let scenario = Scenario { simultaneous: law, ..mirror(masses, 0.3, index) };
            let mut engine = Engine::new(&scenario).unwrap();
            let impacts = run(&mut engine, 300.0);
            assert!(impacts.len() > 300, "{}", impacts.len());
            let x = engine.positions(300.0);
            let off = |j: usize| (x[j] + x[masses - 1 - j] - (masses + 1) as f64).abs();
            (impacts, (0..masses).map(off).fold(0.0, f64::max), engine.counters().simultaneous)
        });
        let odd = masses % 2 == 1;
        assert!(joint.1 < 1e-14 && (joint.2 > 10) == odd, "{:e} {}", joint.1, joint.2);
        // One gap after the other cannot keep it.
        assert_eq!((sequential.1 > 1e-3, sequential.2 > 0), (odd, odd));
        assert_eq!(sequential == joint, !odd);
        let sorted = |mut list: Vec<Impact>| {
            list.sort_by(|a, b| (a.time, a.gap).partial_cmp(&(b.time, b.gap)).unwrap());
            list
        };
        let seen = joint.0.iter().map(|own| Impact { gap: masses - own.gap, ..*own }).collect();
        assert_eq!(sorted(joint.0), sorted(seen));
    }
}

#[test]
fn a_receiver_that_stops_in_a_joint_impact_gets_the_rest_later() {
    let scenario = Scenario { simultaneous: Simultaneous::Joint, ..mirror(21, 0.3, 1) };
    let all = run(&mut Engine::new(&scenario).unwrap(), 100.0);
    let mut engine = Engine::new(&scenario).unwrap();
    let one_by_one: Vec<_> = std::iter::from_fn(|| first(&mut engine, 100.0)).collect();
    assert_eq!(all, one_by_one);
    assert_eq!(engine.counters().impacts, all.len() as u64);
}

/// Also next to masses that have just come to rest together, whose common velocity is another than each had.
#[test]
fn the_speed_of_an_impact_is_that_of_its_masses() {
    let mut normals = NormalPairs::new("settling", 1, 0);
    let mut slow = 0;
    for _ in 0..60 {
        let pairs: Vec<[f64; 2]> = (0..7).map(|_| normals.pair()).collect();
        let [velocities, forces] =
            [0, 1].map(|i| pairs.iter().map(|pair| 3.0 * pair[i]).collect::<Vec<_>>());
        let scenario = pressed(&velocities, &forces, 0.3);
        let scenario = Scenario { simultaneous: Simultaneous::Sequential, ..scenario };
        let mut engine = Engine::new(&scenario).unwrap();
        let mut before = engine.velocities(0.0);
        while let Some(hit) = first(&mut engine, 0.0) {
            if let 1..7 = hit.gap {
                let closing = before[hit.gap - 1] - before[hit.gap];
                assert!((hit.closing_speed - closing).abs() < 1e-13, "{hit:?} {closing:e}");
                slow += usize::from(closing < 1e-8);
            }
            before = engine.velocities(0.0);
        }
    }
    assert!(slow > 100, "{slow}");
}
