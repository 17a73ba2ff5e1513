//! Counts of circuits, against the enumeration of small graphs: Secs. 3, 5 and 9.

use super::{Cases, ClassRange};
use impact_circuits::Fraction;
use impact_circuits::counting::{paths, phi};
use impact_circuits::graph::{Circuit, Graph};
use impact_circuits::higher_order::{
    Class, compositions, doubled, doubled_as_printed, doubled_paths, four_visits, three_visits,
    two_doubled,
};
use std::collections::BTreeMap;

/// Number of primitive circuits by (N, length, class), found by enumeration.
pub(super) type Census = BTreeMap<(usize, usize, Vec<usize>), u64>;

/// Longest circuits that are enumerated on N = 1, 2, … vertices.
const LONGEST: [usize; 6] = [6, 10, 8, 7, 6, 6];

pub(super) fn census() -> Census {
    let mut census = Census::new();
    for (n, longest) in (1..).zip(LONGEST) {
        for circuit in Graph::of_chain(n - 1).circuits(longest) {
            *census.entry((n, circuit.length(), circuit.repeats())).or_insert(0) += 1;
        }
    }
    census
}

/// All (N, length) that were enumerated.
pub(super) fn enumerated() -> impl Iterator<Item = (usize, usize)> {
    (1..).zip(LONGEST).flat_map(|(n, longest)| (1..=longest).map(move |k| (n, k)))
}

pub(super) fn counted(census: &Census, n: usize, k: usize, repeats: &[usize]) -> u64 {
    census.get(&(n, k, repeats.to_vec())).copied().unwrap_or(0)
}

pub(super) fn impact_types() -> Cases {
    let mut cases = Cases::default();
    for masses in 1..=20 {
        let graph = Graph::of_chain(masses);
        let walls = (0..graph.vertices())
            .filter(|&v| graph.label(v).starts_with('L') || graph.label(v).ends_with('R'))
            .count();
        cases.see(graph.vertices() == masses + 1 && walls == 2);
    }
    cases
}

/// Closed paths from vertex 0 without repetition: rotations of the simple circuits through it.
pub(super) fn eq6(census: &Census) -> Cases {
    let mut cases = Cases::default();
    for (n, k) in enumerated().filter(|&(n, k)| k <= n) {
        // A path is a simple circuit with one of its k vertices as the first: N paths in all.
        let all_paths = u128::from(counted(census, n, k, &[])) * k as u128;
        cases.see(paths(n, k).map(|each| each * n as u128) == Some(all_paths));
    }
    cases
}

pub(super) fn eq7(census: &Census) -> Cases {
    let mut cases = Cases::default();
    for (n, k) in enumerated().filter(|&(n, k)| k <= n) {
        cases.see(phi(n, k) == Some(u128::from(counted(census, n, k, &[]))));
    }
    cases
}

/// Circuits through vertex 0 twice, by the sorted lengths of their two loops.
pub(super) fn eq29() -> Cases {
    let mut cases = Cases::default();
    for (n, longest) in (1..).zip(LONGEST) {
        let mut loops: BTreeMap<[usize; 2], u128> = BTreeMap::new();
        let through = |circuit: &Circuit| {
            let visits = circuit.visits();
            visits.get(&0) == Some(&2) && visits.iter().all(|(&v, &times)| v == 0 || times == 1)
        };
        for circuit in Graph::of_chain(n - 1).circuits(longest).filter(through) {
            let at: Vec<usize> =
                (0..circuit.length()).filter(|&i| circuit.word()[i] == 0).collect();
            let first = at[1] - at[0];
            let mut lengths = [first, circuit.length() - first];
            lengths.sort_unstable();
            *loops.entry(lengths).or_insert(0) += 1;
        }
        for ([a, b], circuits) in loops {
            // Two loops of equal length may be named in either order: half of the formula.
            let ordered = if a == b { 2 * circuits } else { circuits };
            cases.see(doubled_paths(n, a + b) == Some(ordered));
        }
    }
    cases
}

pub(super) fn eq30_times_n(census: &Census) -> Cases {
    let mut cases = Cases::default();
    for (n, k) in enumerated().filter(|&(n, k)| k >= 3 && k <= n + 1) {
        let times_n = doubled_as_printed(n, k)
            .map(|f| Fraction::new(f.numerator * n as u128, f.denominator))
            .and_then(Fraction::integer);
        cases.see(times_n == Some(u128::from(counted(census, n, k, &[1]))));
    }
    cases
}

pub(super) fn eq32() -> Cases {
    /// Ordered sums of j positive integers, one by one.
    fn count(n: usize, j: usize) -> u128 {
        match j {
            0 => u128::from(n == 0),
            _ => (1..=n).map(|first| count(n - first, j - 1)).sum(),
        }
    }
    let mut cases = Cases::default();
    for n in 1..=10 {
        for j in 1..=n {
            cases.see(compositions(n, j) == Some(count(n, j)));
        }
    }
    cases
}

/// Circuits of all five classes with k different vertices, wherever no formula of Eq. (38) is used
/// below the range that is printed with it: from k = 3 on, since Eq. (37) has length k + 2 > 4.
pub(super) fn eq38(census: &Census) -> Cases {
    let mut cases = Cases::default();
    for (n, longest) in (1..).zip(LONGEST) {
        for k in (3..=n).take_while(|k| k + 3 <= longest) {
            let printed = [
                phi(n, k).map(|count| Fraction::new(count, 1)),
                doubled(n, k + 1),
                three_visits(n, k + 2),
                four_visits(n, k + 3),
                two_doubled(n, k + 2),
            ];
            let printed: Option<u128> =
                printed.into_iter().map(|count| count.and_then(Fraction::integer)).sum();
            let classes: [(usize, &[usize]); 5] =
                [(0, &[]), (1, &[1]), (2, &[0, 1]), (3, &[0, 0, 1]), (2, &[2])];
            let found: u64 =
                classes.iter().map(|(more, class)| counted(census, n, k + more, class)).sum();
            cases.see(printed == Some(u128::from(found)));
        }
    }
    cases
}

/// A formula for N vertices and length k.
type Formula = fn(usize, usize) -> Option<Fraction>;

pub(crate) fn class_ranges(census: &Census) -> Vec<ClassRange> {
    let printed: [(u32, Formula, &[usize]); 4] = [
        (33, doubled, &[1]),
        (35, three_visits, &[0, 1]),
        (36, four_visits, &[0, 0, 1]),
        (37, two_doubled, &[2]),
    ];
    printed
        .into_iter()
        .map(|(equation, formula, repeats)| {
            let class = Class::new(repeats);
            let agrees = |n: usize, k: usize| {
                let value = formula(n, k).and_then(Fraction::integer);
                value == Some(u128::from(counted(census, n, k, repeats)))
            };
            let possible: Vec<(usize, usize)> =
                enumerated().filter(|&(n, k)| class.different(k).is_some_and(|d| d <= n)).collect();
            let wrong = possible.iter().filter(|&&(n, k)| !agrees(n, k)).map(|&(_, k)| k).max();
            let right_from = wrong.map_or(1, |k| k + 1);
            let mut cases = Cases::default();
            for &(n, k) in possible.iter().filter(|&&(_, k)| k >= right_from) {
                cases.see(agrees(n, k));
            }
            let below = right_from - 1;
            ClassRange {
                equation,
                right_from,
                cases,
                formula_below: formula(3, below).map_or(f64::NAN, Fraction::to_f64),
                counted_below: counted(census, 3, below, repeats),
            }
        })
        .collect()
}
