//! Checks the relation of p and σ, Sec. 8.

use crate::experiments::theory::basics::largest;
use impact_circuits::impact_probability::{density_forced, density_free};
use impact_numerics::quadrature::GaussLegendre;
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// Amplitudes and start of a mass, in units of d and d ω: (α₁, β₁, x − j d, ẋ).
type Mass = [f64; 4];

/// Two neighbours whose amplitudes have nothing in common.
const PAIR: [Mass; 2] = [[0.11, -0.07, 0.0, 0.0], [-0.05, 0.13, 0.02, -0.03]];

/// Compares Δ_j(t) in Eq. (19) with x_j = x(0) cos t + ẋ(0) sin t + ∫ sin(t − s) F(s) ds.
pub(super) fn separation() -> f64 {
    let big_omega = SQRT_2;
    let detuning = 1.0 - big_omega * big_omega;
    let rule = GaussLegendre::new(20);
    let solved = |[alpha, beta, x, v]: Mass, t: f64| {
        let force = |s: f64| alpha * pxfm::f_cos(big_omega * s) + beta * pxfm::f_sin(big_omega * s);
        let answer = rule.integrate_panels(0.0, t, 8, |s| pxfm::f_sin(t - s) * force(s));
        x * pxfm::f_cos(t) + v * pxfm::f_sin(t) + answer
    };
    // The free parts that belong to the start.
    let free = |[alpha, beta, x, v]: Mass| [x - alpha / detuning, v - big_omega * beta / detuning];
    let [a, b] = PAIR;
    let ([a0, b0], [c0, d0]) = (free(a), free(b));
    largest([0.3, 1.0, 2.5, 7.0, 15.0].map(|t| {
        let printed = (c0 - a0) * pxfm::f_cos(t)
            + (d0 - b0) * pxfm::f_sin(t)
            + (b[0] - a[0]) / detuning * pxfm::f_cos(big_omega * t)
            + (b[1] - a[1]) / detuning * pxfm::f_sin(big_omega * t);
        (printed - (solved(b, t) - solved(a, t))).abs()
    }))
}

/// Returns the largest distance of the integral of a density up to x from the weight of that disc.
pub(super) fn distributions() -> f64 {
    let rule = GaussLegendre::new(20);
    let disc = |x: f64, s: f64| {
        rule.integrate_panels(-FRAC_PI_2, FRAC_PI_2, 12, |angle| {
            let (a, b) = (x * pxfm::f_sin(angle), x * pxfm::f_cos(angle));
            let normal = pxfm::f_exp(-a * a / (4.0 * s * s)) / (2.0 * s * PI.sqrt());
            normal * pxfm::f_erf(b / (2.0 * s)) * b
        })
    };
    let places = |sigma: f64| [0.5, 1.0, 2.0, 3.0, 10.0].map(|times| (times * sigma, sigma));
    largest([0.05, 0.12, 0.4].into_iter().flat_map(places).flat_map(|(x, sigma)| {
        let up_to = |f: &dyn Fn(f64) -> f64| rule.integrate_panels(0.0, x, 20, f);
        let free = up_to(&|x| density_free(x, sigma)) - disc(x, sigma);
        let forced = |detuning: f64| {
            up_to(&|x| density_forced(x, sigma, detuning)) - disc(x, sigma / detuning)
        };
        [free, forced(1.0), forced(0.5)].map(f64::abs)
    }))
}
