use super::*;
use crate::params::{Profile, Protocol};

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

#[test]
fn a_chain_is_not_independent_and_a_quiet_one_has_no_sequence() {
    let found = run(&small(), &Progress::silent()).unwrap();
    let [quiet, long, short] = &found.rows[..] else { panic!() };
    assert_eq!((quiet.without, quiet.dependence), ([4, 0], None));
    for row in [long, short] {
        let impacts: u64 = row.hits.iter().flatten().sum();
        assert!(impacts > 1000 && row.distances.iter().sum::<u64>() == impacts);
        assert!(row.circuits.iter().sum::<u64>() <= impacts);
        // What the frequencies alone would do is far away.
        let (same, free) = (row.same.unwrap(), row.same_independent.unwrap());
        assert!(same.value < 0.5 * free.value, "{same:?} {free:?}");
        assert!(row.dependence.unwrap().value > 0.03);
    }
    assert!(short.dependence.unwrap().value > long.dependence.unwrap().value);
    assert_eq!((found.orders.classes, found.orders.vertices), (127, 7));
}

/// 40 000 impacts of twelve gaps by chance, as four realisations: all alike for 12, the first twice as
/// often for 13.
fn by_chance(faces: u64) -> Dependence {
    let mut random = generator("test", 3, faces);
    let one = |_| (rand::Rng::next_u64(&mut random) % faces) as usize % 12;
    let gaps: Vec<usize> = (0..40_000).map(one).collect();
    let mut parameters = small();
    parameters.rows = vec![IndependenceRow { masses: 11, sigma: 0.3 }];
    let runs = gaps.chunks(10_000).zip(0..);
    let runs = runs.map(|(gaps, i)| Outcome::Ran(Box::new(counted(&parameters, gaps, 12, i))));
    let parts = vec![vec![runs.collect()]];
    joining::join(&parameters, parts, &Progress::silent()).unwrap().rows.remove(0)
}

fn is(found: Option<Estimate>, expected: f64) {
    let found = found.unwrap();
    let off = (found.value - expected).abs();
    // Four realisations make errors that are themselves uncertain.
    let near = off < 8.0 * found.error + 1e-3 && off < 0.1 * expected.max(0.2);
    assert!(near, "{found:?} {expected}");
}

#[test]
fn equal_and_independent_impacts_pass_for_that() {
    let row = by_chance(12);
    is(row.effective, 12.0);
    is(row.loops, 1.0);
    is(row.short, 1.0);
    is(row.short_markov, 1.0);
    is(row.step, 1.0);
    is(row.collisions, 1.0);
    is(row.passing_share, row.passing_independent);
    is(row.length, row.length_uniform);
    is(row.distinct[3].mean, row.distinct[3].uniform);
}

#[test]
fn unequal_and_independent_impacts_pass_for_that() {
    let row = by_chance(13);
    // Σ π² = (4 + 11)/13².
    is(row.effective, 169.0 / 15.0);
    is(row.dependence, 0.0);
    is(row.near[0], 1.0);
    is(row.near[5], 1.0);
    is(row.loops, 12.0 * 15.0 / 169.0);
    // Two circuits i → j → i are the same with probability Σ w²/(Σ w)², w = (π_i π_j)(π_i + π_j).
    let weight = |i: usize, j: usize| {
        let [a, b] = [i, j].map(|gap| if gap == 0 { 2.0 } else { 1.0 });
        a * b * (a + b)
    };
    let pairs: Vec<f64> = (0..12).flat_map(|j| (0..j).map(move |i| weight(i, j))).collect();
    let all: f64 = pairs.iter().sum();
    is(row.collisions, 66.0 * pairs.iter().map(|w| w * w).sum::<f64>() / (all * all));
    let twelve = &row.distinct[3];
    assert_eq!(twelve.impacts, 12);
    is(twelve.mean, twelve.frequencies.unwrap().value);
    is(twelve.markov, twelve.frequencies.unwrap().value);
    let same = row.same_independent.unwrap().value;
    is(row.same, same);
    // At the ends a third less choice: (4/3 + 1/4 + 9/3 + 1/2)/13.
    assert!((same - (4.0 / 3.0 + 0.25 + 3.0 + 0.5) / 13.0).abs() < 0.01, "{same}");
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
