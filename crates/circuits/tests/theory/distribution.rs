//! Compares Eqs. (9), (10) and (38), k* and μ, with direct sums in high precision.

use crate::{Big, big, int, near, relative_error};
use SampleSpace::{FiveClasses, FiveClassesPrinted, Simple};
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::higher_order::CLASSES;

/// The weights of k = 1..=N, term by term as Eqs. (10) and (38) have them.
pub fn weights(space: SampleSpace, big_n: usize, p: f64) -> Vec<Big> {
    let p = big(p);
    let mut arranged = int(1);
    let power = |e: usize| (0..e).fold(int(1), |w, _| w * &p);
    let of = |k: usize, arranged: &Big| {
        let simple = arranged.clone() / int(k);
        if space == Simple {
            return simple;
        }
        // Primitive counts at two different vertices at most, the printed polynomials beyond.
        let single = usize::from(space == FiveClassesPrinted || k > 1);
        let (doubled, three, four) = (
            int(k) / int(2),
            int(k) * int(k + 1) / int(6),
            int(k) * int(k + 1) * int(k + 2) / int(24),
        );
        let two = match (space, k) {
            (FiveClasses, 2) => int(1) / int(2),
            _ => int(k - 1) * int(k) * int(k + 1) / int(8),
        };
        let higher = doubled * power(1) + three * power(2) + four * power(3);
        simple + arranged.clone() * (higher * int(single) + two * power(2))
    };
    (1..=big_n)
        .map(|k| {
            arranged *= p.clone() * int(big_n + 1 - k);
            of(k, &arranged)
        })
        .collect()
}

/// The index (from 1) of the first largest value.
fn first_largest(values: &[Big]) -> usize {
    1 + (0..values.len()).fold(0, |best, i| if values[i] > values[best] { i } else { best })
}

#[test]
fn probabilities_mean_and_mode_agree_with_direct_sums() {
    for space in [Simple, FiveClasses, FiveClassesPrinted] {
        for big_n in [1, 2, 3, 4, 5, 7, 12, 100, 171] {
            for p in [1e-12, 1e-3, 0.005, 0.01, 0.015, 0.02, 0.1, 0.5, 0.75, 1.0] {
                let law = Law::new(space, big_n, p).unwrap();
                let weights = weights(space, big_n, p);
                let total = weights.iter().fold(int(0), |sum, weight| sum + weight);
                let case = format!("{space:?} N = {big_n} p = {p}");
                if space != Simple {
                    let parts = CLASSES.map(|class| law.contribution(&class));
                    let sums = (0..big_n).map(|i| parts.iter().map(|part| part[i]).sum::<f64>());
                    let near = |(sum, all): (f64, f64)| (sum - all).abs() < 4e-15;
                    assert!(sums.zip(law.probabilities()).all(near), "{case}");
                }
                for (i, ours) in law.probabilities().into_iter().enumerate() {
                    let exact = weights[i].clone() / &total;
                    if near(&exact) > 1e-300 {
                        assert!(relative_error(ours, &exact) < 4e-15, "{case} k = {}", i + 1);
                    }
                    assert_eq!(law.probability(i + 1), Ok(ours), "{case}");
                }
                let moment =
                    weights.iter().enumerate().fold(int(0), |s, (i, w)| s + int(i + 1) * w);
                assert!(relative_error(law.mean(), &(moment / &total)) < 1e-15, "{case}");
                assert_eq!(law.k_star(), first_largest(&weights), "{case}");
            }
        }
    }
}

#[test]
fn ties_go_to_the_lowest() {
    // N = 5, p = 1/2: Φ(1) = Φ(2) = Φ(3) = 5/2 by hand.
    assert_eq!(Law::new(Simple, 5, 0.5).unwrap().k_star(), 1);
    assert_eq!(Law::new(Simple, 5, 0.5_f64.next_up()).unwrap().k_star(), 3);
    // N = 3, p = 1: Φ = 3, 3, 2.
    assert_eq!(Law::new(Simple, 3, 1.0).unwrap().k_star(), 1);
    // A tie of neighbours at the top needs f(k) = 0, so p = (k + 1)/(k (N − k)), at a dyadic p:
    // the first such N and k for which k is also the maximum.
    let tie = (2..200).flat_map(|n| (2..n).map(move |k| (n, k))).find(|(n, k)| {
        let p = (k + 1) as f64 / (k * (n - k)) as f64;
        let dyadic = (p * 1024.0).fract() == 0.0;
        dyadic && p <= 1.0 && *k > 1 && first_largest(&weights(Simple, *n, p)) == *k
    });
    let (n, k) = tie.expect("a dyadic tie at the maximum");
    let p = (k + 1) as f64 / (k * (n - k)) as f64;
    assert_eq!(Law::new(Simple, n, p).unwrap().k_star(), k);
    assert_eq!(Law::new(Simple, n, p.next_up()).unwrap().k_star(), k + 1);
}
