//! Counts simple circuits (Sec. 5): exactly up to 128 bits, beyond by Eq. (10) at p = 1.

use crate::distribution::{Law, SampleSpace};
use crate::higher_order::arrangements;
use impact_chain::Error;
use impact_numerics::scaled::Scaled;

/// **Eq. (6)**
///
/// Returns the number of distinct paths of length k from a given vertex back to itself through
/// k − 1 other vertices, all different: (N − 1)!/(N − k)!. `None` if it exceeds 128 bits.
pub fn paths(big_n: usize, k: usize) -> Option<u128> {
    if !(1..=big_n).contains(&k) {
        return Some(0);
    }
    arrangements(big_n - 1, k - 1)
}

// listing: phi
/// **Eq. (7)**
///
/// Returns φ_N(k), the number of distinct simple circuits of length k: N first vertices times
/// [`paths`], each circuit met k times. Zero outside 1..=N; none if N!/(N − k)! exceeds 128 bits.
pub fn phi(big_n: usize, k: usize) -> Option<u128> {
    if k == 0 {
        return Some(0);
    }
    arrangements(big_n, k).map(|paths| paths / k as u128)
}
// end

/// Returns ln φ_N(k), for 1 ≤ k ≤ N.
pub fn log_phi(big_n: usize, k: usize) -> Result<f64, Error> {
    Ok(Law::new(SampleSpace::Simple, big_n, 1.0)?.weight(k)?.ln())
}

/// **Eq. (8)**
///
/// Returns φ_N(k)/φ_N(N) = N/(k (N − k)!), for 1 ≤ k ≤ N: tiny until k comes near N, and above 1
/// at k = N − 1, which Sec. 5 overlooks.
pub fn ratio_to_longest(big_n: usize, k: usize) -> f64 {
    let rest = (1..=big_n - k).rev().fold(Scaled::ONE, |w, i| w * Scaled::from(i));
    (Scaled::from(big_n) / (Scaled::from(k) * rest)).to_f64()
}

/// Returns φ_N(k)/φ_N^tot for k = 1..=N, as Fig. 7 normalises them, and ln φ_N^tot.
pub fn shares(big_n: usize) -> Result<(Vec<f64>, f64), Error> {
    let law = Law::new(SampleSpace::Simple, big_n, 1.0)?;
    let total = law.all_weights().fold(Scaled::ZERO, |sum, count| sum + count);
    Ok((law.probabilities(), total.ln()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_to_five_vertices_by_hand() {
        assert_eq!([phi(5, 2), phi(5, 0), phi(5, 6)], [10, 0, 0].map(Some));
        assert!((log_phi(5, 3).unwrap() - 20.0_f64.ln()).abs() < 1e-15);
        assert!((ratio_to_longest(5, 2) - 5.0 / 12.0).abs() < 1e-15);
        // 3, 3 and 2 circuits.
        assert_eq!(shares(3).unwrap().0, [0.375, 0.375, 0.25]);
        assert!((shares(3).unwrap().1 - 8.0_f64.ln()).abs() < 1e-15);
    }

    #[test]
    fn numbers_end_where_they_do_not_fit() {
        assert_eq!(phi(100, 100), None);
        assert_eq!([log_phi(1, 1), log_phi(2, 2)], [Ok(0.0), Ok(0.0)]);
        assert!(log_phi(0, 1).is_err() && log_phi(5, 0).is_err() && log_phi(5, 6).is_err());
    }
}
