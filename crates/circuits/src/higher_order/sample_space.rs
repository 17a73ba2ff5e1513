//! The sample space of five classes: Eq. (38).

use super::classes::Class;
use crate::distribution::SampleSpace;
use impact_numerics::double_double::DoubleDouble;

/// One of the five classes of Eq. (38).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FiveClass {
    /// Its symbol as in the paper, in the markup of the figures.
    pub symbol: &'static str,
    /// The printed equation that counts it.
    pub equation: u32,
    /// δ_1, δ_2, ….
    pub repeats: &'static [usize],
}

/// The five classes, in the order of Eq. (38).
pub const CLASSES: [FiveClass; 5] = [
    FiveClass { symbol: "φ_{N}", equation: 7, repeats: &[] },
    FiveClass { symbol: "φ_{N}^{1}", equation: 33, repeats: &[1] },
    FiveClass { symbol: "φ_{N}^{1,0}", equation: 35, repeats: &[0, 1] },
    FiveClass { symbol: "φ_{N}^{1,0,0}", equation: 36, repeats: &[0, 0, 1] },
    FiveClass { symbol: "φ_{N}^{2}", equation: 37, repeats: &[2] },
];

impl FiveClass {
    /// Its general class.
    pub fn class(&self) -> Class {
        Class::new(self.repeats)
    }

    /// Length of its circuits with k different vertices.
    pub fn length(&self, k: usize) -> usize {
        k + self.class().excess()
    }

    /// [`SHARED`] times its number of circuits with k different vertices, over φ_N(k): by the
    /// printed formula, or as primitive circuits. A polynomial in k with whole coefficients,
    /// whatever N.
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

/// The common denominator of the five classes.
pub const SHARED: u128 = 24;

/// **Eq. (38)**
///
/// Number of circuits of the five classes with k different vertices,
/// φ_N(k) + φ_N^1(k+1) + φ_N^{1,0}(k+2) + φ_N^{1,0,0}(k+3) + φ_N^2(k+2), as primitive counts.
/// Nothing beyond 128 bits.
pub fn different(big_n: usize, k: usize) -> Option<u128> {
    CLASSES.iter().try_fold(0_u128, |sum, class| {
        sum.checked_add(class.class().primitive(big_n, class.length(k))?)
    })
}

/// [`SHARED`] times the weight of all circuits with k different vertices over that of the simple
/// ones: each class of Eq. (38) over φ_N(k), times p for each edge more than k.
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
    use crate::counting::phi;
    use crate::graph::Graph;
    use crate::higher_order::{doubled, four_visits, three_visits, two_doubled};

    #[test]
    fn five_classes_by_enumeration() {
        // All primitive circuits of the small graph whose class is one of the five, by the number
        // of different vertices; k + 3 edges at most.
        for big_n in 1..=5 {
            let mut found = vec![0_u128; big_n + 1];
            for circuit in Graph::of_chain(big_n - 1).circuits(big_n + 3) {
                if CLASSES.iter().any(|c| c.repeats == circuit.repeats()) {
                    found[circuit.different_vertices()] += 1;
                }
            }
            for (k, count) in found.iter().enumerate().skip(1) {
                assert_eq!(different(big_n, k), Some(*count), "N = {big_n}, k = {k}");
            }
        }
    }

    #[test]
    fn polynomials_are_quotients_of_counts() {
        let printed = |e: u32, n: usize, k: usize| match e {
            7 => phi(n, k).map(|c| crate::Fraction::new(c, 1)),
            33 => doubled(n, k),
            35 => three_visits(n, k),
            36 => four_visits(n, k),
            _ => two_doubled(n, k),
        };
        for class in CLASSES {
            for k in 1..=12 {
                let simple = phi(12, k).unwrap() as f64;
                let length = class.length(k);
                let exact = class.class().primitive(12, length).unwrap() as f64 / simple;
                let ours = class.per_simple_circuit(SampleSpace::FiveClasses, k);
                let ours = ours as f64 / SHARED as f64;
                assert!((ours - exact).abs() <= 1e-14 * exact, "{class:?} {k} {ours} {exact}");
                let formula = printed(class.equation, 12, length).unwrap().to_f64() / simple;
                let ours = class.per_simple_circuit(SampleSpace::FiveClassesPrinted, k);
                let ours = ours as f64 / SHARED as f64;
                assert!((ours - formula).abs() <= 1e-14 * formula, "{class:?} {k}");
            }
        }
    }
}
