//! The relation of p and σ, Sec. 8.

use impact_circuits::impact_probability::{
    ImpactProbability, amplitude, density_forced, density_free,
};
use impact_numerics::quadrature::GaussLegendre;

/// Amplitudes and start of a mass, in units of d and d ω: (α₁, β₁, x − j d, ẋ).
type Mass = [f64; 4];

/// Two neighbours whose amplitudes have nothing in common.
const PAIR: [Mass; 2] = [[0.11, -0.07, 0.0, 0.0], [-0.05, 0.13, 0.02, -0.03]];

/// Δ_j(t) as Eq. (19) has it, against x_j = x(0) cos t + ẋ(0) sin t + ∫ sin(t − s) F(s) ds.
pub(super) fn separation() -> f64 {
    let big_omega = std::f64::consts::SQRT_2;
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
    [0.3, 1.0, 2.5, 7.0, 15.0].into_iter().fold(0.0, |largest: f64, t| {
        let printed = (c0 - a0) * pxfm::f_cos(t)
            + (d0 - b0) * pxfm::f_sin(t)
            + (b[0] - a[0]) / detuning * pxfm::f_cos(big_omega * t)
            + (b[1] - a[1]) / detuning * pxfm::f_sin(big_omega * t);
        largest.max((printed - (solved(b, t) - solved(a, t))).abs())
    })
}

/// The mean square of a harmonic over a period is half the square of its amplitude; equally spaced
/// phases give it without error.
pub(super) fn amplitudes() -> f64 {
    let phases = 16;
    [[0.3, 0.4], [-1.0, 0.2], [0.0, -0.7]].into_iter().fold(0.0, |largest: f64, [a, b]| {
        let mean: f64 = (0..phases)
            .map(|i| {
                let phase = 2.0 * std::f64::consts::PI * f64::from(i) / f64::from(phases);
                let part = a * pxfm::f_cos(phase) + b * pxfm::f_sin(phase);
                part * part / f64::from(phases)
            })
            .sum();
        largest.max(((2.0 * mean).sqrt() / amplitude(a, b) - 1.0).abs())
    })
}

/// The integral of a density up to x, against the weight of a disc of radius x: two independent
/// normal differences of variance 2 s², with s = σ and σ/|ω² − Ω²|.
pub(super) fn distributions() -> f64 {
    let rule = GaussLegendre::new(20);
    let disc = |x: f64, s: f64| {
        let half = std::f64::consts::FRAC_PI_2;
        let root = std::f64::consts::PI.sqrt();
        rule.integrate_panels(-half, half, 12, |angle| {
            let (a, b) = (x * pxfm::f_sin(angle), x * pxfm::f_cos(angle));
            let normal = pxfm::f_exp(-a * a / (4.0 * s * s)) / (2.0 * s * root);
            normal * pxfm::f_erf(b / (2.0 * s)) * b
        })
    };
    let mut largest = 0.0_f64;
    for sigma in [0.05, 0.12, 0.4] {
        for x in [0.5, 1.0, 2.0, 3.0, 10.0].map(|times| times * sigma) {
            let up_to = |f: &dyn Fn(f64) -> f64| rule.integrate_panels(0.0, x, 20, f);
            let free = up_to(&|x| density_free(x, sigma));
            largest = largest.max((free - disc(x, sigma)).abs());
            for detuning in [1.0, 0.5] {
                let forced = up_to(&|x| density_forced(x, sigma, detuning));
                largest = largest.max((forced - disc(x, sigma / detuning)).abs());
            }
        }
    }
    largest
}

/// The σ at which the double integral still has some digits of p left.
const EQ25_SIGMAS: [f64; 5] = [0.15, 0.2, 0.3, 0.5, 1.0];

/// Eq. (25): largest relative difference between closed form and double integral.
pub(crate) fn eq25() -> f64 {
    EQ25_SIGMAS.into_iter().fold(0.0, |largest: f64, sigma| {
        let gap = ImpactProbability::of_paper(sigma).expect("σ is positive");
        let p = gap.p().expect("σ is large enough");
        largest.max((gap.p_by_double_integral(8) / p - 1.0).abs())
    })
}
