//! Errors by the jackknife: each realisation is left out in turn.

use crate::numerics::statistics::{Estimate, normal_quantile, standard_error};
use crate::params::LEVEL;

/// A statistic of so many realisations, given the one that is left out; none with fewer than two for
/// which it exists.
pub fn jackknife(
    realisations: usize,
    statistic: impl Fn(Option<usize>) -> Option<f64>,
) -> Option<Estimate> {
    let value = statistic(None)?;
    let without: Vec<f64> = (0..realisations).filter_map(|out| statistic(Some(out))).collect();
    let error = standard_error(&without)? * (without.len() as f64 - 1.0);
    let half = normal_quantile(LEVEL) * error;
    Some(Estimate { value, error, interval: [value - half, value + half] })
}

/// The sums of both members of all pairs but one.
pub fn sums(pairs: &[[f64; 2]], out: Option<usize>) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (_, pair) in pairs.iter().enumerate().filter(|(at, _)| Some(*at) != out) {
        sums[0] += pair[0];
        sums[1] += pair[1];
    }
    sums
}

/// The ratio of two sums over realisations.
pub fn ratio(pairs: &[[f64; 2]]) -> Option<Estimate> {
    jackknife(pairs.len(), |out| {
        let [above, below] = sums(pairs, out);
        (below > 0.0).then(|| above / below)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_mean_it_is_the_standard_error() {
        let sample = [1.0, 2.0, 4.0, 9.0];
        let found = ratio(&sample.map(|x| [x, 1.0])).unwrap();
        assert_eq!(found.value, 4.0);
        assert!((found.error - standard_error(&sample).unwrap()).abs() < 1e-14);
        assert_eq!(ratio(&[[1.0, 2.0]]), None);
        assert_eq!(ratio(&[[1.0, 0.0], [2.0, 0.0]]), None);
        let same = ratio(&[[1.0, 2.0], [2.0, 4.0], [3.0, 6.0]]).unwrap();
        assert_eq!((same.value, same.error), (0.5, 0.0));
    }
}
