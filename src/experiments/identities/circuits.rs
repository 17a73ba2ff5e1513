//! Compares the counts of circuits with the enumeration of small graphs: Secs. 3, 5 and 9.

use crate::experiments::theory::basics::{Cases, cases};
use crate::experiments::theory::census::{LONGEST, counted, enumerated};
use impact_circuits::counting::{paths, phi};
use impact_circuits::graph::{Circuit, Graph};
use impact_circuits::higher_order::{
    CLASSES, Class, compositions, doubled_as_printed, doubled_paths,
};
use std::collections::BTreeMap;

/// Compares the names of the vertices with n + 1 impacts of a chain, two of them at walls.
pub(super) fn impact_types() -> Cases {
    cases((1..=20).map(|masses| {
        let graph = Graph::of_chain(masses);
        let at_wall = |&v: &usize| graph.label(v).starts_with('L') || graph.label(v).ends_with('R');
        graph.vertices() == masses + 1 && (0..graph.vertices()).filter(at_wall).count() == 2
    }))
}

/// Compares Eq. (6) with the rotations of simple circuits.
pub(super) fn eq6() -> Cases {
    cases(enumerated().filter(|&(n, k)| k <= n).map(|(n, k)| {
        // A path is a simple circuit with one of its k vertices as the first: N paths in all.
        let all_paths = counted(n, k, &[]) * k as u128;
        paths(n, k).map(|each| each * n as u128) == Some(all_paths)
    }))
}

pub(super) fn eq7() -> Cases {
    let agrees = |(n, k)| phi(n, k) == Some(counted(n, k, &[]));
    cases(enumerated().filter(|&(n, k)| k <= n).map(agrees))
}

/// Compares Eq. (29) with the circuits that pass vertex 0 twice, by the lengths of their two loops.
pub(super) fn eq29() -> Cases {
    cases((1..).zip(LONGEST).flat_map(|(n, longest)| {
        let mut loops: BTreeMap<[usize; 2], u128> = BTreeMap::new();
        let through = |circuit: &Circuit| {
            let visits = circuit.visits();
            visits.get(&0) == Some(&2) && visits.iter().all(|(&v, &times)| v == 0 || times == 1)
        };
        for circuit in Graph::of_chain(n - 1).circuits(longest).filter(through) {
            // The least rotation begins at vertex 0.
            let first = 1 + circuit.word()[1..].iter().take_while(|v| **v != 0).count();
            let second = circuit.length() - first;
            *loops.entry([first.min(second), first.max(second)]).or_insert(0) += 1;
        }
        loops.into_iter().map(move |([a, b], circuits)| {
            // Two loops of equal length may be named in either order: half of the formula.
            let ordered = if a == b { 2 * circuits } else { circuits };
            doubled_paths(n, a + b) == Some(ordered)
        })
    }))
}

pub(super) fn eq30_times_n() -> Cases {
    cases(enumerated().filter(|&(n, k)| k >= 3 && k <= n + 1).map(|(n, k)| {
        let times_n = doubled_as_printed(n, k).map(|printed| printed * n as f64);
        times_n == Some(counted(n, k, &[1]) as f64)
    }))
}

pub(super) fn eq32() -> Cases {
    /// Counts ordered sums of j positive integers one by one.
    fn count(n: usize, j: usize) -> u128 {
        match j {
            0 => u128::from(n == 0),
            _ => (1..=n).map(|first| count(n - first, j - 1)).sum(),
        }
    }
    let agrees = |(n, j)| compositions(n, j) == Some(count(n, j));
    cases((1..=10).flat_map(|n| (1..=n).map(move |j| (n, j))).map(agrees))
}

/// Compares Eq. (38) from a k on with all five classes; from k = 3 on Eq. (37) is in its range.
pub(super) fn eq38(from: usize) -> Cases {
    let lengths = |(n, longest): (usize, usize)| {
        (from..=n).take_while(move |k| k + 3 <= longest).map(move |k| (n, k))
    };
    cases((1..).zip(LONGEST).flat_map(lengths).map(|(n, k)| {
        let counted = CLASSES.map(|one| counted(n, k + one.excess(), one.repeats) as f64);
        let printed = CLASSES.map(|one| (one.printed)(n, k + one.excess()));
        printed.into_iter().sum::<Option<f64>>() == Some(counted.into_iter().sum())
    }))
}

/// Where the printed formula of a class of circuits holds.
pub(super) struct ClassRange {
    pub equation: f64,
    /// The length from which on it is right.
    pub right_from: usize,
    /// The comparisons from that length on.
    pub cases: Cases,
    /// On three vertices, for the length before: the formula, and the number of circuits.
    pub formula_below: Option<f64>,
    pub counted_below: u128,
}

/// Compares the printed formula of each class with the enumeration.
pub(super) fn class_ranges() -> Vec<ClassRange> {
    let range = |class: &Class| {
        let agrees = |&(n, k): &(usize, usize)| {
            (class.printed)(n, k) == Some(counted(n, k, class.repeats) as f64)
        };
        let possible: Vec<(usize, usize)> =
            enumerated().filter(|&(n, k)| class.different(k).is_some_and(|d| d <= n)).collect();
        let below =
            possible.iter().filter(|size| !agrees(size)).map(|size| size.1).max().unwrap_or(0);
        ClassRange {
            equation: class.equation.into(),
            right_from: below + 1,
            cases: cases(possible.iter().filter(|size| size.1 > below).map(agrees)),
            formula_below: (class.printed)(3, below),
            counted_below: counted(3, below, class.repeats),
        }
    };
    CLASSES[1..].iter().map(range).collect()
}
