//! Neighbouring gaps that close at exactly the same instant. The scenes are exact: masses in one point at t = 0, or mirror
//! images.

use crate::reference::{Dd, Reference};
use crate::{drawn, first, run, trace};
use impact_chain::{Engine, Scenario};
use impact_paper::params::Chain;

fn draw(masses: usize, sigma: f64, index: u64) -> Scenario {
    drawn(&Chain { masses, ..Chain::default() }, sigma, "simultaneous", index)
}

/// A drawn chain made symmetric; an odd one has a mass at rest in the middle.
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
fn a_three_way_impact() {
    let forcing = vec![[0.4, 0.3], [0.0; 2], [-0.4, -0.3]];
    for r in [0.0, 0.3, 0.8, 1.0] {
        let scene = Scenario { forcing: forcing.clone(), restitution: r, ..draw(3, 1.0, 0) };
        let mut engine = Engine::new(&scene).unwrap();
        let hits = std::iter::from_fn(|| first(&mut engine, 100.0));
        let Some(first) = hits.into_iter().find(|hit| [1, 2].contains(&hit.gap)) else {
            panic!("r = {r}: the middle mass is not hit")
        };
        let mut block = vec![first];
        block.extend(run(&mut engine, first.time + 1e-13));
        let closing = first.closing_speed;
        assert_eq!(engine.counters().simultaneous, 1, "r = {r}");
        let gaps: Vec<usize> = block.iter().map(|hit| hit.gap).collect();
        assert!(gaps.starts_with(&[1, 2]), "r = {r}: {gaps:?}");
        if r > 0.5 {
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
            // With less restitution the three collapse into contact.
            assert!(gaps.len() > 2, "r = {r}: {gaps:?}");
        }
    }
}

/// Ties of a mirror image with an even number of masses are none of neighbours: each impact has its twin to the last bit.
#[test]
fn an_even_mirror_image_keeps_its_symmetry() {
    for (masses, index) in [(21, 1), (20, 3)] {
        let mut engine = Engine::new(&mirror(masses, 0.3, index)).unwrap();
        let impacts = run(&mut engine, 300.0);
        assert!(impacts.len() > 300, "{}", impacts.len());
        let x = engine.positions(300.0);
        let off = |j: usize| (x[j] + x[masses - 1 - j] - (masses + 1) as f64).abs();
        let worst = (0..masses).map(off).fold(0.0, f64::max);
        // One gap after the other cannot keep that of an odd one, whose middle mass is hit from both sides.
        let odd = masses % 2 == 1;
        assert_eq!((worst > 1e-3, engine.counters().simultaneous > 0), (odd, odd));
        assert!(odd || worst < 1e-14, "{worst:e}");
    }
}
