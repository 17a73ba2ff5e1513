//! The relation of p and σ once more, by integrals in place of closed forms. Slower and less exact; enough
//! to say whether a printed digit is right.

use crate::numerics::quadrature::GaussLegendre;
use pxfm::{f_erfc, f_exp, f_log};
use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex};

/// Sixteen points: exact to rounding on each panel of what is integrated here.
static RULE: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(16));

/// Panels of the integrals: the integrands are narrow for small σ.
const PANELS: usize = 24;

/// Eq. (25) for the paper's chain, with free amplitudes that are wider by the root of a ratio of variances: two
/// amplitudes with the density of Eq. (22) exceed d together.
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
    use crate::circuits::impact_probability::ImpactProbability;

    /// The closed form of Eq. (25) is the second route.
    #[test]
    fn integrals_have_their_known_values() {
        let p = |sigma| ImpactProbability::new(sigma, 1.0, 1.0, 2_f64.sqrt()).unwrap().p().unwrap();
        assert!((p_heated(0.12, 1.0) / p(0.12) - 1.0).abs() < 1e-9);
        assert!((p_heated(1e3, 1.0) - 1.0).abs() < 1e-6 && p_heated(0.12, 2.0) > p(0.12));
    }
}
