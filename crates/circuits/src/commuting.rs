//! Classes of circuits that differ only by the order of impacts without a common mass (ours).
//!
//! Two impacts without a common mass may change places in the order of impacts, and every mass
//! still has its impacts in the same order. Impacts of gaps i and j have a common mass where
//! |i − j| ≤ 1. In a simple circuit each gap appears once, and a mass meets the gaps to its left
//! and right by turns: all (k − 1)! cyclic orders of k gaps are one order up to such changes.

use crate::graph::{Circuit, Graph};
use std::collections::BTreeSet;

/// Counts, by enumeration, simple circuits on `big_n` gaps, and classes that exchanges connect.
pub fn simple_classes(big_n: usize) -> [usize; 2] {
    let circuits = Graph::of_chain(big_n - 1).circuits(big_n);
    let mut unclassed: BTreeSet<Circuit> = circuits.filter(Circuit::is_simple).collect();
    let (simple, mut classes) = (unclassed.len(), 0);
    while let Some(circuit) = unclassed.pop_first() {
        classes += 1;
        let mut reached = vec![circuit];
        while let Some(circuit) = reached.pop() {
            reached.extend(exchanged(circuit.word()).filter(|other| unclassed.remove(other)));
        }
    }
    [simple, classes]
}

/// Lists the circuits that follow from one exchange of neighbours without a common mass.
fn exchanged(word: &[usize]) -> impl Iterator<Item = Circuit> + '_ {
    let after = |place: usize| (place + 1) % word.len();
    let commutes = move |place: &usize| word[*place].abs_diff(word[after(*place)]) > 1;
    (0..word.len()).filter(commutes).map(move |place| {
        let mut other = word.to_vec();
        other.swap(place, after(place));
        Circuit::new(other)
    })
}

/// Returns the mean number of different gaps if each set of k gaps weighs p^k once.
pub fn mean_without_orders(big_n: usize, p: f64) -> f64 {
    let share = p / (1.0 + p);
    let empty = (0..big_n).fold(1.0, |empty, _| empty * (1.0 - share));
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

    /// Of the impacts 0, 1 and 3 in a circle only 1 and 3, and 3 and 0, have no mass in common.
    #[test]
    fn impacts_without_a_common_mass_change_places() {
        let words: Vec<_> = exchanged(&[0, 1, 3]).map(|other| other.word().to_vec()).collect();
        assert_eq!(words.len(), 2);
        assert_eq!(exchanged(&[0, 1]).count(), 0);
    }

    #[test]
    fn without_orders_the_number_is_binomial() {
        // Three gaps, p = 1: seven sets with 12 gaps in all.
        assert!((mean_without_orders(3, 1.0) - 12.0 / 7.0).abs() < 1e-15);
        assert!((mean_without_orders(2, 0.5) - 1.5 / 1.25).abs() < 1e-15);
    }
}
