use super::tables::{equal, passing, tables};
use super::*;
use crate::params::{Profile, Protocol};
use crate::table::{Keys, Table};

fn small() -> IndependenceParams {
    let mut parameters = IndependenceParams::new(Profile::Quick);
    parameters.protocol = Protocol { transient: 200.0, window: 400.0 };
    parameters.rows = vec![
        IndependenceRow { masses: 20, sigma: 0.03 },
        IndependenceRow { masses: 20, sigma: 0.3 },
        IndependenceRow { masses: 3, sigma: 0.3 },
    ];
    parameters
}

fn run(parameters: &IndependenceParams) -> [Table; 7] {
    let found = CUTTING.run(parameters, "test", &Progress::silent()).unwrap();
    tables(&found).try_into().unwrap()
}

#[test]
fn a_chain_is_not_independent_and_a_quiet_one_has_no_sequence() {
    let mut parameters = small();
    parameters.chain.masses = 20;
    let [rising, shorter, ..] = run(&parameters);
    let of = |column| rising.number(&[("sigma", 0.3)], column).unwrap();
    let of_short = |column| shorter.number(&[("masses", 3.0)], column).unwrap();
    assert!(rising.number(&[("sigma", 0.03)], "dependence").is_err());
    assert_eq!(rising.number(&[("sigma", 0.03)], "impacts"), Ok(0.0));
    for own in [&of as &dyn Fn(&'static str) -> f64, &of_short] {
        assert!(own("impacts") > 1000.0);
        // What the frequencies alone would do is far away.
        assert!(own("same") < 0.5 * own("same_independent"), "{}", own("same"));
        assert!(own("dependence") > 3.0);
    }
    assert!(of_short("dependence") > of("dependence"));
}

/// 40 000 impacts of twelve gaps by chance, as four realisations: all alike for 12, the first twice as
/// often for 13.
fn by_chance(faces: u64) -> [Table; 7] {
    let mut random = generator("test", 3, faces);
    let one = |_| (rand::Rng::next_u64(&mut random) % faces) as usize % 12;
    let gaps: Vec<usize> = (0..40_000).map(one).collect();
    let mut parameters = small();
    parameters.chain.masses = 11;
    parameters.rows = vec![IndependenceRow { masses: 11, sigma: 0.3 }];
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
    let [rising, _, _, circuits, different, ..] = by_chance(12);
    is(&rising, KEYS, "effective", 12.0);
    for column in ["short", "short_matrix", "step", "collisions"] {
        is(&rising, KEYS, column, 1.0);
    }
    for column in ["passing", "length"] {
        let expected = rising.number(KEYS, &format!("{column}_equal")).unwrap();
        is(&rising, KEYS, column, expected);
    }
    within(rising.number(KEYS, "loops"), 40_000.0 / 12.0, 0.05);
    for column in ["measured", "matrix"] {
        within(circuits.number(&[("sigma", 0.3), ("k", 2.0)], column), 11.0 / 144.0, 0.05);
    }
    let own = different.number(TWELVE, "measured").unwrap();
    is(&different, TWELVE, "measured", different.number(TWELVE, "equal").unwrap());
    assert_eq!(rising.number(KEYS, "different"), Ok(own));
}

#[test]
fn unequal_and_independent_impacts_pass_for_that() {
    let [rising, _, near, _, different, ..] = by_chance(13);
    // Σ π² = (4 + 11)/13².
    is(&rising, KEYS, "effective", 169.0 / 15.0);
    assert!(rising.number(KEYS, "dependence").unwrap().abs() < 0.3);
    for distance in [0.0, 5.0] {
        is(&near, &[("sigma", 0.3), ("distance", distance)], "over_independent", 1.0);
    }
    within(rising.number(KEYS, "loops"), 40_000.0 * 15.0 / 169.0, 0.05);
    // Two circuits i → j → i are the same with probability Σ w²/(Σ w)², w = (π_i π_j)(π_i + π_j).
    let weight = |i: usize, j: usize| {
        let [a, b] = [i, j].map(|gap| if gap == 0 { 2.0 } else { 1.0 });
        a * b * (a + b)
    };
    let pairs: Vec<f64> = (0..12).flat_map(|j| (0..j).map(move |i| weight(i, j))).collect();
    let all: f64 = pairs.iter().sum();
    let expected = 66.0 * pairs.iter().map(|w| w * w).sum::<f64>() / (all * all);
    is(&rising, KEYS, "collisions", expected);
    let frequencies = different.number(TWELVE, "frequencies").unwrap();
    is(&different, TWELVE, "measured", frequencies);
    is(&different, TWELVE, "matrix", frequencies);
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

#[test]
fn the_markov_chain_returns_as_its_matrix_says() {
    // Returns i → j → i and circuits of three of the chain with the measured matrix, exactly.
    let mut parameters = small();
    parameters.rows.remove(0);
    let gaps = [0, 1, 2, 0, 3, 1, 2, 1, 3, 2, 0, 2, 3, 3, 1].repeat(2000);
    let run = counted(&parameters, &gaps, 4, 0);
    let mut cells = [[0.0; 4]; 4];
    for (at, &from) in gaps.iter().enumerate() {
        cells[from][gaps[(at + 1) % gaps.len()]] += 1.0;
    }
    let all = gaps.len() as f64;
    let p = |i: usize, j: usize| cells[i][j] / cells[i].iter().sum::<f64>();
    let [mut two, mut three] = [0.0; 2];
    for (i, row) in cells.iter().enumerate() {
        let own = row.iter().sum::<f64>();
        for j in (0..4).filter(|&j| j != i) {
            two += own * p(i, j) * p(j, i);
            three += (0..4)
                .filter(|&k| k != i && k != j)
                .map(|k| own * p(i, j) * p(j, k) * p(k, i))
                .sum::<f64>();
        }
    }
    for (found, expected) in [(run.markov[1], two), (run.markov[2], three)] {
        let off = (found as f64 - expected).abs();
        assert!(off < 5.0 * expected.sqrt() && off < 0.05 * all, "{found} {expected}");
    }
}
