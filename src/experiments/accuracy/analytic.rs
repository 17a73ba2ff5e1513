//! Ways to compute the relation of Eq. (25) and the distribution of Eq. (9): digits and work.

use super::exact::{decay, erf_integral};
use crate::circuits;
use crate::circuits::distribution::{Law, SampleSpace};
use crate::circuits::impact_probability::ImpactProbability;
use crate::experiments::{Error, Progress};
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::scaled::Scaled;
use crate::params::AnalyticParams;
use serde::{Deserialize, Serialize};

/// Accuracy and work of the ways to compute.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Analytic {
    /// What was run.
    pub parameters: AnalyticParams,
    /// Ways to p(σ) of Eq. (25): the double integral with rising numbers of panels, the single
    /// integral, the closed form.
    pub relation: Vec<Relation>,
    /// Ways to P(X = k) of Eq. (9).
    pub distribution: Vec<Distribution>,
}

/// One way to p(σ).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Relation {
    /// The way.
    pub route: Route,
    /// Values of the integrand that it takes; 1 for the closed form.
    pub evaluations: u64,
    /// σ and relative error against 106 bits.
    pub points: Vec<(f64, f64)>,
}

/// A way to p(σ).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Route {
    /// One minus the double integral of Eq. (25), as printed.
    DoubleIntegral {
        /// Panels of 20 points in each direction.
        panels: usize,
    },
    /// One minus a single integral of positive terms.
    SingleIntegral,
    /// The closed form.
    ClosedForm,
}

/// One way to the distribution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distribution {
    /// The way.
    pub way: Way,
    /// One for each N.
    pub points: Vec<SizePoint>,
}

/// A way to the distribution of Eq. (9).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// Factorials and powers in doubles, as Eq. (10) is printed.
    Factorials,
    /// Exponentials of differences of log-gamma.
    LogGamma,
    /// Ratios of neighbouring terms in doubles, outwards from the largest.
    Ratios,
    /// What this program does: products with 106 bits and an exponent of their own.
    Products,
}

impl Way {
    /// All ways.
    pub const ALL: [Way; 4] = [Way::Factorials, Way::LogGamma, Way::Ratios, Way::Products];
}

/// One way at one N.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SizePoint {
    /// N.
    pub big_n: usize,
    /// Largest relative error of μ and of all P(X = k) above 1e−12; none where the way has left
    /// the range of doubles.
    pub error: Option<f64>,
    /// Terms that were computed.
    pub terms: u64,
}

/// Probabilities below this are not compared.
const COMPARED: f64 = 1e-12;

/// Terms below this part of the largest change no double; the reference goes further.
const NEGLIGIBLE: f64 = 1e-18;
const NEGLIGIBLE_TO_REFERENCE: f64 = 1e-33;

impl Analytic {
    /// Largest error of a route to p(σ).
    pub fn relation_error(&self, route: Route) -> Option<f64> {
        let own = self.relation.iter().find(|own| own.route == route)?;
        own.points.iter().map(|point| point.1).max_by(f64::total_cmp)
    }

    /// Largest error of a way to the distribution over N.
    pub fn distribution_error(&self, way: Way) -> Option<f64> {
        let own = self.distribution.iter().find(|own| own.way == way)?;
        own.points.iter().filter_map(|point| point.error).max_by(f64::total_cmp)
    }
}

/// Runs everything.
pub fn run(parameters: &AnalyticParams, progress: &Progress) -> Result<Analytic, Error> {
    let stage = progress.stage("analytic methods", parameters.sizes.len() as u64 + 1);
    let refused = |error: circuits::Error| {
        Error::input("analytic methods", error.to_string(), "correct params::AnalyticParams")
    };
    let relation = relation(parameters).map_err(refused)?;
    stage.advance(1);
    let mut points: [Vec<SizePoint>; 4] = Default::default();
    for &big_n in &parameters.sizes {
        progress.check()?;
        let found = sizes(big_n, parameters.mean_degree / big_n as f64).map_err(refused)?;
        points.iter_mut().zip(found).for_each(|(points, point)| points.push(point));
        stage.advance(1);
    }
    let distribution = Way::ALL.into_iter().zip(points);
    Ok(Analytic {
        parameters: parameters.clone(),
        relation,
        distribution: distribution.map(|(way, points)| Distribution { way, points }).collect(),
    })
}

/// p(σ) of the paper's chain to about 1e−29: e^{−s²} + √(π/2) s e^{−s²/2} erf(s/√2), s = 1/(2σ).
pub fn p_exact(sigma: f64) -> Scaled {
    let s = DoubleDouble::ONE / DoubleDouble::from(2.0 * sigma);
    let square = s * s;
    let root = DoubleDouble::from(2.0).sqrt();
    let second = erf_integral(s / root) * decay(square.times_power_of_two(0.5));
    decay(square) + second * Scaled::from(root * s)
}

fn relation(parameters: &AnalyticParams) -> Result<Vec<Relation>, circuits::Error> {
    let doubles = parameters.panels.iter().map(|&panels| Route::DoubleIntegral { panels });
    let routes = doubles.chain([Route::SingleIntegral, Route::ClosedForm]);
    routes
        .map(|route| {
            let point = |&sigma: &f64| {
                let law = ImpactProbability::of_paper(sigma)?;
                let p = match route {
                    Route::DoubleIntegral { panels } => law.p_by_double_integral(panels),
                    Route::SingleIntegral => 1.0 - law.complement(),
                    Route::ClosedForm => law.p()?,
                };
                let exact = p_exact(sigma);
                Ok((sigma, ((Scaled::from(p) - exact) / exact).to_f64().abs()))
            };
            let evaluations = match route {
                // 20 points a panel, in each direction.
                Route::DoubleIntegral { panels } => 400 * (panels * panels) as u64,
                // 48 points in each of up to four panels.
                Route::SingleIntegral => 4 * 48,
                Route::ClosedForm => 1,
            };
            let points = parameters.sigmas.iter().map(point).collect::<Result<_, _>>()?;
            Ok(Relation { route, evaluations, points })
        })
        .collect()
}

/// The part of a distribution that is compared: P(X = k) for k from `first` on, and μ.
struct Part {
    first: usize,
    probability: Vec<DoubleDouble>,
    mean: DoubleDouble,
}

/// The largest term of Eq. (10) with an inner maximum: there p (N − k) k/(k + 1) falls below 1.
fn peak(big_n: usize, p: f64) -> usize {
    let rises = |k: &usize| {
        let k = *k as f64;
        p * (big_n as f64 - k) * k / (k + 1.0) >= 1.0
    };
    (1..=big_n).rev().find(rises).map_or(1, |k| k + 1)
}

/// Eq. (9) to 106 bits, by ratios of neighbouring terms outwards from the largest.
fn reference(big_n: usize, p: f64) -> Part {
    let dd = |n: usize| DoubleDouble::from(n);
    let top = peak(big_n, p);
    let ratio = |k: usize| DoubleDouble::from(p) * dd(big_n - k) * dd(k) / dd(k + 1);
    let (mut below, mut above) = (Vec::new(), vec![DoubleDouble::ONE]);
    let mut term = DoubleDouble::ONE;
    for k in (1..top).rev() {
        term = term / ratio(k);
        if term.hi < NEGLIGIBLE_TO_REFERENCE {
            break;
        }
        below.push(term);
    }
    term = DoubleDouble::ONE;
    for k in top..big_n {
        term = term * ratio(k);
        if term.hi < NEGLIGIBLE_TO_REFERENCE {
            break;
        }
        above.push(term);
    }
    let first = top - below.len();
    let weights: Vec<_> = below.into_iter().rev().chain(above).collect();
    let sum = |f: &dyn Fn(usize) -> DoubleDouble| {
        weights.iter().enumerate().fold(DoubleDouble::ZERO, |s, (i, w)| s + *w * f(first + i))
    };
    let total = sum(&|_| DoubleDouble::ONE);
    let mean = sum(&dd) / total;
    Part { first, probability: weights.iter().map(|w| *w / total).collect(), mean }
}

/// All ways at one N, in the order of [`Way::ALL`].
fn sizes(big_n: usize, p: f64) -> Result<[SizePoint; 4], circuits::Error> {
    let exact = reference(big_n, p);
    let point = |error, terms| SizePoint { big_n, error, terms };
    let from_weights = |(first, weights): (usize, Vec<f64>)| {
        let total: f64 = weights.iter().sum();
        let moment: f64 = weights.iter().enumerate().map(|(i, w)| (first + i) as f64 * w).sum();
        let terms = weights.len() as u64;
        let at = |k: usize| k.checked_sub(first).and_then(|i| weights.get(i)).map(|w| w / total);
        point(largest_error(&exact, at, moment / total), terms)
    };
    let law = Law::new(SampleSpace::Simple, big_n, p)?;
    let own = law.probabilities();
    let products = largest_error(&exact, |k| own.get(k - 1).copied(), law.mean());
    Ok([
        from_weights((1, factorials(big_n, p))),
        from_weights((1, log_gammas(big_n, p))),
        from_weights(ratios(big_n, p)),
        point(products, big_n as u64),
    ])
}

/// Largest relative error of μ and of the probabilities that count; none if one is not finite.
fn largest_error(exact: &Part, at: impl Fn(usize) -> Option<f64>, mean: f64) -> Option<f64> {
    let relative =
        |x: f64, exact: DoubleDouble| ((DoubleDouble::from(x) - exact) / exact).to_f64().abs();
    let compared = exact.probability.iter().enumerate().filter(|(_, p)| p.hi > COMPARED);
    let errors = compared.map(|(i, p)| relative(at(exact.first + i).unwrap_or(f64::NAN), *p));
    let all: Vec<f64> = errors.chain([relative(mean, exact.mean)]).collect();
    all.iter().all(|e| e.is_finite()).then(|| all.into_iter().fold(0.0, f64::max))
}

/// p^k N!/(k (N − k)!), each factorial on its own.
fn factorials(big_n: usize, p: f64) -> Vec<f64> {
    let mut table = vec![1.0];
    for k in 1..=big_n {
        table.push(table[k - 1] * k as f64);
    }
    let mut power = 1.0;
    (1..=big_n)
        .map(|k| {
            power *= p;
            power * table[big_n] / (k as f64 * table[big_n - k])
        })
        .collect()
}

/// exp(k ln p + ln Γ(N + 1) − ln Γ(N − k + 1) − ln k), over the largest.
fn log_gammas(big_n: usize, p: f64) -> Vec<f64> {
    let whole = pxfm::f_lgamma(big_n as f64 + 1.0);
    let log = |k: usize| {
        let x = k as f64;
        x * pxfm::f_log(p) + (whole - pxfm::f_lgamma((big_n - k) as f64 + 1.0)) - pxfm::f_log(x)
    };
    let logs: Vec<f64> = (1..=big_n).map(log).collect();
    let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    logs.into_iter().map(|log| pxfm::f_exp(log - top)).collect()
}

/// Ratios outwards from the largest term, until the terms are negligible; and the first k.
fn ratios(big_n: usize, p: f64) -> (usize, Vec<f64>) {
    let top = peak(big_n, p);
    let ratio = |k: usize| p * (big_n - k) as f64 * (k as f64 / (k as f64 + 1.0));
    let mut below = Vec::new();
    let mut term = 1.0;
    for k in (1..top).rev() {
        term /= ratio(k);
        below.push(term);
        if term < NEGLIGIBLE {
            break;
        }
    }
    let first = top - below.len();
    let mut weights: Vec<f64> = below.into_iter().rev().collect();
    term = 1.0;
    weights.push(term);
    for k in top..big_n {
        term *= ratio(k);
        weights.push(term);
        if term < NEGLIGIBLE {
            break;
        }
    }
    (first, weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Printed in forty digits by an independent program, at the doubles next to 0.12 and 0.2.
    #[test]
    fn the_reference_has_the_digits_of_an_independent_one() {
        for (sigma, p) in [(0.12, 8.870_171_600_978_68e-4), (0.2, 0.137_887_672_913_781_48)] {
            assert!((p_exact(sigma).to_f64() / p - 1.0).abs() < 1e-14, "{sigma}");
        }
        // And it is one minus an integral of positive terms.
        for sigma in [0.3, 1.0, 10.0] {
            let rest = ImpactProbability::of_paper(sigma).unwrap().complement();
            assert!((p_exact(sigma).to_f64() + rest - 1.0).abs() < 1e-15);
        }
    }
}
