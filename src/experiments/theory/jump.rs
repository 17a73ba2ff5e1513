//! The jump and its mechanism: Fig. 10 and single numbers.

use super::{Mechanism, Point, Scalars};
use SampleSpace::{FiveClasses, FiveClassesPrinted, Simple};
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::{Error, jump};
use impact_numerics::bisection;

/// Upper end of every search over σ: p(σ) and p_rest(σ) are above 0.99 there.
const LARGE_SIGMA: f64 = 1.0;

/// Points of f per unit of k.
const F_PER_UNIT: usize = 4;

/// Single numbers for one N.
pub fn scalars(vertices: usize) -> Result<Scalars, Error> {
    let simple = jump::p_jump(Simple, vertices)?;
    let higher = jump::p_jump(FiveClasses, vertices)?;
    let p_crit = jump::p_crit(vertices)?;
    let reaches = |p_of: fn(f64) -> f64, p: f64| smallest_sigma(|sigma| p_of(sigma) >= p);
    let half = |p_of: fn(f64) -> f64, space| {
        let middle = 0.5 * (vertices as f64 + 1.0);
        let mean = |p| Law::new(space, vertices, p).map_or(0.0, |law| law.mean());
        smallest_sigma(|sigma| mean(p_of(sigma)) >= middle)
    };
    Ok(Scalars {
        vertices,
        p_crit,
        p_jump: simple.p,
        k_after_jump: simple.k_after,
        sigma_crit: reaches(p_of, p_crit),
        sigma_jump: reaches(p_of, simple.p),
        sigma_jump_rest: reaches(p_rest_of, simple.p),
        higher_p_jump: higher.p,
        higher_k_after_jump: higher.k_after,
        higher_sigma_jump: reaches(p_of, higher.p),
        printed_p_jump: jump::p_jump(FiveClassesPrinted, vertices)?.p,
        sigma_half: half(p_of, Simple),
        higher_sigma_half: half(p_of, FiveClasses),
        sigma_half_rest: half(p_rest_of, Simple),
    })
}

/// The σ at which p(σ) reaches p.
pub fn sigma_of(p: f64) -> f64 {
    smallest_sigma(|sigma| p_of(sigma) >= p)
}

/// p(σ) for the paper's chain, 0 where it underflows.
fn p_of(sigma: f64) -> f64 {
    ImpactProbability::of_paper(sigma).and_then(|law| law.p()).unwrap_or(0.0)
}

/// The same for a start from rest.
fn p_rest_of(sigma: f64) -> f64 {
    ImpactProbability::of_paper(sigma).and_then(|law| law.p_from_rest()).unwrap_or(0.0)
}

/// The smallest σ at which a property that holds from there on holds, to the last bit.
fn smallest_sigma(holds: impl FnMut(f64) -> bool) -> f64 {
    bisection::bracket(0.0, LARGE_SIGMA, holds)[1]
}

/// Fig. 10: p → 0+, p_crit, half way from p_crit to the jump, and as far beyond the jump as the
/// jump is from p_crit.
pub fn mechanism(vertices: usize, scalars: &Scalars) -> Result<Vec<Mechanism>, Error> {
    let (crit, jump_at) = (scalars.p_crit, scalars.p_jump);
    let between = 0.5 * (crit + jump_at);
    let beyond = jump_at + (jump_at - crit);
    let mut rows = [0.0, crit, between, beyond].map(|p| stage(vertices, p));
    if let Ok(row) = &mut rows[1] {
        // The double nearest to p_crit may lie on either side of it; at p_crit itself both zeros
        // are 1/√p.
        let k = 1.0 / crit.sqrt();
        row.zeros = Some([k, k]);
    }
    rows.into_iter().collect()
}

fn stage(vertices: usize, p: f64) -> Result<Mechanism, Error> {
    let law = Law::new(Simple, vertices, p)?;
    let f = (0..=vertices * F_PER_UNIT).map(|i| {
        let k = i as f64 / F_PER_UNIT as f64;
        Point { x: k, y: jump::f(vertices, p, k) }
    });
    Ok(Mechanism {
        p,
        f: f.collect(),
        zeros: jump::zeros(vertices, p),
        phi_over_gamma: law.probabilities(),
        k_star: law.k_star(),
    })
}
