//! Counts the circuits of small graphs one by one.

use impact_circuits::graph::Graph;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Longest circuits that are enumerated on N = 1, 2, … vertices.
pub(crate) const LONGEST: [usize; 6] = [6, 10, 8, 7, 6, 6];

/// Numbers of primitive circuits by (N, length, class).
type Census = BTreeMap<(usize, usize, Vec<usize>), u128>;

static CENSUS: LazyLock<Census> = LazyLock::new(|| {
    let mut census = Census::new();
    for (n, longest) in (1..).zip(LONGEST) {
        for circuit in Graph::of_chain(n - 1).circuits(longest) {
            *census.entry((n, circuit.length(), circuit.repeats())).or_insert(0) += 1;
        }
    }
    census
});

/// Lists all (N, length) that were enumerated.
pub(crate) fn enumerated() -> impl Iterator<Item = (usize, usize)> {
    (1..).zip(LONGEST).flat_map(|(n, longest)| (1..=longest).map(move |k| (n, k)))
}

pub(crate) fn counted(n: usize, k: usize, repeats: &[usize]) -> u128 {
    CENSUS.get(&(n, k, repeats.to_vec())).copied().unwrap_or(0)
}
