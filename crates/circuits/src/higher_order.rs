//! Counts circuits that repeat vertices (Sec. 9), by class and in the space of five classes.
//!
//! The printed formulas divide the number of sequences by their length, which is right only where
//! no sequence repeats a shorter one. [`SampleSpace::FiveClasses`] counts distinct circuits. An
//! exact count is `None` where it does not fit into 128 bits.

use impact_numerics::double_double::DoubleDouble;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleSpace {
    /// Simple circuits only (Sec. 6).
    Simple,
    /// Simple circuits and the four classes of Sec. 9, counted as primitive circuits.
    FiveClasses,
    /// The same with the printed formulas, although they fail for one and two different vertices.
    FiveClassesPrinted,
}

/// Returns N (N − 1) … (N − count + 1): the ordered choices of `count` of N vertices.
pub(crate) fn arrangements(big_n: usize, count: usize) -> Option<u128> {
    let mut factors = (0..count).map(|i| big_n.saturating_sub(i) as u128);
    factors.try_fold(1_u128, u128::checked_mul)
}

/// **Eq. (29)**
///
/// Returns the number of paths from a given doubled vertex for a loop, back, and for another loop,
/// k vertices in all: (N − 1)!/(N − (k − 1))!, for k ≥ 2; zero beyond N + 1. The way in which the
/// k − 2 other vertices are divided between the loops does not matter:
///
/// **Eq. (26)** (step towards (30)): with γ_1 and γ_2 of them, k = (γ_1 + 1) + (γ_2 + 1).
/// **Eq. (27)** (step towards (29)): (N − 1) … (N − γ_1) ways for the first loop,
/// (N − (γ_1 + 1)) … (N − (γ_1 + γ_2)) for the second.
/// **Eq. (28)** (step towards (29)): together (N − 1) … (N − (k − 2)).
pub fn doubled_paths(big_n: usize, k: usize) -> Option<u128> {
    arrangements(big_n - 1, k - 2)
}

/// **Eq. (30)**
///
/// Returns φ_N^1(k) *as this equation prints it*: γ(k, 2)/2 times [`doubled_paths`]. A factor N,
/// the choice of the doubled vertex, is missing; Eq. (33) has it.
pub fn doubled_as_printed(big_n: usize, k: usize) -> Option<f64> {
    let splits = compositions(k, 2)?;
    Some(splits.checked_mul(doubled_paths(big_n, k)?)? as f64 / 2.0)
}

/// **Eq. (32)**
///
/// Returns γ(n, j), the number of ways to write n as an ordered sum of j positive integers: the
/// binomial coefficient (n − 1 over j − 1), for n, j ≥ 1.
///
/// **Eq. (31)** (step towards (32)): α_1 + … + α_j = n with every α_i > 0.
pub fn compositions(n: usize, j: usize) -> Option<u128> {
    if j > n {
        return Some(0);
    }
    let chosen = (j - 1).min(n - j);
    (0..chosen).try_fold(1_u128, |value, i| {
        // value · (n − 1 − i) is divisible by i + 1: a product of consecutive integers.
        Some(value.checked_mul((n - 1 - i) as u128)? / (i as u128 + 1))
    })
}

/// **Eq. (33)**
///
/// Returns φ_N^1(k) = (k − 1)/2 · N!/(N − (k − 1))!, as printed, for k ≥ 1: one vertex visited
/// twice. Gives N/2 at k = 2, where the only such sequence is a loop run twice, not a new circuit.
pub fn doubled(big_n: usize, k: usize) -> Option<f64> {
    printed(big_n, k, 2, k - 1, 2.0)
}

/// Returns (k − 1)!/(k − j)! · N!/(N − d)! / divisor, the common form of the printed formulas.
fn printed(big_n: usize, k: usize, j: usize, d: usize, divisor: f64) -> Option<f64> {
    let positions = arrangements(k - 1, j - 1)?;
    Some(positions.checked_mul(arrangements(big_n, d)?)? as f64 / divisor)
}

/// **Eq. (35)**
///
/// Returns φ_N^{1,0}(k) as printed, for k ≥ 3: one vertex visited three times,
/// 1/6 (k − 1)!/(k − 3)! N!/(N − (k − 2))!. Gives N/3 at k = 3, where there is no such circuit.
pub fn three_visits(big_n: usize, k: usize) -> Option<f64> {
    printed(big_n, k, 3, k - 2, 6.0)
}

/// **Eq. (36)**
///
/// Returns φ_N^{1,0,0}(k) as printed, for k ≥ 4: one vertex visited four times,
/// 1/24 (k − 1)!/(k − 4)! N!/(N − (k − 3))!. Gives N/4 at k = 4, where there is no such circuit.
pub fn four_visits(big_n: usize, k: usize) -> Option<f64> {
    printed(big_n, k, 4, k - 3, 24.0)
}

/// **Eq. (37)**
///
/// Returns φ_N^2(k) as printed, for k ≥ 3: two vertices visited twice, 1/8 (k − 1)!/(k − 4)! N!/(N
/// − (k − 2))!. Gives 3 N (N − 1)/4 at k = 4, where there are N (N − 1)/2.
pub fn two_doubled(big_n: usize, k: usize) -> Option<f64> {
    printed(big_n, k, 4, k - 2, 8.0)
}

/// **Eq. (34)**
///
/// The class of circuits in which exactly δ_j vertices are visited j + 1 times and every other
/// vertex at most once: the index of φ_N^{…, δ_3, δ_2, δ_1}.
#[derive(Clone, Copy, Debug)]
pub struct Class {
    pub equation: u32,
    /// δ_1, δ_2, …: index j − 1 holds δ_j.
    pub repeats: &'static [usize],
    /// The number of its circuits of length k on N vertices, as printed.
    pub printed: fn(usize, usize) -> Option<f64>,
}

/// The five classes, in the order of Eq. (38).
pub const CLASSES: [Class; 5] = [
    Class { equation: 7, repeats: &[], printed: |n, k| printed(n, k, 1, k, k as f64) },
    Class { equation: 33, repeats: &[1], printed: doubled },
    Class { equation: 35, repeats: &[0, 1], printed: three_visits },
    Class { equation: 36, repeats: &[0, 0, 1], printed: four_visits },
    Class { equation: 37, repeats: &[2], printed: two_doubled },
];

impl Class {
    /// Returns Σ j δ_j, the excess of the length over the number of different vertices.
    pub fn excess(&self) -> usize {
        self.repeats.iter().enumerate().map(|(i, delta)| (i + 1) * delta).sum()
    }

    /// Returns the number of different vertices of circuits of length k, `None` if k is too short.
    pub fn different(&self, k: usize) -> Option<usize> {
        let repeated: usize = self.repeats.iter().sum();
        k.checked_sub(self.excess()).filter(|d| *d >= repeated.max(1))
    }

    /// Returns [`SHARED`] times the number of circuits with k different vertices, over φ_N(k).
    pub fn per_simple_circuit(&self, space: SampleSpace, k: usize) -> u128 {
        let short = space == SampleSpace::FiveClasses;
        let k = k as u128;
        match self.equation {
            7 => SHARED,
            // A single vertex run over and over is a shorter circuit repeated.
            33 | 35 | 36 if short && k == 1 => 0,
            // Of the 3/2 cyclic sequences of two vertices twice, only aabb is primitive.
            37 if short && k == 2 => SHARED,
            33 => 12 * k * k,
            35 => 4 * k * k * (k + 1),
            36 => k * k * (k + 1) * (k + 2),
            _ => 3 * (k - 1) * k * k * (k + 1),
        }
    }
}

/// The common denominator of the five classes: a factor that makes all counts whole.
pub const SHARED: u128 = 24;

/// **Eq. (38)**
///
/// Returns φ_N(k) + φ_N^1(k+1) + φ_N^{1,0}(k+2) + φ_N^{1,0,0}(k+3) + φ_N^2(k+2), each times p
/// for each edge more than k, over φ_N(k) and times [`SHARED`]: the weight of all circuits with k
/// different vertices over that of the simple ones.
pub fn multiplicity(space: SampleSpace, p: DoubleDouble, k: usize) -> DoubleDouble {
    let [simple, doubled, three, four, two] =
        CLASSES.map(|class| class.per_simple_circuit(space, k));
    let real = |x: u128| DoubleDouble::from(x);
    // Horner's scheme in p; the excess lengths are 0, 1, 2, 3 and 2.
    real(simple) + p * (real(doubled) + p * (real(three + two) + p * real(four)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counting::{paths, phi};
    use crate::graph::Graph;

    /// Every class on up to four vertices, by listing its circuits; the printed formulas hold from
    /// three different vertices on.
    #[test]
    fn classes_by_enumeration() {
        for big_n in 1..=4 {
            let circuits: Vec<_> = Graph::of_chain(big_n - 1).circuits(6).collect();
            for (class, k) in CLASSES.iter().flat_map(|class| (1..=6).map(move |k| (class, k))) {
                let is_of = |circuit: &&crate::graph::Circuit| {
                    circuit.length() == k && circuit.repeats() == class.repeats
                };
                let count = circuits.iter().filter(is_of).count();
                let Some(d) = class.different(k).filter(|d| *d <= big_n) else {
                    assert_eq!(count, 0, "{class:?} {big_n} {k}");
                    continue;
                };
                let simple = phi(big_n, d).unwrap();
                let shared = simple * class.per_simple_circuit(SampleSpace::FiveClasses, d);
                assert_eq!(shared, SHARED * count as u128, "{class:?} {big_n} {k}");
                let printed = (class.printed)(big_n, k).unwrap();
                assert!(d < 3 || printed == count as f64, "{class:?} {big_n} {k}");
                let shared = simple * class.per_simple_circuit(SampleSpace::FiveClassesPrinted, d);
                assert!((printed * SHARED as f64 - shared as f64).abs() < 1e-9, "{class:?} {k}");
            }
        }
    }

    #[test]
    fn paths_and_compositions_by_hand() {
        assert_eq!(
            [[5, 2], [6, 3], [4, 4], [3, 4]].map(|[n, j]| compositions(n, j)),
            [4, 10, 1, 0].map(Some)
        );
        assert_eq!([doubled_paths(5, 4), paths(5, 3), paths(5, 6)], [12, 12, 0].map(Some));
        // 3/2 · 12 and 3/2 · 60.
        assert_eq!([doubled_as_printed(5, 4), doubled(5, 4)], [18.0, 90.0].map(Some));
    }
}
