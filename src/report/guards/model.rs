//! The theory of Secs. 6 to 9 once more, by other formulas than the program's: logarithms of the gamma
//! function in place of products, integrals in place of closed forms, sequences in place of
//! polynomials. Slower and less exact; enough to say whether a printed digit is right.

use crate::numerics::quadrature::GaussLegendre;
use pxfm::{f_erfc, f_exp, f_lgamma, f_log, f_sqrt1pm1};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, LazyLock, Mutex};

/// Sixteen points: exact to rounding on each panel of what is integrated here.
static RULE: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(16));

/// Visits of the repeated vertices in each of the five classes.
const CLASSES: [&[usize]; 5] = [&[], &[2], &[3], &[4], &[2, 2]];

/// ln x!.
pub fn log_factorial(x: usize) -> f64 {
    f_lgamma(x as f64 + 1.0)
}

/// ln of the number of simple circuits of length k, N!/(k (N − k)!).
pub fn log_simple(big_n: usize, k: usize) -> f64 {
    log_factorial(big_n) - log_factorial(big_n - k) - f_log(k as f64)
}

/// Circuits of a class over simple ones with as many different vertices, each edge beyond theirs
/// weighing p: cyclic sequences, less those that are a shorter one repeated.
pub fn over_simple(class: &[usize], k: usize, p: f64) -> f64 {
    let excess: usize = class.iter().map(|visits| visits - 1).sum();
    match (class, k) {
        (_, k) if k < class.len().max(1) => return 0.0,
        ([], _) => return 1.0,
        // One vertex run over and over.
        ([_], 1) => return 0.0,
        // Of two vertices twice each, abab is ab twice.
        ([2, 2], 2) => return p * p,
        _ => {}
    }
    let choices: f64 = (0..class.len()).map(|i| (k - i) as f64 / (i + 1) as f64).product();
    let orders = class.iter().map(|visits| log_factorial(*visits)).sum::<f64>();
    let sequences = log_factorial(k + excess - 1) - orders - log_factorial(k - 1);
    choices * f_exp(sequences + excess as f64 * f_log(p))
}

/// A distribution over the number of different impacts.
#[derive(Debug)]
pub struct Law {
    /// P(X = k) at index k − 1, for each class.
    pub classes: Vec<[f64; 5]>,
}

impl Law {
    /// Of simple circuits, or of five classes. Guards ask for the same ones again and again, so that
    /// they are remembered.
    pub fn new(big_n: usize, p: f64, five: bool) -> Arc<Self> {
        static KNOWN: Known<(usize, u64, bool), Arc<Law>> = Known::new();
        KNOWN.get((big_n, p.to_bits(), five), || Arc::new(Law::compute(big_n, p, five)))
    }

    fn compute(big_n: usize, p: f64, five: bool) -> Self {
        let logs: Vec<f64> =
            (1..=big_n).map(|k| log_simple(big_n, k) + k as f64 * f_log(p)).collect();
        let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let count = if five { CLASSES.len() } else { 1 };
        let mut classes = vec![[0.0; 5]; big_n];
        for (index, (own, log)) in classes.iter_mut().zip(logs).enumerate() {
            let simple = f_exp(log - top);
            for (weight, class) in own.iter_mut().zip(CLASSES).take(count) {
                *weight = simple * over_simple(class, index + 1, p);
            }
        }
        let whole: f64 = classes.iter().flatten().sum();
        classes.iter_mut().flatten().for_each(|weight| *weight /= whole);
        Law { classes }
    }

    /// P(X = k), at index k − 1.
    pub fn whole(&self) -> Vec<f64> {
        self.classes.iter().map(|own| own.iter().sum()).collect()
    }

    /// The mean.
    pub fn mean(&self) -> f64 {
        let terms = self.classes.iter().enumerate();
        terms.map(|(i, own)| (i + 1) as f64 * own.iter().sum::<f64>()).sum()
    }

    /// The share of a class.
    pub fn share(&self, class: usize) -> f64 {
        self.classes.iter().map(|own| own[class]).sum()
    }

    /// Most likely k from `from` on.
    pub fn peak(&self, from: usize) -> usize {
        let whole = self.whole();
        let rest = (from..=whole.len()).max_by(|a, b| whole[a - 1].total_cmp(&whole[b - 1]));
        rest.unwrap_or(from)
    }
}

/// Half the sum of the differences of two distributions.
pub fn variation(a: &Law, b: &Law) -> f64 {
    0.5 * a.whole().iter().zip(b.whole()).map(|(a, b)| (a - b).abs()).sum::<f64>()
}

/// Panels of the integrals: the integrands are narrow for small σ.
const PANELS: usize = 24;

/// Eq. (25) for the paper's chain: two amplitudes with the density of Eq. (22) exceed d together.
pub fn p(sigma: f64) -> f64 {
    static KNOWN: Known<u64, f64> = Known::new();
    KNOWN.get(sigma.to_bits(), || both_amplitudes(sigma, sigma))
}

/// The same with free amplitudes that are wider by the root of a ratio of variances.
pub fn p_heated(sigma: f64, ratio: f64) -> f64 {
    static KNOWN: Known<[u64; 2], f64> = Known::new();
    let key = [sigma.to_bits(), ratio.to_bits()];
    KNOWN.get(key, || both_amplitudes(sigma * ratio.sqrt(), sigma))
}

/// Rayleigh amplitudes of a free and a forced part exceed d together.
fn both_amplitudes(free: f64, forced: f64) -> f64 {
    let tail = |x: f64, scale: f64| f_exp(-(0.5 * x / scale) * (0.5 * x / scale));
    let density = |x: f64| 0.5 * x / (forced * forced) * tail(x, forced);
    let both = |x: f64| density(x) * tail(1.0 - x, free);
    tail(1.0, forced) + RULE.integrate_panels(0.0, 1.0, PANELS, both)
}

/// The same for a start from rest, where the free amplitude goes with the forced one: the mean over
/// the phase, Ω² = 2 ω².
pub fn p_rest(sigma: f64) -> f64 {
    static KNOWN: Known<u64, f64> = Known::new();
    KNOWN.get(sigma.to_bits(), || over_phases(sigma))
}

fn over_phases(sigma: f64) -> f64 {
    let rate = 0.5 / sigma;
    let at = |theta: f64| {
        let sin = pxfm::f_sin(theta);
        let reach = 2.0 + f_sqrt1pm1(sin * sin);
        f_exp(-(rate / reach) * (rate / reach))
    };
    RULE.integrate_panels(0.0, FRAC_PI_2, PANELS, at) / FRAC_PI_2
}

/// The chance that the length of two normal amplitudes of that scale exceeds a height: their density
/// over all directions, summed from there on.
pub fn rayleigh_above(height: f64, scale: f64) -> f64 {
    let density = |x: f64| x / (scale * scale) * f_exp(-0.5 * (x / scale) * (x / scale));
    RULE.integrate_panels(height, height + 12.0 * scale, PANELS, density)
}

/// One of so many independent gaps, each with this probability.
pub fn any(p: f64, gaps: f64) -> f64 {
    1.0 - f_exp(gaps * f_log(1.0 - p))
}

/// P(|Z| > z) for a standard normal Z.
pub fn both_tails(z: f64) -> f64 {
    f_erfc(z * std::f64::consts::FRAC_1_SQRT_2)
}

/// A relation of p and σ with a sample space: the columns of theory beside the simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// Eq. (25), simple circuits.
    Simple,
    /// Eq. (25), five classes.
    Higher,
    /// A start from rest, simple circuits.
    Rest,
}

/// μ at σ.
pub fn mean_at(big_n: usize, sigma: f64, column: Column) -> f64 {
    let p = if column == Column::Rest { p_rest(sigma) } else { p(sigma) };
    Law::new(big_n, p, column == Column::Higher).mean()
}

/// Numbers that follow from a key alone.
pub struct Known<K, V>(Mutex<BTreeMap<K, V>>);

/// More are not remembered: wrong numbers ask for others each time.
const REMEMBERED: usize = 4096;

impl<K: Ord, V: Clone> Known<K, V> {
    pub const fn new() -> Self {
        Known(Mutex::new(BTreeMap::new()))
    }

    pub fn get(&self, key: K, compute: impl FnOnce() -> V) -> V {
        let known = self.0.lock().ok().and_then(|known| known.get(&key).cloned());
        known.unwrap_or_else(|| {
            let value = compute();
            if let Ok(mut known) = self.0.lock()
                && known.len() < REMEMBERED
            {
                known.insert(key, value.clone());
            }
            value
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_cases_by_hand() {
        // N = 2: two loops of weight p, one circuit of both with p².
        let law = Law::new(2, 0.5, false);
        assert!((law.mean() - (1.0 + 0.25 * 2.0) / 1.25).abs() < 1e-12);
        // With five classes: aab and abb p³, aaab and abbb p⁴, aaaab and abbbb p⁵, aabb p⁴.
        let law = Law::new(2, 0.5, true);
        let pair = 0.25 + 2.0 * 0.125 + 2.0 * 0.0625 + 2.0 * 0.03125 + 0.0625;
        assert!((law.whole()[1] - pair / (1.0 + pair)).abs() < 1e-12);
        assert_eq!(law.peak(2), 2);
    }

    /// From 40-digit arithmetic: p(0.12) and p_rest(0.12).
    #[test]
    fn integrals_have_their_known_values() {
        assert!((p_rest(0.12) - 0.0309524).abs() < 1e-7);
        assert!((p(1e3) - 1.0).abs() < 1e-6 && p(0.12) < p_rest(0.12));
    }
}
