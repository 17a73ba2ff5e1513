//! Many vertices (ours, beyond the paper): what becomes of Eq. (10) and of the jump of Sec. 7 as N
//! grows with p N held fixed.
//!
//! k Φ_{N,p}(k) = p^k N!/(N − k)! counts circuits with a marked first impact, and is a Poisson weight
//! of N − k with mean 1/p. [`jump_rule`] says where the jump leads to.

use impact_numerics::bisection;
use pxfm::f_log;

/// The limit of k*/N and of μ/N for N → ∞ with p N fixed: max(0, 1 − 1/(p N)).
pub fn limit_share(p_big_n: f64) -> f64 {
    (1.0 - 1.0 / p_big_n).max(0.0)
}

/// The larger root of k² = 2 N (ln k − 1): where k* jumps to, but for about ln k. Nothing for N ≤ e³,
/// where there is no root.
pub fn jump_rule(big_n: usize) -> Option<f64> {
    let big_n = big_n as f64;
    let beyond = |k: f64| k * k >= 2.0 * big_n * (f_log(k) - 1.0);
    // The difference is least at √N.
    let least = big_n.sqrt();
    (!beyond(least)).then(|| bisection::bracket(least, big_n, beyond)[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::SampleSpace;
    use crate::jump;

    /// Second route: the exact jump, from which the rule is off by about ln k.
    #[test]
    fn the_rule_is_near_the_jump() {
        for big_n in [21, 50, 100, 101, 1000, 30_000, 1_000_000] {
            let k = jump::p_jump(SampleSpace::Simple, big_n).unwrap().k_after as f64;
            let rule = jump_rule(big_n).unwrap();
            assert!((rule - k).abs() <= 2.0 * f_log(k) + 1.0, "N = {big_n}: {rule}");
            let left = rule * rule / (2.0 * big_n as f64 * (f_log(rule) - 1.0));
            assert!((left - 1.0).abs() < 1e-13);
        }
        assert_eq!(jump_rule(20), None);
    }

    #[test]
    fn shares_have_their_limit() {
        assert_eq!([0.5, 1.0, 2.0, 4.0].map(limit_share), [0.0, 0.0, 0.5, 0.75]);
        // ⌈k+⌉ of Eq. (13) is N − 1/p but for less than one and 1/(p k*).
        for (big_n, c) in [(100, 2.0), (10_000, 1.5), (1_000_000, 3.0)] {
            let p = c / big_n as f64;
            let k = jump::local_maximum(big_n, p) as f64;
            let limit = limit_share(c) * big_n as f64;
            assert!(k < limit + 1.0 && k > limit - 1.0 / (p * (k - 1.0)), "{big_n} {c}");
        }
    }
}
