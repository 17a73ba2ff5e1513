//! Many vertices (ours, beyond the paper): what becomes of Eq. (10) and of the jump of Sec. 7 as N
//! grows with p N held fixed.
//!
//! k Φ_{N,p}(k) = p^k N!/(N − k)! counts circuits with a marked first impact, and is a Poisson weight
//! of N − k with mean 1/p. So N − X is a Poisson variable below N, weighted by 1/X; [`Missing`]
//! computes with that. [`jump_bounds`] and [`jump_rule`] say where the jump leads to.

use super::{Error, check_p, check_vertices};
use impact_numerics::bisection;
use pxfm::f_log;

/// The limit of k*/N and of μ/N for N → ∞ with p N fixed: max(0, 1 − 1/(p N)).
pub fn limit_share(p_big_n: f64) -> f64 {
    (1.0 - 1.0 / p_big_n).max(0.0)
}

/// Terms below this share of the largest one are left out of the sums of [`Missing`].
const NEGLIGIBLE: f64 = 1e-24;

/// The number N − X of vertices that a simple circuit leaves out, beside a Poisson variable J with
/// mean 1/p.
///
/// For p N well above one, where the weight lies about k = N − 1/p: of the other hump of Eq. (10), at
/// small k beyond a valley, what lies below the 10⁻²⁴th part of the largest Poisson weight is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Missing {
    /// μ = E X.
    pub mean: f64,
    /// E 1/X.
    pub inverse: f64,
    /// P(J < N).
    pub within: f64,
    /// Total variation distance of N − X and J.
    pub variation: f64,
}

impl Missing {
    /// # Errors
    /// [`Error::Input`] for N outside 1..=[`super::LARGEST_N`] or p outside (0, 1].
    pub fn new(big_n: usize, p: f64) -> Result<Self, Error> {
        check_vertices(big_n)?;
        check_p(p)?;
        if p * big_n as f64 <= 1.0 {
            let problem = format!("{p} is not above 1/N for N = {big_n}");
            return Err(Error::input("p", problem, "give 1/N < p ≤ 1"));
        }
        let weights = poisson_weights(1.0 / p);
        let visited = |j: usize| big_n.saturating_sub(j) as f64;
        let inside = || weights.iter().filter(|(j, _)| *j < big_n);
        let (mut total, mut within, mut tilted, mut squared) = (0.0, 0.0, 0.0, 0.0);
        weights.iter().for_each(|(_, weight)| total += weight);
        for (j, weight) in inside() {
            let x = visited(*j);
            within += weight;
            tilted += weight / x;
            squared += weight / (x * x);
        }
        // J < N has the weight `within`, and the probabilities of N − X are weight/(x · tilted).
        let mut distance = total - within;
        for (j, weight) in inside() {
            distance += weight * (total / (visited(*j) * tilted) - 1.0).abs();
        }
        Ok(Missing {
            mean: within / tilted,
            inverse: squared / tilted,
            within: within / total,
            variation: 0.5 * distance / total,
        })
    }

    /// A bound of the distance: ½ √(E X · E 1/X / P(J < N) − 1), by the inequality of Cauchy and
    /// Schwarz for the ratio of the two probabilities, which is in proportion to 1/X.
    pub fn variation_bound(&self) -> f64 {
        0.5 * (self.mean * self.inverse / self.within - 1.0).max(0.0).sqrt()
    }
}

/// Poisson weights that matter, over the largest, with their places in rising order.
fn poisson_weights(mean: f64) -> Vec<(usize, f64)> {
    let mode = mean as usize;
    let mut below = Vec::new();
    let (mut j, mut weight) = (mode, 1.0);
    while j > 0 && weight > NEGLIGIBLE {
        weight *= j as f64 / mean;
        j -= 1;
        below.push((j, weight));
    }
    below.reverse();
    (j, weight) = (mode, 1.0);
    while weight > NEGLIGIBLE {
        below.push((j, weight));
        j += 1;
        weight *= mean / j as f64;
    }
    below
}

/// The limit of √N times the distance of N − X and a Poisson variable: √c/((c − 1) √2π), c = p N > 1.
pub fn variation_limit(p_big_n: f64) -> f64 {
    p_big_n.sqrt() / ((p_big_n - 1.0) * std::f64::consts::TAU.sqrt())
}

/// Whether k can be the place to which k* jumps: two necessary conditions, whatever N, that hold no
/// constant to choose. With ψ(k) = ln k − 1 they are k (k − 1) ≥ 2 (N − k)(ψ(k) + 1/k), and for
/// m = k − 1: m (m − 1) ≤ 2 N (ψ(m) + 3/(2m)).
///
/// Φ(j) = Φ(1) at ln(p N) = (ln j + S(j))/(j − 1), S(j) = −Σ_{i<j} ln(1 − i/N); the jump is where this is
/// least, so it does not fall from k to k + 1 nor rise from k − 1 to k. Both are
/// statements on Σ_{i<j} ln((N − i)/(N − j)) + (j − 1) ln(1 + 1/j) − ln j, in which x − x²/2 ≤ ln(1 + x) ≤ x.
pub fn jump_bounds(big_n: usize, k: usize) -> [bool; 2] {
    let psi = |k: f64| f_log(k) - 1.0;
    let (big_n, k) = (big_n as f64, k as f64);
    let m = k - 1.0;
    [
        k * m >= 2.0 * (big_n - k) * (psi(k) + 1.0 / k),
        m * (m - 1.0) <= 2.0 * big_n * (psi(m) + 1.5 / m),
    ]
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
    use crate::distribution::{Law, SampleSpace};
    use crate::jump;

    /// Second route: Eq. (9) itself, with 106 bits, and Poisson probabilities from e^{−λ} upwards.
    #[test]
    fn distance_and_mean_are_those_of_equation_9() {
        for (big_n, c) in [(20, 4.0), (100, 1.5), (100, 10.0), (600, 2.0), (600, 5.0)] {
            let p = c / big_n as f64;
            let law = Law::new(SampleSpace::Simple, big_n, p).unwrap();
            let exact = law.probabilities();
            let missing = Missing::new(big_n, p).unwrap();
            let mut poisson = pxfm::f_exp(-1.0 / p);
            let (mut distance, mut inverse, mut within) = (0.0, 0.0, 0.0);
            for j in 0..big_n {
                let own = exact[big_n - 1 - j];
                distance += (own - poisson).abs();
                inverse += own / (big_n - j) as f64;
                within += poisson;
                poisson /= p * (j + 1) as f64;
            }
            distance = 0.5 * (distance + 1.0 - within);
            let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-11;
            assert!(near(missing.mean, law.mean()), "N = {big_n} c = {c}");
            assert!(near(missing.variation, distance), "N = {big_n} c = {c}");
            assert!(near(missing.inverse, inverse) && near(missing.within, within));
            assert!(missing.variation < missing.variation_bound());
        }
        assert!(Missing::new(100, 0.01).is_err() && Missing::new(0, 0.5).is_err());
    }

    /// The exact law at a million vertices, and what the text derives from it: the distance comes to
    /// its limit, and the mean to N − 1/p − 1/(c − 1).
    #[test]
    fn a_million_vertices() {
        let (big_n, c) = (1_000_000, 2.0);
        let p = c / big_n as f64;
        let missing = Missing::new(big_n, p).unwrap();
        let law = Law::new(SampleSpace::Simple, big_n, p).unwrap();
        assert!((missing.mean / law.mean() - 1.0).abs() < 1e-13);
        let gap = big_n as f64 - 1.0 / p - missing.mean;
        // E X² = (N − 1/p) μ + P(X = 1)/p, so the gap is the variance over μ; that of J is 1/p.
        assert!((gap - 1.0 / (c - 1.0)).abs() < 10.0 / big_n as f64, "{gap}");
        let scaled = missing.variation * (big_n as f64).sqrt();
        assert!((scaled / variation_limit(c) - 1.0).abs() < 10.0 / (big_n as f64).sqrt());
    }

    #[test]
    fn the_jump_lies_between_its_bounds() {
        for big_n in [4, 5, 10, 50, 100, 101, 1000, 30_000, 1_000_000] {
            let k = jump::p_jump(SampleSpace::Simple, big_n).unwrap().k_after;
            assert_eq!(jump_bounds(big_n, k), [true, true], "N = {big_n}");
            // They leave a range about as wide as ln k.
            let room = 2.0 * f_log(k as f64) + 1.0;
            let far = room.ceil() as usize;
            assert!(!jump_bounds(big_n, k + far)[1], "N = {big_n}");
            if k > far + 1 {
                assert!(!jump_bounds(big_n, k - far)[0], "N = {big_n}");
            }
            if let Some(rule) = jump_rule(big_n) {
                assert!((rule - k as f64).abs() <= room, "N = {big_n}: {rule}");
                let left = rule * rule / (2.0 * big_n as f64 * (f_log(rule) - 1.0));
                assert!((left - 1.0).abs() < 1e-13);
            }
        }
        assert_eq!(jump_rule(20), None);
        assert!(jump_rule(21).is_some());
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
