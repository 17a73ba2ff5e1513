//! Calculations behind the slips and ambiguities of the printed paper.

use super::distributions::{sum, total_variation};
use super::{ClassFailure, FirstLocalMaximum, Point, SimpleShare, Slips};
use crate::circuits::distribution::{Law, SampleSpace};
use crate::circuits::graph::Graph;
use crate::circuits::higher_order::{self, CLASSES};
use crate::circuits::impact_probability::ImpactProbability;
use crate::circuits::{Error, Fraction, counting, jump};
use crate::params::{ENUMERATED_VERTICES, REMARK_P};
use SampleSpace::{FiveClasses, Simple};

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
        p_at_015: ImpactProbability::of_paper(0.15)?.p()?,
        simple_shares: each_p(|p| Ok(SimpleShare { p, share: simple_share(vertices, p)? }))?,
        total_variations: each_p(|p| Ok(Point { x: p, y: distance(vertices, p)? }))?,
        doubled_vertices: each_p(|p| Ok(Point { x: p, y: doubled_vertices(vertices, p)? }))?,
        class_failures: class_failures(),
        missing_factor: missing_factor(vertices, 3),
    })
}

fn each_p<T>(one: impl Fn(f64) -> Result<T, Error>) -> Result<Vec<T>, Error> {
    REMARK_P.into_iter().map(one).collect()
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

/// p k²/2 at k = μ: how many times more weight circuits with one doubled vertex have than simple
/// ones with as many different vertices, by Eqs. (7) and (33). With weights of all orders the
/// number of doubled vertices is about Poisson distributed around it.
fn doubled_vertices(vertices: usize, p: f64) -> Result<f64, Error> {
    let mean = Law::new(Simple, vertices, p)?.mean();
    Ok(0.5 * p * mean * mean)
}

/// The printed class formulas at the lengths where they fail, against a list of all circuits.
fn class_failures() -> Vec<ClassFailure> {
    type Printed = fn(usize, usize) -> Option<Fraction>;
    let cases: [(u32, usize, Printed, &[usize]); 4] = [
        (33, 2, higher_order::doubled, &[1]),
        (35, 3, higher_order::three_visits, &[0, 1]),
        (36, 4, higher_order::four_visits, &[0, 0, 1]),
        (37, 4, higher_order::two_doubled, &[2]),
    ];
    let vertices = ENUMERATED_VERTICES;
    let all: Vec<_> = Graph::of_chain(vertices - 1).circuits(4).collect();
    let row = |(equation, length, formula, repeats): (u32, usize, Printed, &[usize])| {
        let found = all.iter().filter(|c| c.length() == length && c.repeats() == repeats).count();
        let printed = formula(vertices, length)?.to_f64();
        Some(ClassFailure { equation, length, vertices, printed, primitive: found as u64 })
    };
    cases.into_iter().filter_map(row).collect()
}

/// Eq. (33) over Eq. (30) as printed, at length k; 0 if either is beyond 128 bits.
fn missing_factor(vertices: usize, k: usize) -> f64 {
    let complete = higher_order::doubled(vertices, k);
    let printed = higher_order::doubled_as_printed(vertices, k);
    complete.zip(printed).map_or(0.0, |(a, b)| a.to_f64() / b.to_f64())
}
