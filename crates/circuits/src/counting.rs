//! How many simple circuits there are (Sec. 5). Exact integers where they fit into 128 bits, and
//! logarithms or [`Scaled`] numbers, which hold for every N.

use super::{Error, check_k, check_vertices};
use impact_numerics::scaled::Scaled;

/// N (N − 1) … (N − count + 1) exactly: ordered choices of `count` of N vertices. Nothing if it
/// exceeds 128 bits.
pub(crate) fn arrangements(big_n: usize, count: usize) -> Option<u128> {
    let factors = (0..count).map(|i| big_n.saturating_sub(i) as u128);
    factors.into_iter().try_fold(1_u128, u128::checked_mul)
}

/// N (N − 1) … (N − count + 1) for any N, to about 30 digits.
fn arrangements_scaled(big_n: usize, count: usize) -> Scaled {
    (0..count).fold(Scaled::ONE, |w, i| w * Scaled::from(big_n.saturating_sub(i)))
}

/// **Eq. (6)**
///
/// Number of distinct paths of length k from a given vertex back to itself through k − 1 other
/// vertices, all different: (N − 1)!/(N − k)!. Nothing if it exceeds 128 bits.
pub fn paths(big_n: usize, k: usize) -> Option<u128> {
    if !(1..=big_n).contains(&k) {
        return Some(0);
    }
    arrangements(big_n - 1, k - 1)
}

// listing: phi
/// **Eq. (7)**
///
/// φ_N(k), the number of distinct simple circuits of length k: N first vertices times
/// [`paths`], each circuit met k times. Zero outside 1..=N; nothing if N!/(N − k)! exceeds
/// 128 bits.
pub fn phi(big_n: usize, k: usize) -> Option<u128> {
    if k == 0 {
        return Some(0);
    }
    arrangements(big_n, k).map(|paths| paths / k as u128)
}
// end

/// φ_N(k) of Eq. (7) for any N, to about 30 digits.
fn phi_scaled(big_n: usize, k: usize) -> Scaled {
    if k == 0 { Scaled::ZERO } else { arrangements_scaled(big_n, k) / Scaled::from(k) }
}

/// ln φ_N(k), for 1 ≤ k ≤ N.
pub fn log_phi(big_n: usize, k: usize) -> Result<f64, Error> {
    check_vertices(big_n)?;
    check_k(big_n, k)?;
    Ok(phi_scaled(big_n, k).ln())
}

/// **Eq. (8)**
///
/// φ_N(k)/φ_N(N) = N/(k (N − k)!), for 1 ≤ k ≤ N: tiny until k comes near N, and above 1 at
/// k = N − 1, which Sec. 5 overlooks.
pub fn ratio_to_longest(big_n: usize, k: usize) -> f64 {
    let rest = arrangements_scaled(big_n - k, big_n - k);
    (Scaled::from(big_n) / (Scaled::from(k) * rest)).to_f64()
}

/// φ_N(k)/φ_N^tot for k = 1..=N, as Fig. 7 normalises them, and ln φ_N^tot.
pub fn shares(big_n: usize) -> (Vec<f64>, f64) {
    let mut arranged = Scaled::ONE;
    let counts: Vec<Scaled> = (1..=big_n)
        .map(|k| {
            arranged = arranged * Scaled::from(big_n + 1 - k);
            arranged / Scaled::from(k)
        })
        .collect();
    let total = counts.iter().fold(Scaled::ZERO, |sum, count| sum + *count);
    (counts.iter().map(|count| (*count / total).to_f64()).collect(), total.ln())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_and_logarithmic_forms_agree() {
        for big_n in [1, 2, 5, 20, 30] {
            for k in 1..=big_n {
                let exact = phi(big_n, k).unwrap() as f64;
                assert!((phi_scaled(big_n, k).to_f64() / exact - 1.0).abs() < 1e-15);
            }
        }
        assert_eq!(phi(100, 100), None);
        assert_eq!(log_phi(1, 1), Ok(0.0));
        assert_eq!(log_phi(2, 2), Ok(0.0));
        assert!(log_phi(0, 1).is_err() && log_phi(5, 0).is_err() && log_phi(5, 6).is_err());
    }
}
