//! Distributions at single values of p: Figs. 7, 8, 13 and 14.

use super::{ClassContribution, Distribution, HigherDistribution, SimpleCircuits};
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::higher_order::CLASSES;
use impact_circuits::{Error, counting};

/// Fig. 7.
pub fn simple_circuits(vertices: usize) -> Result<SimpleCircuits, Error> {
    let (share, log_total) = counting::shares(vertices);
    let log_count =
        (1..=vertices).map(|k| counting::log_phi(vertices, k)).collect::<Result<_, _>>()?;
    Ok(SimpleCircuits { share, log_count, log_total })
}

/// Fig. 8, one panel.
pub fn simple(vertices: usize, p: f64) -> Result<Distribution, Error> {
    let law = Law::new(SampleSpace::Simple, vertices, p)?;
    let probability = law.probabilities();
    Ok(Distribution { p, probability, k_star: law.k_star(), mean: law.mean() })
}

/// Figs. 13 and 14, one panel.
pub fn higher(vertices: usize, p: f64) -> Result<HigherDistribution, Error> {
    let law = Law::new(SampleSpace::FiveClasses, vertices, p)?;
    let simple_law = Law::new(SampleSpace::Simple, vertices, p)?;
    let (total, simple) = (law.probabilities(), simple_law.probabilities());
    let classes = CLASSES.iter().map(|class| {
        let probability = law.contribution(class);
        let share = sum(probability.iter().copied());
        ClassContribution { probability, share }
    });
    Ok(HigherDistribution {
        p,
        classes: classes.collect(),
        mean: law.mean(),
        mean_simple: simple_law.mean(),
        total_variation: total_variation(&total, &simple),
        total,
        simple,
    })
}

/// Half the sum of absolute differences.
pub fn total_variation(a: &[f64], b: &[f64]) -> f64 {
    0.5 * sum(a.iter().zip(b).map(|(a, b)| (a - b).abs()))
}

/// Sum in order.
pub fn sum(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |sum, value| sum + value)
}
