//! Computes k*, the most likely number of impacts, and its jump (Sec. 7).

use crate::distribution::{Law, SampleSpace, Weights, check_vertices};
use impact_chain::Error;
use impact_numerics::double_double::{DoubleDouble, two_product};
use impact_numerics::roots;
use impact_numerics::scaled::Scaled;

/// **Eq. (12)**
///
/// Returns f_{N,p}(k) = −p k² + (N p − 1) k − 1 at real k: Φ_{N,p} rises from k to k + 1 where it
/// is positive. Written as p k (N − k) − (k + 1), with the product exact.
///
/// **Eq. (14)** (step towards (18)): f_{N,p}(0) = −1, whatever N and p.
/// **Eq. (15)** (step towards (18)): f_{N,p}(N) = −(N + 1), whatever p.
/// **Eq. (16)** (step towards (18)): f_{N,0}(k) = −(k + 1) < 0, so at p → 0+ every step falls.
/// **Eq. (17)** (step towards (18)): ∂f/∂p = k (N − k) > 0 inside (0, N), so f grows with p.
pub fn f(big_n: usize, p: f64, k: f64) -> f64 {
    let product = two_product(k, big_n as f64 - k) * p;
    (product - DoubleDouble::from(k) - DoubleDouble::ONE).to_f64()
}

/// Returns f_{N,p} at an integer k, exactly.
fn f_exact(big_n: usize, p: f64, k: usize) -> DoubleDouble {
    // k (N − k) ≤ N²/4 < 2^53 for every N allowed, so one error-free product is enough.
    two_product(p, (k * (big_n - k)) as f64) - DoubleDouble::from(k + 1)
}

/// **Eq. (11)**
///
/// Decides exactly whether Φ_{N,p}(k + 1) − Φ_{N,p}(k) = p^k N!/((N − k)! k (k + 1)) ·
/// f_{N,p}(k) is positive, for 1 ≤ k < N.
pub fn rises(big_n: usize, p: f64, k: usize) -> bool {
    k < big_n && f_exact(big_n, p, k) > DoubleDouble::ZERO
}

/// **Eq. (13)**
///
/// Returns the zeros k− ≤ k+ of f_{N,p}, or `None` if it has none (p below p_crit, or p = 0).
/// The smaller one comes from k− k+ = 1/p, since the printed difference would cancel.
pub fn zeros(big_n: usize, p: f64) -> Option<[f64; 2]> {
    let b = two_product(p, big_n as f64) - DoubleDouble::ONE;
    let discriminant = b * b - DoubleDouble::from(4.0 * p);
    if p <= 0.0 || b.hi <= 0.0 || discriminant < DoubleDouble::ZERO {
        return None;
    }
    let twice = (b + discriminant.sqrt()).to_f64();
    Some([2.0 / twice, twice / (2.0 * p)])
}

/// **Eq. (18)**
///
/// Returns p_crit = ((1 + √(N + 1))/N)², where f_{N,p} first touches zero: Φ gets a stationary
/// point, as a function of real k. k* stays at 1 until [`p_jump`].
pub fn p_crit(big_n: usize) -> Result<f64, Error> {
    check_vertices(big_n)?;
    let root = (1.0 + (big_n as f64 + 1.0).sqrt()) / big_n as f64;
    Ok(root * root)
}

/// Returns the local maximum k > 1 of Φ_{N,p} (the lower of two), or 1 if Φ falls: ⌈k+⌉.
pub fn local_maximum(big_n: usize, p: f64) -> usize {
    let Some([_, plus]) = zeros(big_n, p) else { return 1 };
    // Rounding may put k+ on the wrong side of an integer: exact signs decide.
    let mut k = (plus as usize).clamp(1, big_n);
    while rises(big_n, p, k) {
        k += 1;
    }
    while k > 1 && !rises(big_n, p, k - 1) {
        // Left of the vertex of the parabola f < 0 down to 1.
        if 2.0 * p * (k - 1) as f64 <= p * big_n as f64 - 1.0 {
            return 1;
        }
        k -= 1;
    }
    k
}

/// Returns the p at which k* > 1 steps from k to k + 1: (k + 1)/(k (N − k)), by f = 0.
pub fn step(big_n: usize, k: usize) -> f64 {
    (k + 1) as f64 / (k * (big_n - k)) as f64
}

/// Returns the first local maximum of Φ as p grows: its k > 1, and its p as a fraction, a little
/// above p_crit unless k+ is an integer there. `None` for N < 3.
pub fn first_local_maximum(big_n: usize) -> Option<(usize, [usize; 2])> {
    // (k + 1)/(k (N − k)) over k: compare as integers, exactly.
    let parts = |k: usize| [k + 1, k * (big_n - k)];
    let before = |a: [usize; 2], b: [usize; 2]| (a[0] * b[1]).cmp(&(b[0] * a[1]));
    let k = (2..big_n).min_by(|a, b| before(parts(*a), parts(*b)))?;
    let [above, below] = parts(k);
    Some((k, parts(k).map(|part| part / gcd(above, below))))
}

fn gcd(a: usize, b: usize) -> usize {
    if a == 0 { b } else { gcd(b % a, a) }
}

impl Law {
    /// Returns k*, the most likely number of different impacts; the lowest of several.
    pub fn k_star(&self) -> usize {
        if self.space != SampleSpace::Simple {
            return self.sums().largest_at;
        }
        let top = local_maximum(self.big_n, self.p);
        if top == 1 || rises(self.big_n, self.p, 1) {
            return top;
        }
        let first = Scaled::from(self.big_n) * Scaled::from(top);
        let exceeds = self.weights().nth(top - 1).is_some_and(|weights| weights.moment() > first);
        if exceeds { top } else { 1 }
    }
}

/// The jump of the most likely number of impacts from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// The double nearest to the infimum of p with k* > 1.
    pub p: f64,
    /// Neighbouring doubles around that infimum: k* = 1 at the first and k* > 1 at the second.
    pub bracket: [f64; 2],
    pub k_after: usize,
}

// listing: p_jump
/// Finds the actual jump of k*: the infimum of p with k* > 1, and k* after it. There is none for
/// N ≤ 3, and with higher orders for N = 1.
///
/// Φ(k)/Φ(1) grows with p for every k > 1, so "some Φ(k) exceeds Φ(1)" turns true once, and
/// bisection over doubles finds the place to the last bit.
pub fn p_jump(space: SampleSpace, big_n: usize) -> Result<Jump, Error> {
    check_vertices(big_n)?;
    if !first_is_exceeded(space, big_n, DoubleDouble::ONE) {
        let least = if space == SampleSpace::Simple { 4 } else { 2 };
        let problem = format!(
            "with N = {big_n} the most likely number of impacts is 1 for every p, so there is no jump"
        );
        return Err(Error::input("vertices", problem, format!("give N ≥ {least}")));
    }
    let exceeded = |p: f64| first_is_exceeded(space, big_n, DoubleDouble::from(p));
    let [below, above] = roots::bracket(0.0, 1.0, exceeded);
    let half = DoubleDouble { hi: below, lo: 0.5 * (above - below) };
    let p = if first_is_exceeded(space, big_n, half) { below } else { above };
    Ok(Jump { p, bracket: [below, above], k_after: Law::new(space, big_n, above)?.k_star() })
}
// end

// listing: first_is_exceeded
/// Returns whether some k > 1 has more weight than k = 1.
fn first_is_exceeded(space: SampleSpace, big_n: usize, p: DoubleDouble) -> bool {
    let mut weights = Weights::new(space, big_n, p);
    let first = weights.moment();
    for k in 2..=big_n {
        weights.advance();
        // Φ(k) > Φ(1), multiplied by k: no division, so ties at small k are exact.
        if weights.moment() > first * Scaled::from(k) {
            return true;
        }
        if weights.falls_from_here() {
            return false;
        }
    }
    false
}
// end

/// Returns the limit of k*/N and of μ/N for N → ∞ with p N fixed: max(0, 1 − 1/(p N)). It follows
/// since k Φ_{N,p}(k) is a Poisson weight of N − k with mean 1/p (ours, beyond the paper).
pub fn limit_share(p_big_n: f64) -> f64 {
    (1.0 - 1.0 / p_big_n).max(0.0)
}

/// Returns the larger root of k² = 2 N (ln k − 1), about k* after its jump, or `None` for N ≤ e³
/// (ours).
pub fn jump_rule(big_n: usize) -> Option<f64> {
    let big_n = big_n as f64;
    let beyond = |k: f64| k * k >= 2.0 * big_n * (pxfm::f_log(k) - 1.0);
    // The difference is least at √N.
    let least = big_n.sqrt();
    (!beyond(least)).then(|| roots::bracket(least, big_n, beyond)[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parabola_and_steps_by_hand() {
        // −3/4 k² + 2 k − 1.
        assert_eq!([1.0, 2.0, 3.0].map(|k| f(4, 0.75, k)), [0.25, 0.0, -1.75]);
        let [low, high] = zeros(4, 0.75).unwrap();
        assert!((low - 2.0 / 3.0).abs() < 1e-15 && (high - 2.0).abs() < 1e-15);
        assert_eq!([zeros(4, 0.65), zeros(4, 0.0), zeros(4, 0.2)], [None; 3]);
        assert_eq!((step(5, 2), p_crit(3)), (0.5, Ok(1.0)));
        assert_eq!([limit_share(4.0), limit_share(0.5)], [0.75, 0.0]);
    }

    /// Second routes: the exact jump, off by about ln k; and ⌈k+⌉ of Eq. (13).
    #[test]
    fn the_rules_for_many_vertices_are_near_the_jump_and_its_share() {
        for big_n in [21, 100, 1000, 1_000_000] {
            let k = p_jump(SampleSpace::Simple, big_n).unwrap().k_after as f64;
            let rule = jump_rule(big_n).unwrap();
            assert!((rule - k).abs() <= 2.0 * pxfm::f_log(k) + 1.0, "N = {big_n}: {rule}");
        }
        assert_eq!(jump_rule(20), None);
        for (big_n, c) in [(100, 2.0), (10_000, 1.5), (1_000_000, 3.0)] {
            let p = c / big_n as f64;
            let k = local_maximum(big_n, p) as f64;
            let limit = limit_share(c) * big_n as f64;
            assert!(k < limit + 1.0 && k > limit - 1.0 / (p * (k - 1.0)), "{big_n} {c}");
        }
    }
}
