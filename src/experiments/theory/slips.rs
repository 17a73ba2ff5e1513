//! Calculations behind the slips and ambiguities of the printed paper.

use super::distributions::{sum, total_variation};
use super::{FirstLocalMaximum, Point, Slips};
use crate::params::REMARK_P;
use SampleSpace::{FiveClasses, Simple};
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::higher_order::{self, CLASSES};
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::{Error, Fraction, counting, jump};

/// All of them, for one N.
pub fn slips(vertices: usize) -> Result<Slips, Error> {
    let (shares, _) = counting::shares(vertices);
    let largest = (1..=vertices).max_by(|a, b| shares[a - 1].total_cmp(&shares[b - 1]));
    let near_end = vertices.saturating_sub(4);
    let at_one = Law::new(Simple, vertices, 1.0)?;
    let last_ratio = at_one.weight(vertices)? / at_one.weight(vertices - 1)?;
    Ok(Slips {
        ratio_before_last: counting::ratio_to_longest(vertices, vertices - 1),
        longest_peak: largest.unwrap_or(vertices),
        share_near_end: sum(shares[near_end..].iter().copied()),
        mean_at_zero: Law::new(Simple, vertices, 0.0)?.mean(),
        k_star_at_one: at_one.k_star(),
        last_ratio_at_one: last_ratio.to_f64(),
        first_local_maximum: first_local_maximum(vertices),
        simple_shares: each_p(|p| simple_share(vertices, p))?,
        total_variations: each_p(|p| distance(vertices, p))?,
        missing_factor: missing_factor(vertices, 3),
    })
}

/// p of the paper's chain at a σ.
pub(crate) fn p_at(sigma: f64) -> Result<f64, Error> {
    ImpactProbability::of_paper(sigma)?.p()
}

fn each_p(one: impl Fn(f64) -> Result<f64, Error>) -> Result<Vec<Point>, Error> {
    REMARK_P.into_iter().map(|x| Ok(Point { x, y: one(x)? })).collect()
}

fn first_local_maximum(vertices: usize) -> FirstLocalMaximum {
    let (k, [numerator, denominator]) = jump::first_local_maximum(vertices).unwrap_or((1, [1, 1]));
    let p = Fraction::new(numerator as u128, denominator as u128);
    FirstLocalMaximum {
        k,
        numerator: p.numerator as u64,
        denominator: p.denominator as u64,
        p: p.to_f64(),
    }
}

/// Weight of simple circuits over that of all five classes.
pub(crate) fn simple_share(vertices: usize, p: f64) -> Result<f64, Error> {
    let law = Law::new(FiveClasses, vertices, p)?;
    Ok(sum(law.contribution(&CLASSES[0]).into_iter()))
}

fn distance(vertices: usize, p: f64) -> Result<f64, Error> {
    let five = Law::new(FiveClasses, vertices, p)?.probabilities();
    Ok(total_variation(&five, &Law::new(Simple, vertices, p)?.probabilities()))
}

/// Eq. (33) over Eq. (30) as printed, at length k; 0 if either is beyond 128 bits.
fn missing_factor(vertices: usize, k: usize) -> f64 {
    let complete = higher_order::doubled(vertices, k);
    let printed = higher_order::doubled_as_printed(vertices, k);
    complete.zip(printed).map_or(0.0, |(a, b)| a.to_f64() / b.to_f64())
}
