//! The relation of p and σ, Sec. 8, and gaps that close by themselves.

use super::Nucleation;
use crate::params::{Chain, Profile, SweepParams};
use impact_circuits::Error;
use impact_circuits::impact_probability::{
    ImpactProbability, amplitude, density_forced, density_free,
};
use impact_numerics::bisection;
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

pub(crate) fn eq25() -> Result<f64, Error> {
    let mut largest = 0.0_f64;
    for sigma in EQ25_SIGMAS {
        let gap = ImpactProbability::of_paper(sigma)?;
        largest = largest.max((gap.p_by_double_integral(8) / gap.p()? - 1.0).abs());
    }
    Ok(largest)
}

/// Probability that one of `gaps` independent gaps closes by itself.
pub(crate) fn any(p: f64, gaps: usize) -> f64 {
    -pxfm::f_expm1(gaps as f64 * pxfm::f_log1p(-p))
}

/// At the σ of the main sweeps of all profiles.
pub(crate) fn nucleation(gaps: usize) -> Result<Vec<Nucleation>, Error> {
    let profiles = [Profile::Quick, Profile::Full];
    let mut sigmas = profiles.map(|profile| SweepParams::main(profile).sigmas).concat();
    sigmas.sort_by(f64::total_cmp);
    sigmas.dedup();
    sigmas
        .into_iter()
        .map(|sigma| {
            let gap = ImpactProbability::of_paper(sigma)?;
            let p_rest = gap.p_from_rest().unwrap_or(0.0);
            let p = gap.p().unwrap_or(0.0);
            // A wall does not move: the amplitudes of its gap are those of one mass.
            let wall = ImpactProbability::of_paper(sigma / std::f64::consts::SQRT_2)?;
            let no_wall = 2.0 * pxfm::f_log1p(-wall.p().unwrap_or(0.0));
            let none = (gaps - 2) as f64 * pxfm::f_log1p(-p) + no_wall;
            let (any_rest, any_random) = (any(p_rest, gaps), -pxfm::f_expm1(none));
            Ok(Nucleation { sigma, p, p_rest, any_rest, any_random })
        })
        .collect()
}

/// σ at which such a share of the chains has a gap that closes by itself.
pub(crate) fn sigma_kept(share: f64, gaps: usize) -> f64 {
    let reached = |sigma: f64| {
        let p = ImpactProbability::of_paper(sigma).and_then(|gap| gap.p_from_rest());
        p.is_ok_and(|p| any(p, gaps) >= share)
    };
    bisection::bracket(0.01, 1.0, reached)[1]
}

/// Δ(0) = d + δα_0 − δα_1 is normal with variance 4σ² (both frequencies of the paper's chain).
pub(crate) fn overlap(sigma: f64, chain: &Chain) -> Result<f64, Error> {
    let deviations = chain.spacing / (2.0 * sigma);
    let overlapped = 0.5 * pxfm::f_erfc(deviations / std::f64::consts::SQRT_2);
    Ok(overlapped / ImpactProbability::of_paper(sigma)?.p()?)
}
