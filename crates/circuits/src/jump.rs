//! Why the most likely number of impacts jumps (Sec. 7).

use super::distribution::{Law, SampleSpace, Weights};
use super::{Error, check_vertices};
use impact_numerics::bisection;
use impact_numerics::double_double::{DoubleDouble, two_product};
use impact_numerics::scaled::Scaled;

/// **Eq. (11)**
///
/// Φ_{N,p}(k + 1) − Φ_{N,p}(k) = p^k N!/((N − k)! k (k + 1)) · f_{N,p}(k), for 1 ≤ k < N.
pub fn difference(big_n: usize, p: f64, k: usize) -> Scaled {
    let edges = (0..k).fold(Scaled::ONE, |w, i| w * (Scaled::from(p) * Scaled::from(big_n - i)));
    let below = Scaled::from(k) * Scaled::from(k + 1);
    edges / below * Scaled::from(f_exact(big_n, p, k))
}

/// **Eq. (12)**
///
/// f_{N,p}(k) = −p k² + (N p − 1) k − 1 at real k: Φ_{N,p} rises from k to k + 1 where it is
/// positive. Written as p k (N − k) − (k + 1), with the product exact.
pub fn f(big_n: usize, p: f64, k: f64) -> f64 {
    let product = two_product(k, big_n as f64 - k) * p;
    (product - DoubleDouble::from(k) - DoubleDouble::ONE).to_f64()
}

/// f_{N,p} at an integer k, exactly.
fn f_exact(big_n: usize, p: f64, k: usize) -> DoubleDouble {
    // k (N − k) ≤ N²/4 < 2^53 for every N allowed, so one error-free product is all.
    two_product(p, (k * (big_n - k)) as f64) - DoubleDouble::from(k + 1)
}

/// Whether Φ_{N,p}(k + 1) > Φ_{N,p}(k), decided exactly, for 1 ≤ k < N.
pub fn rises(big_n: usize, p: f64, k: usize) -> bool {
    k < big_n && f_exact(big_n, p, k) > DoubleDouble::ZERO
}

/// **Eq. (13)**
///
/// The zeros k− ≤ k+ of f_{N,p}, or nothing when it has none (p below p_crit, or p = 0). The
/// smaller one comes from k− k+ = 1/p, since the printed difference would cancel.
pub fn zeros(big_n: usize, p: f64) -> Option<[f64; 2]> {
    let b = two_product(p, big_n as f64) - DoubleDouble::ONE;
    let discriminant = b * b - DoubleDouble::from(4.0 * p);
    if p <= 0.0 || b.hi <= 0.0 || discriminant < DoubleDouble::ZERO {
        return None;
    }
    let twice = (b + discriminant.sqrt()).to_f64();
    Some([2.0 / twice, twice / (2.0 * p)])
}

/// **Eq. (14)** (step towards (18))
///
/// f_{N,p}(0) = −1, whatever N and p.
pub fn f_at_zero() -> f64 {
    -1.0
}

/// **Eq. (15)** (step towards (18))
///
/// f_{N,p}(N) = −(N + 1), whatever p.
pub fn f_at_end(big_n: usize) -> f64 {
    -(big_n as f64 + 1.0)
}

/// **Eq. (16)** (step towards (18))
///
/// f_{N,0}(k) = −(k + 1) < 0: at p → 0+ every step falls.
pub fn f_without_p(k: f64) -> f64 {
    -(k + 1.0)
}

/// **Eq. (17)** (step towards (18))
///
/// ∂f/∂p = k (N − k), positive inside (0, N): f grows with p at every k.
pub fn slope_in_p(big_n: usize, k: f64) -> f64 {
    k * (big_n as f64 - k)
}

/// **Eq. (18)**
///
/// p_crit = ((1 + √(N + 1))/N)², where f_{N,p} first touches zero: Φ gets a stationary point, as
/// a function of real k. k* stays at 1 until [`p_jump`].
///
/// # Errors
/// [`Error::Input`] for N outside 1..=[`super::LARGEST_N`].
pub fn p_crit(big_n: usize) -> Result<f64, Error> {
    check_vertices(big_n)?;
    let root = (1.0 + (big_n as f64 + 1.0).sqrt()) / big_n as f64;
    Ok(root * root)
}

/// The k > 1 at which Φ_{N,p}(k) over integers has its local maximum (the lower of two equal
/// ones), or 1 if Φ falls everywhere: ⌈k+⌉, since f is a forward difference.
pub fn local_maximum(big_n: usize, p: f64) -> usize {
    let Some([_, plus]) = zeros(big_n, p) else { return 1 };
    // Rounding may put k+ on the wrong side of an integer: exact signs decide.
    let mut k = (plus as usize).clamp(1, big_n);
    while rises(big_n, p, k) {
        k += 1;
    }
    while k > 1 && !rises(big_n, p, k - 1) {
        if f_falls_from_start(big_n, p, k - 1) {
            return 1;
        }
        k -= 1;
    }
    k
}

/// Whether k lies left of the vertex of the parabola f, so that f < 0 from there down to 1.
fn f_falls_from_start(big_n: usize, p: f64, k: usize) -> bool {
    2.0 * p * k as f64 <= p * big_n as f64 - 1.0
}

/// The p at which k* steps from k to k + 1 once k* > 1: f_{N,p}(k) = 0, so (k + 1)/(k (N − k)).
pub fn step(big_n: usize, k: usize) -> f64 {
    (k + 1) as f64 / (k * (big_n - k)) as f64
}

/// The first local maximum of Φ over integers as p grows: the k > 1 where f_{N,p}(k) = 0 at the
/// smallest p, and that p as numerator and denominator. A little above p_crit, unless k+ is an
/// integer there. Needs N ≥ 3.
pub fn first_local_maximum(big_n: usize) -> Option<(usize, [usize; 2])> {
    // (k + 1)/(k (N − k)) over k: compare as integers, exactly.
    let parts = |k: usize| [k + 1, k * (big_n - k)];
    let before = |a: [usize; 2], b: [usize; 2]| (a[0] * b[1]).cmp(&(b[0] * a[1]));
    (2..big_n).min_by(|a, b| before(parts(*a), parts(*b))).map(|k| (k, parts(k)))
}

/// Where the most likely number of impacts leaves 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// The double nearest to the infimum of p with k* > 1.
    pub p: f64,
    /// Neighbouring doubles around that infimum: k* = 1 at the first and k* > 1 at the second.
    pub bracket: [f64; 2],
    /// k* just after the jump.
    pub k_after: usize,
}

/// The actual jump of k*: the infimum of p with k* > 1, and k* after it.
///
/// Φ(k)/Φ(1) grows with p for every k > 1, so "some Φ(k) exceeds Φ(1)" turns true once, and
/// bisection over doubles finds the place to the last bit.
///
/// # Errors
/// [`Error::NoJump`] if k* = 1 for every p (N ≤ 3 for simple circuits, N = 1 with higher orders),
/// [`Error::Input`] for N out of range.
pub fn p_jump(space: SampleSpace, big_n: usize) -> Result<Jump, Error> {
    check_vertices(big_n)?;
    if !first_is_exceeded(space, big_n, DoubleDouble::ONE) {
        let least = if space == SampleSpace::Simple { 4 } else { 2 };
        return Err(Error::NoJump { vertices: big_n, least });
    }
    let exceeded = |p: f64| first_is_exceeded(space, big_n, DoubleDouble::from(p));
    let [below, above] = bisection::bracket(0.0, 1.0, exceeded);
    let half = DoubleDouble { hi: below, lo: 0.5 * (above - below) };
    let p = if first_is_exceeded(space, big_n, half) { below } else { above };
    Ok(Jump { p, bracket: [below, above], k_after: Law::new(space, big_n, above)?.k_star() })
}

/// Whether some k > 1 has more weight than k = 1.
fn first_is_exceeded(space: SampleSpace, big_n: usize, p: DoubleDouble) -> bool {
    let mut weights = Weights::new(space, big_n, p);
    let first = weights.moment();
    for k in 2..=big_n {
        weights.advance();
        // Φ(k) > Φ(1), multiplied by k: no division, so ties at small k are exact.
        if weights.moment() > first * Scaled::from(k) {
            return true;
        }
        if weights.falls_for_good() {
            return false;
        }
    }
    false
}
