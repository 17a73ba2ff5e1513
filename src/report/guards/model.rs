//! Chances by integrals in place of closed forms. Slower and less exact; enough to say whether a printed digit is
//! right.

use crate::numerics::quadrature::GaussLegendre;
use pxfm::{f_erfc, f_exp, f_log};
use std::sync::LazyLock;

/// Sixteen points: exact to rounding on each panel of what is integrated here.
static RULE: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(16));

/// Panels of the integrals: the integrands are narrow for small σ.
const PANELS: usize = 24;

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
