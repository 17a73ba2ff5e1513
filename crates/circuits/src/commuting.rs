//! Orders of impacts that no mass notices.
//!
//! Two impacts without a common mass may change places in the order of impacts, and every mass
//! still sees its own impacts in the same order. Gap i lies between masses i and i + 1, so impacts
//! of gaps i and j have a common mass where |i − j| ≤ 1. In a simple circuit each gap appears once, and
//! a mass meets the gap to its left and the gap to its right by turns, whichever of the (k − 1)! cyclic
//! orders of the k gaps it is: all of them are one order up to such changes.

use std::collections::BTreeSet;

/// Number of simple circuits on `big_n` gaps in a row, and of classes of them that changes of
/// neighbouring impacts without a common mass lead from one to another, by enumeration.
pub fn simple_classes(big_n: usize) -> [usize; 2] {
    let mut left = BTreeSet::new();
    grow(&mut Vec::new(), big_n, &mut left);
    let circuits = left.len();
    let mut classes = 0;
    while let Some(circuit) = left.pop_first() {
        classes += 1;
        let mut reached = vec![circuit];
        while let Some(circuit) = reached.pop() {
            for other in changed(&circuit) {
                if left.remove(&other) {
                    reached.push(other);
                }
            }
        }
    }
    [circuits, classes]
}

/// All circuits that begin with these gaps, of which the first is the lowest.
fn grow(begun: &mut Vec<usize>, big_n: usize, into: &mut BTreeSet<Vec<usize>>) {
    let first = begun.first().map_or(0, |&first| first + 1);
    for gap in first..big_n {
        if !begun.contains(&gap) {
            begun.push(gap);
            into.insert(begun.clone());
            grow(begun, big_n, into);
            begun.pop();
        }
    }
}

/// A circuit after each allowed change of two neighbours, written from its lowest gap on.
fn changed(circuit: &[usize]) -> impl Iterator<Item = Vec<usize>> + '_ {
    let k = circuit.len();
    let free = move |&at: &usize| circuit[at].abs_diff(circuit[(at + 1) % k]) > 1;
    (0..k).filter(free).map(move |at| {
        let mut other = circuit.to_vec();
        other.swap(at, (at + 1) % k);
        let lowest = (0..k).min_by_key(|&place| other[place]).unwrap_or(0);
        other.rotate_left(lowest);
        other
    })
}

/// Mean number of different gaps if each set of k gaps weighs p^k once, and not (k − 1)! times: the
/// mean of a binomial variable, but for the empty set.
pub fn mean_without_orders(big_n: usize, p: f64) -> f64 {
    let share = p / (1.0 + p);
    let mut empty = 1.0;
    for _ in 0..big_n {
        empty *= 1.0 - share;
    }
    big_n as f64 * share / (1.0 - empty)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_orders_of_the_same_gaps_are_one() {
        // By Eq. (7), N!/(k (N − k)!) over k = 1..6: 6 + 15 + 40 + 90 + 144 + 120. Sets: 2^N − 1.
        assert_eq!([1, 2, 3, 6].map(simple_classes), [[1, 1], [3, 3], [8, 7], [415, 63]]);
    }

    #[test]
    fn changes_are_of_impacts_without_a_common_mass() {
        // Around the end gap 2 comes before gap 0.
        assert_eq!(changed(&[0, 1, 2]).collect::<Vec<_>>(), [vec![0, 2, 1]]);
        let other: Vec<_> = changed(&[0, 2, 1, 3]).collect();
        assert_eq!(other, [vec![0, 1, 3, 2], vec![0, 2, 3, 1], vec![0, 3, 2, 1]]);
    }

    #[test]
    fn without_orders_the_number_is_binomial() {
        // Three gaps, p = 1: seven sets with 12 gaps in all.
        assert!((mean_without_orders(3, 1.0) - 12.0 / 7.0).abs() < 1e-15);
        assert!((mean_without_orders(2, 0.5) - 1.5 / 1.25).abs() < 1e-15);
    }
}
