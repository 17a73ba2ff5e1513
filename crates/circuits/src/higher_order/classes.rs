//! Any class of circuits, by how many vertices are visited how often: Eqs. (34) to (37).

use crate::counting::arrangements;
use crate::fraction::{Fraction, gcd};

/// **Eq. (34)**
///
/// The class of circuits in which exactly δ_j vertices are visited j + 1 times and every other
/// vertex at most once: the index of φ_N^{…, δ_3, δ_2, δ_1}.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Class {
    /// δ_1, δ_2, …: index j − 1 holds δ_j.
    pub repeats: Vec<usize>,
}

impl Class {
    /// The class with these δ_1, δ_2, ….
    pub fn new(repeats: &[usize]) -> Self {
        Class { repeats: repeats.to_vec() }
    }

    /// Σ δ_j, the number of repeated vertices.
    pub fn repeated(&self) -> usize {
        self.repeats.iter().sum()
    }

    /// Σ j δ_j, by how much the length exceeds the number of different vertices.
    pub fn excess(&self) -> usize {
        self.repeats.iter().enumerate().map(|(i, delta)| (i + 1) * delta).sum()
    }

    /// The number of different vertices of its circuits of length k; nothing if k is too short.
    pub fn different(&self, k: usize) -> Option<usize> {
        k.checked_sub(self.excess()).filter(|d| *d >= self.repeated().max(1))
    }

    /// The pattern of the printed formulas for any class: cyclic sequences of length k counted as
    /// sequences over k, (k − 1)! N!/(∏ ((j + 1)!)^{δ_j} δ_j! · (d − Σδ_j)! (N − d)!) with d
    /// different vertices. Right when no sequence can be periodic; otherwise it need not even be
    /// an integer. Nothing beyond 128 bits.
    pub fn formula(&self, big_n: usize, k: usize) -> Option<Fraction> {
        let Some(d) = self.different(k).filter(|d| *d <= big_n) else {
            return Some(Fraction::new(0, 1));
        };
        let sequences = self.choices(big_n, d)?.checked_mul(self.sequences(d, 1)?)?;
        Some(Fraction::new(sequences, k as u128))
    }

    /// How many different circuits of length k the class has: primitive cyclic sequences, which is
    /// Möbius inversion over the periods that the visits allow. Nothing beyond 128 bits.
    pub fn primitive(&self, big_n: usize, k: usize) -> Option<u128> {
        let Some(d) = self.different(k).filter(|d| *d <= big_n) else { return Some(0) };
        let mut balance = 0_i128;
        for period in 1..=self.common_visits(d) {
            if self.common_visits(d).is_multiple_of(period) {
                let sequences = i128::try_from(self.sequences(d, period)?).ok()?;
                balance += i128::from(moebius(period)) * sequences;
            }
        }
        let per_choice = u128::try_from(balance).ok()? / k as u128;
        self.choices(big_n, d)?.checked_mul(per_choice)
    }

    /// Ways to say which vertex is visited how often.
    fn choices(&self, big_n: usize, d: usize) -> Option<u128> {
        let same = self.repeats.iter().copied().chain([d - self.repeated()]);
        let same = same.map(factorial).try_fold(1_u128, |w, f| w.checked_mul(f?))?;
        Some(arrangements(big_n, d)? / same)
    }

    /// Sequences with these visits that consist of `times` equal parts.
    fn sequences(&self, d: usize, times: usize) -> Option<u128> {
        let length = (d + self.excess()) / times;
        let visits = self.repeats.iter().enumerate();
        let parts = visits.map(|(i, delta)| Some((factorial((i + 2) / times)?, *delta)));
        let mut below = 1_u128;
        for part in parts {
            let (each, delta) = part?;
            for _ in 0..delta {
                below = below.checked_mul(each)?;
            }
        }
        Some(factorial(length)? / below)
    }

    /// Greatest common divisor of all numbers of visits: only such periods are possible.
    fn common_visits(&self, d: usize) -> usize {
        let once = if d > self.repeated() { 1 } else { 0 };
        let visits = self.repeats.iter().enumerate().filter(|(_, delta)| **delta > 0);
        let all = visits.map(|(i, _)| i as u128 + 2).chain([once]);
        all.fold(0, gcd) as usize
    }
}

fn factorial(n: usize) -> Option<u128> {
    (1..=n as u128).try_fold(1_u128, u128::checked_mul)
}

/// The Möbius function, n ≥ 1.
pub(super) fn moebius(n: usize) -> i8 {
    let (mut rest, mut sign) = (n, 1);
    for prime in 2..=n {
        if rest.is_multiple_of(prime) {
            rest /= prime;
            if rest.is_multiple_of(prime) {
                return 0;
            }
            sign = -sign;
        }
    }
    sign
}

/// (k − 1)!/(k − j)! · N!/(N − d)! / divisor: the common form of the printed formulas.
fn printed(big_n: usize, k: usize, j: usize, d: usize, divisor: u128) -> Option<Fraction> {
    let positions = arrangements(k - 1, j - 1)?;
    Some(Fraction::new(positions.checked_mul(arrangements(big_n, d)?)?, divisor))
}

/// **Eq. (35)**
///
/// φ_N^{1,0}(k) as printed, for k ≥ 3: one vertex visited three times, 1/6 (k − 1)!/(k − 3)!
/// N!/(N − (k − 2))!. Gives N/3 at k = 3, where there is none. Nothing beyond 128 bits.
pub fn three_visits(big_n: usize, k: usize) -> Option<Fraction> {
    printed(big_n, k, 3, k - 2, 6)
}

/// **Eq. (36)**
///
/// φ_N^{1,0,0}(k) as printed, for k ≥ 4: one vertex visited four times, 1/24 (k − 1)!/(k − 4)!
/// N!/(N − (k − 3))!. Gives N/4 at k = 4, where there is none. Nothing beyond 128 bits.
pub fn four_visits(big_n: usize, k: usize) -> Option<Fraction> {
    printed(big_n, k, 4, k - 3, 24)
}

/// **Eq. (37)**
///
/// φ_N^2(k) as printed, for k ≥ 3: two vertices visited twice, 1/8 (k − 1)!/(k − 4)!
/// N!/(N − (k − 2))!. Gives 3 N (N − 1)/4 at k = 4, where there are N (N − 1)/2. Nothing beyond
/// 128 bits.
pub fn two_doubled(big_n: usize, k: usize) -> Option<Fraction> {
    printed(big_n, k, 4, k - 2, 8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Graph;
    use crate::higher_order::doubled;
    use std::collections::BTreeMap;

    /// All primitive circuits of a small graph, counted by class and length.
    fn census(big_n: usize, longest: usize) -> BTreeMap<(Vec<usize>, usize), u128> {
        let mut census = BTreeMap::new();
        for circuit in Graph::of_chain(big_n - 1).circuits(longest) {
            *census.entry((circuit.repeats(), circuit.length())).or_insert(0) += 1;
        }
        census
    }

    #[test]
    fn every_class_agrees_with_enumeration() {
        for (big_n, longest) in [(1, 4), (2, 10), (3, 8), (4, 7), (5, 6), (6, 6)] {
            let census = census(big_n, longest);
            for ((repeats, k), count) in &census {
                let class = Class::new(repeats);
                assert_eq!(class.primitive(big_n, *k), Some(*count), "{repeats:?} k = {k}");
            }
            // And the other way round: classes without circuits are counted as empty.
            for repeats in [vec![], vec![1], vec![0, 1], vec![0, 0, 1], vec![2], vec![1, 1]] {
                for k in 1..=longest {
                    let found = census.get(&(repeats.clone(), k)).copied().unwrap_or(0);
                    assert_eq!(Class::new(&repeats).primitive(big_n, k), Some(found));
                }
            }
        }
    }

    #[test]
    fn printed_formulas_count_circuits_from_a_smallest_length_on() {
        // (formula, class, length at which it fails)
        type Printed = fn(usize, usize) -> Option<Fraction>;
        let cases: [(Printed, &[usize], usize); 4] = [
            (doubled, &[1], 2),
            (three_visits, &[0, 1], 3),
            (four_visits, &[0, 0, 1], 4),
            (two_doubled, &[2], 4),
        ];
        for (formula, repeats, fails_at) in cases {
            let class = Class::new(repeats);
            for big_n in 2..=9 {
                for k in fails_at..=9 {
                    let printed = formula(big_n, k).unwrap();
                    assert_eq!(printed, class.formula(big_n, k).unwrap(), "{repeats:?} {k}");
                    let counted = class.primitive(big_n, k).unwrap();
                    assert_eq!(
                        printed.integer() == Some(counted),
                        k != fails_at,
                        "{repeats:?} {k}"
                    );
                }
            }
        }
    }

    #[test]
    fn smallest_lengths_as_fractions() {
        // One vertex visited m times, alone: m equal letters, (m − 1)!/m! = 1/m per vertex.
        assert_eq!(doubled(7, 2), Some(Fraction::new(7, 2)));
        assert_eq!(three_visits(7, 3), Some(Fraction::new(7, 3)));
        assert_eq!(four_visits(7, 4), Some(Fraction::new(7, 4)));
        // aabb and abab: 3/2 per pair by formula, of which only aabb is primitive.
        assert_eq!(two_doubled(7, 4), Some(Fraction::new(3 * 7 * 6, 4)));
        assert_eq!(Class::new(&[2]).primitive(7, 4), Some(7 * 6 / 2));
        assert_eq!(two_doubled(7, 3), Some(Fraction::new(0, 1)));
    }
}
