//! The relation of p and σ, Sec. 8, and gaps that close by themselves.

use super::Nucleation;
use crate::circuits::Error;
use crate::circuits::impact_probability::{ImpactProbability, density_forced, density_free};
use crate::numerics::bisection;
use crate::numerics::quadrature::GaussLegendre;
use crate::params::{Chain, Profile, SweepParams};

pub(super) fn densities() -> f64 {
    let rule = GaussLegendre::new(20);
    [0.05, 0.12, 0.4]
        .into_iter()
        .flat_map(|sigma| {
            let whole = |f: &dyn Fn(f64) -> f64| rule.integrate_panels(0.0, 20.0 * sigma, 40, f);
            [whole(&|x| density_free(x, sigma)), whole(&|x| density_forced(x, sigma, 1.0))]
        })
        .fold(0.0, |largest, integral| largest.max((integral - 1.0).abs()))
}

/// The σ at which the double integral still has some digits of p left.
const EQ25_SIGMAS: [f64; 5] = [0.15, 0.2, 0.3, 0.5, 1.0];

pub(super) fn eq25() -> Result<f64, Error> {
    let mut largest = 0.0_f64;
    for sigma in EQ25_SIGMAS {
        let gap = ImpactProbability::of_paper(sigma)?;
        largest = largest.max((gap.p_by_double_integral(8) / gap.p()? - 1.0).abs());
    }
    Ok(largest)
}

/// Probability that one of `gaps` independent gaps closes by itself.
pub(super) fn any(p: f64, gaps: usize) -> f64 {
    -pxfm::f_expm1(gaps as f64 * pxfm::f_log1p(-p))
}

/// At the σ of the main sweeps of all profiles.
pub(super) fn nucleation(gaps: usize) -> Result<Vec<Nucleation>, Error> {
    let profiles = [Profile::Quick, Profile::Ci, Profile::Full];
    let mut sigmas = profiles.map(|profile| SweepParams::main(profile).sigmas).concat();
    sigmas.sort_by(f64::total_cmp);
    sigmas.dedup();
    sigmas
        .into_iter()
        .map(|sigma| {
            let gap = ImpactProbability::of_paper(sigma)?;
            let p_rest = gap.p_from_rest().unwrap_or(0.0);
            let any_rest = any(p_rest, gaps);
            Ok(Nucleation { sigma, p: gap.p().unwrap_or(0.0), p_rest, any_rest })
        })
        .collect()
}

/// σ at which such a share of the chains has a gap that closes by itself.
pub(super) fn sigma_kept(share: f64, gaps: usize) -> f64 {
    let reached = |sigma: f64| {
        let p = ImpactProbability::of_paper(sigma).and_then(|gap| gap.p_from_rest());
        p.is_ok_and(|p| any(p, gaps) >= share)
    };
    bisection::bracket(0.01, 1.0, reached)[1]
}

/// Δ(0) = d + δα_0 − δα_1 is normal with variance 4σ² (both frequencies of the paper's chain).
pub(super) fn overlap(sigma: f64, chain: &Chain) -> Result<f64, Error> {
    let deviations = chain.spacing / (2.0 * sigma);
    let overlapped = 0.5 * pxfm::f_erfc(deviations / std::f64::consts::SQRT_2);
    Ok(overlapped / ImpactProbability::of_paper(sigma)?.p()?)
}
