//! Computes the distribution of X, the number of impacts of a circuit (Sec. 6).
//!
//! Plain factorials leave the range of doubles at N = 171, and differences of log-gamma lose
//! digits as N grows. Here every weight is a running product of the factors p (N − k), carried
//! with 106 bits and a separate exponent, so N = 10^6 costs neither digits nor range.

use crate::higher_order;
pub use crate::higher_order::SampleSpace;
use impact_chain::{Error, check_range};
use impact_numerics::double_double::DoubleDouble;
use impact_numerics::scaled::Scaled;

/// The largest N for which a quantity is computed: it takes some seconds, at most ∝ N.
pub const LARGEST_N: usize = 10_000_000;

pub(crate) fn check_vertices(big_n: usize) -> Result<(), Error> {
    check_range("vertices", big_n, 1, LARGEST_N)
}

/// The distribution of X for one sample space, N and p; p = 0 stands for the limit p → 0+.
#[derive(Clone, Copy, Debug)]
pub struct Law {
    pub(crate) space: SampleSpace,
    pub(crate) big_n: usize,
    pub(crate) p: f64,
}

/// The weight of k, from which that of k + 1 follows.
#[derive(Clone, Copy)]
pub(crate) struct Weights {
    space: SampleSpace,
    big_n: usize,
    p: DoubleDouble,
    k: usize,
    /// p^(k−1) N!/(N − k)!, over the common denominator of the classes.
    arranged: Scaled,
}

impl Weights {
    pub(crate) fn new(space: SampleSpace, big_n: usize, p: DoubleDouble) -> Self {
        let arranged = match space {
            SampleSpace::Simple => Scaled::from(big_n),
            // The factor of `higher_order::multiplicity`, divided out once.
            _ => Scaled::from(big_n) / Scaled::from(higher_order::SHARED as usize),
        };
        Weights { space, big_n, p, k: 1, arranged }
    }

    pub(crate) fn advance(&mut self) {
        let left = self.big_n - self.k;
        self.arranged = self.arranged * (self.p * left as f64);
        self.k += 1;
    }

    /// Returns k times the weight of k: only products, no division.
    pub(crate) fn moment(&self) -> Scaled {
        match self.space {
            SampleSpace::Simple => self.arranged,
            space => self.arranged * higher_order::multiplicity(space, self.p, self.k),
        }
    }

    /// Returns whether the ratio of neighbours, ≤ p (N − k) (k + 3)/(k − 1), stays below 1.
    pub(crate) fn falls_from_here(&self) -> bool {
        let k = self.k as f64;
        let ratio = self.p.hi * (self.big_n - self.k) as f64;
        match self.space {
            SampleSpace::Simple => ratio < 1.0,
            _ => self.k >= 3 && ratio * (k + 3.0) < 0.999_999 * (k - 1.0),
        }
    }
}

/// Sums over the distribution, and (except for simple circuits) its first maximum.
pub(crate) struct Sums {
    total: Scaled,
    first_moment: Scaled,
    largest: Scaled,
    pub(crate) largest_at: usize,
}

impl Law {
    /// Creates the law of N vertices with edge probability p, from 0 to 1.
    pub fn new(space: SampleSpace, big_n: usize, p: f64) -> Result<Self, Error> {
        check_vertices(big_n)?;
        check_range("p", p, 0.0, 1.0)?;
        Ok(Law { space, big_n, p })
    }

    pub(crate) fn weights(&self) -> impl Iterator<Item = Weights> + use<> {
        let mut next = Weights::new(self.space, self.big_n, DoubleDouble::from(self.p));
        (1..=self.big_n).map(move |k| {
            while next.k < k {
                next.advance();
            }
            next
        })
    }

    /// **Eq. (10)**
    ///
    /// Returns the weight Φ_{N,p}(k), over p: p^(k−1) N!/(k (N − k)!) for simple circuits. The
    /// common factor p drops out of every probability, and without it the limit p → 0+ is the
    /// value at p = 0. Γ_{N,p}, over p as well, is the sum of all weights.
    pub fn weight(&self, k: usize) -> Result<Scaled, Error> {
        check_range("k", k, 1, self.big_n)?;
        Ok(self.all_weights().nth(k - 1).expect("k ≤ N"))
    }

    /// Sums all weights that can matter to the last bit of 106.
    pub(crate) fn sums(&self) -> Sums {
        let negligible = Scaled::from(1e-32) / Scaled::from(self.big_n);
        let [total, first_moment, largest] = [Scaled::ZERO; 3];
        let mut sums = Sums { total, first_moment, largest, largest_at: 1 };
        for weights in self.weights() {
            let (k, moment) = (weights.k, weights.moment());
            let weight = moment / Scaled::from(k);
            sums.first_moment = sums.first_moment + moment;
            sums.total = sums.total + weight;
            if self.space != SampleSpace::Simple && weight > sums.largest {
                (sums.largest, sums.largest_at) = (weight, k);
            }
            if weights.falls_from_here() && weight < sums.total * negligible {
                break;
            }
        }
        sums
    }

    /// **Eq. (9)**
    ///
    /// Returns P(X = k) = Φ_{N,p}(k)/Γ_{N,p}; 0 where it is below the smallest double.
    pub fn probability(&self, k: usize) -> Result<f64, Error> {
        Ok((self.weight(k)? / self.sums().total).to_f64())
    }

    /// Returns P(X = k) for k = 1..=N.
    pub fn probabilities(&self) -> Vec<f64> {
        let total = self.sums().total;
        self.all_weights().map(|weight| (weight / total).to_f64()).collect()
    }

    /// Lists the weights of k = 1..=N, over p, in order.
    pub fn all_weights(&self) -> impl Iterator<Item = Scaled> {
        self.weights().map(|weights| weights.moment() / Scaled::from(weights.k))
    }

    /// Returns the share of one class of circuits in P(X = k), for k = 1..=N; the sample space must
    /// have the five classes.
    pub fn contribution(&self, class: &higher_order::Class) -> Vec<f64> {
        let total = self.sums().total;
        let extra = (0..class.excess()).fold(Scaled::ONE, |w, _| w * self.p);
        let share = |weights: Weights| {
            let circuits = DoubleDouble::from(class.per_simple_circuit(self.space, weights.k));
            (weights.arranged * circuits * extra / (Scaled::from(weights.k) * total)).to_f64()
        };
        self.weights().map(share).collect()
    }

    /// Returns μ, the expected number of different impacts.
    pub fn mean(&self) -> f64 {
        let sums = self.sums();
        (sums.first_moment / sums.total).to_f64()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// N = 10 and p = 1/4: (10 − k)/4 is 1 at k = 6, and the bound with (k + 3)/(k − 1) is 5/4 at
    /// k = 7 and 11/14 at k = 8.
    #[test]
    fn weights_fall_from_where_their_ratio_is_below_one() {
        for (space, first) in [(SampleSpace::Simple, 7), (SampleSpace::FiveClasses, 8)] {
            let law = Law::new(space, 10, 0.25).unwrap();
            let falls: Vec<bool> = law.weights().map(|weights| weights.falls_from_here()).collect();
            assert_eq!(falls.iter().position(|&falls| falls), Some(first - 1), "{falls:?}");
        }
    }
}
