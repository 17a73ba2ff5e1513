//! Exactly one vertex visited twice: Eqs. (26) to (33).

use crate::Fraction;
use crate::counting::arrangements;

/// **Eq. (26)** (step towards (30))
///
/// Length of a circuit that leaves its doubled vertex for a loop through γ_1 other vertices,
/// comes back, and leaves again for one through γ_2 others: (γ_1 + 1) + (γ_2 + 1).
pub fn length_of_loops(gamma_1: usize, gamma_2: usize) -> usize {
    (gamma_1 + 1) + (gamma_2 + 1)
}

/// **Eq. (27)** (step towards (29))
///
/// Number of such paths from a given doubled vertex: (N − 1) … (N − γ_1) ways for the first loop,
/// (N − (γ_1 + 1)) … (N − (γ_1 + γ_2)) for the second. Nothing beyond 128 bits.
pub fn paths_with_loops(big_n: usize, gamma_1: usize, gamma_2: usize) -> Option<u128> {
    let first = arrangements(big_n - 1, gamma_1)?;
    first.checked_mul(arrangements((big_n - 1).saturating_sub(gamma_1), gamma_2)?)
}

/// **Eq. (28)** (step towards (29))
///
/// The same as one falling product, (N − 1) … (N − (k − 2)) for a circuit of length k ≥ 2: how the
/// k − 2 other vertices are divided between the loops does not matter.
pub fn paths_by_falling(big_n: usize, k: usize) -> Option<u128> {
    (1..k - 1).try_fold(1_u128, |w, i| w.checked_mul(big_n.saturating_sub(i) as u128))
}

/// **Eq. (29)**
///
/// The same as a quotient of factorials, (N − 1)!/(N − (k − 1))!, for k ≥ 2; zero beyond N + 1.
/// Nothing beyond 128 bits.
pub fn doubled_paths(big_n: usize, k: usize) -> Option<u128> {
    arrangements(big_n - 1, k - 2)
}

/// **Eq. (30)**
///
/// φ_N^1(k) *as this equation prints it*: γ(k, 2)/2 times [`doubled_paths`]. A factor N, the
/// choice of the doubled vertex, is missing; Eq. (33) has it.
pub fn doubled_as_printed(big_n: usize, k: usize) -> Option<Fraction> {
    let splits = compositions(k, 2)?;
    Some(Fraction::new(splits.checked_mul(doubled_paths(big_n, k)?)?, 2))
}

/// **Eq. (31)** (step towards (32))
///
/// Whether `parts` solves α_1 + … + α_j = n in positive integers: the equation that γ(n, j)
/// counts.
pub fn is_composition(parts: &[usize], n: usize) -> bool {
    parts.iter().all(|a| *a > 0) && parts.iter().sum::<usize>() == n
}

/// **Eq. (32)**
///
/// γ(n, j), the number of ways to write n as an ordered sum of j positive integers: the binomial
/// coefficient (n − 1 over j − 1), for n, j ≥ 1. Nothing beyond 128 bits.
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
/// φ_N^1(k) = (k − 1)/2 · N!/(N − (k − 1))!, as printed, for k ≥ 1: circuits of length k with one
/// vertex visited twice and no other repeated. Fails at k = 2 (a loop run twice is no new
/// circuit), where it gives N/2. Nothing beyond 128 bits.
pub fn doubled(big_n: usize, k: usize) -> Option<Fraction> {
    let choices = arrangements(big_n, k - 1)?;
    Some(Fraction::new(choices.checked_mul(k as u128 - 1)?, 2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_counted_three_ways() {
        for big_n in 1..=8 {
            for (g1, g2) in [(0, 0), (0, 1), (1, 0), (1, 2), (3, 1), (0, 4), (2, 2)] {
                let k = length_of_loops(g1, g2);
                let counted = paths_with_loops(big_n, g1, g2);
                assert_eq!(counted, paths_by_falling(big_n, k), "N = {big_n}, {g1} {g2}");
                assert_eq!(counted, doubled_paths(big_n, k), "N = {big_n}, {g1} {g2}");
                let factorial = |n: usize| (1..=n as u128).product::<u128>();
                if k <= big_n + 1 {
                    let quotient = factorial(big_n - 1) / factorial(big_n + 1 - k);
                    assert_eq!(counted, Some(quotient), "N = {big_n}, {g1} {g2}");
                }
            }
        }
    }

    #[test]
    fn compositions_by_listing_them() {
        // Second route: all tuples of 1..=n, filtered by the equation itself.
        for n in 1..=6_usize {
            for j in 1..=4_u32 {
                let tuples = n.pow(j);
                let solutions = (0..tuples).filter(|code| {
                    let parts: Vec<usize> = (0..j).map(|i| code / n.pow(i) % n + 1).collect();
                    is_composition(&parts, n)
                });
                assert_eq!(compositions(n, j as usize), Some(solutions.count() as u128));
            }
        }
    }

    #[test]
    fn printed_equation_30_lacks_the_factor_n() {
        for (big_n, k) in [(4, 3), (6, 4), (10, 7)] {
            let printed = doubled_as_printed(big_n, k).unwrap();
            let times_n = Fraction::new(printed.numerator * big_n as u128, printed.denominator);
            assert_eq!(times_n, doubled(big_n, k).unwrap());
            assert_ne!(printed, times_n);
        }
    }
}
