use super::tables::{equal, passing, tables};
use super::*;
use crate::params::{Profile, Protocol};
use crate::table::{Keys, Table};

fn small() -> IndependenceParams {
    let mut parameters = IndependenceParams::new(Profile::Quick);
    parameters.protocol = Protocol { transient: 200.0, window: 400.0 };
    parameters.chain.masses = 20;
    parameters.sigmas = vec![0.03, 0.3];
    parameters
}

/// 40 000 impacts of twelve gaps by chance, as four realisations: all alike for 12, the first twice as
/// often for 13.
fn by_chance(faces: u64) -> [Table; 6] {
    let mut random = generator("test", 3, faces);
    let one = |_| (rand::Rng::next_u64(&mut random) % faces) as usize % 12;
    let gaps: Vec<usize> = (0..40_000).map(one).collect();
    let mut parameters = small();
    parameters.chain.masses = 11;
    parameters.sigmas = vec![0.3];
    let runs = gaps.chunks(10_000).zip(0..);
    let runs = runs.map(|(gaps, i)| Outcome::Ran(Box::new(counted(&parameters, gaps, 12, i))));
    let rows = vec![runs.collect()];
    tables(&Independence { parameters, rows }).try_into().unwrap()
}

fn is(table: &Table, keys: Keys<'_>, column: &str, expected: f64) {
    let found = table.estimates(keys, "sigma", column)[0].1;
    let off = (found.value - expected).abs();
    // Four realisations make errors that are themselves uncertain.
    let near = off < 8.0 * found.error + 1e-3 && off < 0.1 * expected.max(0.2);
    assert!(near, "{column}: {found:?} {expected}");
}

fn within<E: std::fmt::Debug>(found: Result<f64, E>, expected: f64, share: f64) {
    let found = found.unwrap();
    assert!((found / expected - 1.0).abs() < share, "{found} {expected}");
}

const KEYS: Keys<'_> = &[("sigma", 0.3)];
const TWELVE: Keys<'_> = &[("sigma", 0.3), ("impacts", 12.0)];

#[test]
fn equal_and_independent_impacts_pass_for_that() {
    let [rising, _, circuits, different, ..] = by_chance(12);
    is(&rising, KEYS, "effective", 12.0);
    for column in ["short", "step"] {
        is(&rising, KEYS, column, 1.0);
    }
    for column in ["passing", "length"] {
        let expected = rising.number(KEYS, &format!("{column}_equal")).unwrap();
        is(&rising, KEYS, column, expected);
    }
    within(circuits.number(&[("sigma", 0.3), ("k", 2.0)], "measured"), 11.0 / 144.0, 0.05);
    let own = different.number(TWELVE, "measured").unwrap();
    is(&different, TWELVE, "measured", different.number(TWELVE, "equal").unwrap());
    assert_eq!(rising.number(KEYS, "different"), Ok(own));
}

#[test]
fn unequal_and_independent_impacts_pass_for_that() {
    let [rising, near, circuits, ..] = by_chance(13);
    // Σ π² = (4 + 11)/13².
    is(&rising, KEYS, "effective", 169.0 / 15.0);
    assert!(rising.number(KEYS, "dependence").unwrap().abs() < 0.3);
    for distance in [0.0, 5.0] {
        is(&near, &[("sigma", 0.3), ("distance", distance)], "over_independent", 1.0);
    }
    within(circuits.number(&[("sigma", 0.3), ("k", 1.0)], "measured"), 15.0 / 169.0, 0.05);
    let same = rising.number(KEYS, "same_independent").unwrap();
    is(&rising, KEYS, "same", same);
    // At the ends a third less choice: (4/3 + 1/4 + 9/3 + 1/2)/13.
    within::<()>(Ok(same), 100.0 * (4.0 / 3.0 + 0.25 + 3.0 + 0.5) / 13.0, 0.02);
}

/// Circuits of five gaps, one by one: their number, and those that pass by a neighbour of their first gap.
#[test]
fn circuits_of_equal_gaps_by_enumeration() {
    fn follow(circuit: &mut Vec<usize>, seen: &mut [[u32; 2]; 6]) {
        let passes = circuit.iter().any(|gap| gap.abs_diff(circuit[0]) == 1);
        seen[circuit.len()][0] += 1;
        seen[circuit.len()][1] += u32::from(passes);
        for gap in 0..5 {
            if !circuit.contains(&gap) {
                circuit.push(gap);
                follow(circuit, seen);
                circuit.pop();
            }
        }
    }
    let mut seen = [[0; 2]; 6];
    (0..5).for_each(|gap| follow(&mut vec![gap], &mut seen));
    let equal = equal(5);
    // Each of the k gaps, and then the first again.
    let weight = |k: usize| (0..=k).fold(1.0, |weight, _| weight / 5.0);
    for (k, own) in (1..).zip(&equal) {
        assert!((own - f64::from(seen[k][0]) * weight(k)).abs() < 1e-15, "{k}: {own}");
    }
    let [all, with] =
        [0, 1].map(|of| (2..=4).map(|k| f64::from(seen[k][of]) * weight(k)).sum::<f64>());
    assert!((passing(5, 4, &equal) - with / all).abs() < 1e-14);
}
