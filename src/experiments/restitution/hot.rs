//! What is expected of a chain that is so hot that its masses run past many places of rest.
//!
//! Impacts at r = 1 exchange velocities, so it is as if masses went through one another and took
//! over the force of the place in the row at which they are. Who runs at speed v feels the force of
//! another mass every d/|v|: forces of neighbours are independent, and ⟨F(t) F(t')⟩ is
//! σ² d δ(t − t')/|v|. The velocities diffuse,
//!
//! ∂f/∂t = ∂/∂v (A/|v| ∂f/∂v), A = σ² d/2,
//!
//! and from a narrow start f ∝ exp(−|v|³/(9 A t)). The spring of each place is what a row of charged
//! sheets is to one sheet: on average it cancels, and here it is left out.

use crate::params::Chain;
use impact_numerics::quadrature::GaussLegendre;
use pxfm::{f_cbrt, f_exp};

/// Where exp(−x³) is nothing.
const FAR: f64 = 3.6;

/// Impacts per unit of time at r = 1, in the mean over the window from `begin` to `end`.
pub fn hot(chain: &Chain, sigma: f64, begin: f64, end: f64) -> f64 {
    let d = chain.spacing;
    let rule = GaussLegendre::new(16);
    let weight = |x: f64| f_exp(-x * x * x);
    let sum = |f: &dyn Fn(f64) -> f64| rule.integrate_panels(0.0, FAR, 8, f);
    let all = sum(&weight);
    // The mean distance of two velocities is twice the integral of the share below times the share
    // above, over all velocities; that of the shares of |v| alone gives both signs at once.
    let above = |x: f64| 0.5 * rule.integrate_panels(x, FAR, 8, weight) / all;
    let distance = 4.0 * sum(&|x| above(x) * (1.0 - above(x)));
    // |v| in units of the cube root of 9 A t, whose mean over the window is that of a power.
    let scale = |t: f64| f_cbrt(4.5 * sigma * sigma * d * t);
    let mean = 0.75 * (end * scale(end) - begin * scale(begin)) / (end - begin);
    chain.gaps() as f64 * 0.5 * distance * mean / d
}
