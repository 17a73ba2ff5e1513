//! Fits laws to the distance of the branches against T: a power of T and one of ln T, each without
//! and with a limit.
//!
//! A distance has the weight 1/error². Errors are by leaving out whole chains, those of what is
//! fitted too, with the weights kept, since distances at different T are of the same chains.

use super::pairs::{Pair, distance};
use crate::experiments::prelude::*;
use impact_numerics::decay::Decay;

/// The law c + a u^(−b) with u = T/T₁, or ln T/ln T₁, where T₁ is the first transient.
#[derive(Clone, Copy)]
pub(super) struct Law {
    pub name: &'static str,
    /// Whether the limit c is fitted too; otherwise it is 0.
    pub limited: bool,
    /// Returns ln u but for a constant.
    scale: fn(f64) -> f64,
}

const LOG_LOG: fn(f64) -> f64 = |time| pxfm::f_log(pxfm::f_log(time));

pub(super) const LAWS: [Law; 4] = [
    Law { name: "power", limited: false, scale: pxfm::f_log },
    Law { name: "limit", limited: true, scale: pxfm::f_log },
    Law { name: "logarithm", limited: false, scale: LOG_LOG },
    Law { name: "logarithm_limit", limited: true, scale: LOG_LOG },
];

impl Law {
    /// Estimates a number of the fit to the distances of one length, or returns `None` if a
    /// distance has no error.
    pub fn estimate(self, pairs: &[Pair], number: fn(&Decay) -> f64) -> Option<Estimate> {
        let weight = |pair: &Pair| pair.estimate(&distance).map(|d| 1.0 / (d.error * d.error));
        let weights = pairs.iter().map(weight).collect::<Option<Vec<f64>>>()?;
        pairs[0].estimate(&|first, without| {
            let log = |pair: &Pair| (self.scale)(pair.transient) - (self.scale)(first.transient);
            let point = |(pair, weight)| Some([log(pair), distance(pair, without)?, weight]);
            let points = pairs.iter().zip(weights.iter().copied()).map(point);
            let fit = Decay::fit(&points.collect::<Option<Vec<_>>>()?, self.limited)?;
            Some(number(&fit)).filter(|number| number.is_finite())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::pairs::tests::pair;
    use super::*;

    /// Chains differ in the amplitude, or in the limit if there is one.
    #[test]
    fn known_laws_are_found_with_the_error_of_what_differs_between_chains() {
        let own = [0.07, 0.12, 0.08, 0.15, 0.1];
        let (mean, error) = (0.104, standard_error(&own).unwrap());
        for law in LAWS {
            let pair_after = |time: f64| {
                let u: f64 = if law.name.starts_with("logarithm") {
                    pxfm::f_log(time) / pxfm::f_log(4.0)
                } else {
                    time / 4.0
                };
                let [limit, factor] = [[0.0, 1.0], [1.0, 0.0]][usize::from(law.limited)];
                let y = |own: f64| limit * own + (limit * 0.2 + factor * own) / u.sqrt();
                pair(time, &own.map(|own| 0.3 + y(own)), &[0.3; 5])
            };
            let pairs = [4.0, 16.0, 64.0, 256.0].map(pair_after);
            let near = |number: fn(&Decay) -> f64, value: f64, error: f64| {
                let fitted = law.estimate(&pairs, number).unwrap();
                let off = (fitted.value - value).abs().max((fitted.error - error).abs());
                assert!(off < 1e-6, "{}: {fitted:?}", law.name);
            };
            near(|fit| fit.exponent, 0.5, 0.0);
            let known = if law.limited { [0.2, 0.0, mean, error] } else { [mean, error, 0.0, 0.0] };
            near(|fit| fit.amplitude, known[0], known[1]);
            near(|fit| fit.limit, known[2], known[3]);
            assert!(law.estimate(&pairs[..1], |fit| fit.limit).is_none());
        }
    }

    #[test]
    fn a_distance_off_by_its_error_adds_one_to_the_misfit() {
        // The first two times, with next to no error, fix a power; the third lies above it.
        let own = |half: f64| [0.1 - half, 0.1 + half];
        let pair_at =
            |time, place: f64, half| pair(time, &own(half).map(|own| place + own), &[0.1; 2]);
        let pairs = [pair_at(1.0, 0.4, 1e-6), pair_at(4.0, 0.2, 1e-6), pair_at(16.0, 0.13, 0.03)];
        let misfit = LAWS[0].estimate(&pairs, |fit| fit.misfit).unwrap().value;
        assert!((misfit - 1.0).abs() < 1e-3, "{misfit}");
    }
}
