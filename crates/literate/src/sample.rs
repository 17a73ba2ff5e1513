//! Estimates that know their sample: how many values they are from decides how far chance may move
//! them.

use impact_numerics::estimates::{self, LEVEL, with_error};
use impact_numerics::statistics::{Estimate, wilson};
use serde::{Deserialize, Serialize};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sample {
    /// Not known, or large: the error is that of a normal distribution.
    #[default]
    Unknown,
    /// So many values, of which it is the mean or the like.
    Values(u64),
    /// So many trials, of which it is a share.
    Trials(u64),
}

impl Sample {
    pub(crate) fn is_unknown(&self) -> bool {
        *self == Sample::Unknown
    }
}

/// An estimate that knows how many values it is from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// The estimate.
    pub estimate: Estimate,
    pub(crate) sample: Sample,
}

impl From<Estimate> for Sampled {
    fn from(estimate: Estimate) -> Sampled {
        Sampled { estimate, sample: Sample::Unknown }
    }
}

fn with_values(values: usize, estimate: Estimate) -> Sampled {
    Sampled { estimate, sample: Sample::Values(values as u64) }
}

/// Returns the mean of a sample, or `None` if it has fewer than two values. Equal ones have the
/// error zero, by which no check judges: use [`share`], or a number without an error.
pub fn average(values: &[f64]) -> Option<Sampled> {
    let mean = estimates::average(values)?;
    // Equal values have no error, also none by rounding.
    let are_equal = values.iter().all(|value| value == &values[0]);
    Some(with_values(values.len(), if are_equal { with_error(values[0], 0.0) } else { mean }))
}

/// Returns the share `part`/`whole` with its binomial error, or Wilson's of 0 and 1, and Wilson's
/// interval, or `None` if `whole` is 0. Checks use the exact interval.
pub fn share(part: u64, whole: u64) -> Option<Sampled> {
    let binomial = estimates::share(part, whole)?;
    let error = if binomial.error > 0.0 { binomial.error } else { 1.0 / (whole as f64 + 1.0) };
    let estimate = Estimate { error, interval: wilson(part, whole, LEVEL)?, ..binomial };
    Some(Sampled { estimate, sample: Sample::Trials(whole) })
}

/// Returns the difference a − b of estimates from independent samples, of which the smaller counts.
pub fn difference(a: impl Into<Sampled>, b: impl Into<Sampled>) -> Sampled {
    let (a, b) = (a.into(), b.into());
    let sample = match (a.sample, b.sample) {
        (Sample::Values(a), Sample::Values(b)) => Sample::Values(a.min(b)),
        _ => Sample::Unknown,
    };
    Sampled { estimate: estimates::difference(a.estimate, b.estimate), sample }
}

/// Returns a statistic with its jackknife error; `statistic` gets the realisation to leave out.
pub fn jackknife(
    realisations: usize,
    statistic: impl Fn(Option<usize>) -> Option<f64>,
) -> Option<Sampled> {
    estimates::jackknife(realisations, statistic).map(|mean| with_values(realisations, mean))
}

/// Returns the ratio of two sums over realisations, with its jackknife error.
pub fn ratio(pairs: &[[f64; 2]]) -> Option<Sampled> {
    estimates::ratio(pairs).map(|estimate| with_values(pairs.len(), estimate))
}
