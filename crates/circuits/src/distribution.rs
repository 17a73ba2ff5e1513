//! The number X of different impacts of a circuit drawn with weight p per edge (Sec. 6).
//!
//! Plain factorials leave the range of doubles at N = 171, and differences of log-gamma lose
//! digits as N grows. Here every weight is a running product of the factors p (N − k), carried
//! with 106 bits and a separate exponent, so N = 10^6 costs neither digits nor range.

use super::{Error, check_k, check_p, check_vertices, higher_order, jump};
use impact_numerics::double_double::DoubleDouble;
use impact_numerics::scaled::Scaled;

/// The circuits that are possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleSpace {
    /// Simple circuits only (Sec. 6).
    Simple,
    /// Simple circuits and the four classes of Sec. 9, counted as primitive circuits.
    FiveClasses,
    /// The same with the printed formulas of Sec. 9 taken at every length, although they fail for
    /// one and for two different vertices.
    FiveClassesPrinted,
}

/// The distribution of X for one sample space, N and p; p = 0 stands for the limit p → 0+.
#[derive(Clone, Copy, Debug)]
pub struct Law {
    space: SampleSpace,
    big_n: usize,
    p: f64,
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
            // What `higher_order::multiplicity` multiplies by, taken out once.
            _ => Scaled::from(big_n) / Scaled::from(higher_order::SHARED as usize),
        };
        Weights { space, big_n, p, k: 1, arranged }
    }

    /// Moves on to k + 1.
    pub(crate) fn advance(&mut self) {
        let left = self.big_n - self.k;
        self.arranged = self.arranged * (self.p * left as f64);
        self.k += 1;
    }

    /// k times the weight of k: a whole number of products, no division.
    pub(crate) fn moment(&self) -> Scaled {
        match self.space {
            SampleSpace::Simple => self.arranged,
            space => self.arranged * higher_order::multiplicity(space, self.p, self.k),
        }
    }

    /// Whether all later weights are known to fall: then the ratio of neighbours, which is p
    /// (N − k) times at most (k + 3)/(k − 1) (1 for simple circuits), is below 1 for good.
    pub(crate) fn falls_for_good(&self) -> bool {
        let k = self.k as f64;
        let ratio = self.p.hi * (self.big_n - self.k) as f64;
        match self.space {
            SampleSpace::Simple => ratio < 1.0,
            _ => self.k >= 3 && ratio * (k + 3.0) < 0.999_999 * (k - 1.0),
        }
    }
}

/// Sums over the distribution, and (except for simple circuits, see
/// [`Law::simple_k_star`]) its first maximum.
struct Sums {
    total: Scaled,
    first_moment: Scaled,
    largest: Scaled,
    largest_at: usize,
}

impl Law {
    /// # Errors
    /// [`Error`] for N outside 1..=[`super::LARGEST_N`] or p outside [0, 1].
    pub fn new(space: SampleSpace, big_n: usize, p: f64) -> Result<Self, Error> {
        check_vertices(big_n)?;
        check_p(p)?;
        Ok(Law { space, big_n, p })
    }

    /// The weights of k = 1..=N, in order.
    fn weights(&self) -> impl Iterator<Item = Weights> + use<> {
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
    /// The weight Φ_{N,p}(k), over p: p^(k−1) N!/(k (N − k)!) for simple circuits. The common
    /// factor p drops out of every probability, and without it the limit p → 0+ is the value at
    /// p = 0. Γ_{N,p}, over p as well, is the sum of all weights.
    pub fn weight(&self, k: usize) -> Result<Scaled, Error> {
        check_k(self.big_n, k)?;
        let weights = self.weights().nth(k - 1).expect("k ≤ N");
        Ok(weights.moment() / Scaled::from(k))
    }

    /// Sums all weights that can matter to the last bit of 106.
    fn sums(&self) -> Sums {
        let negligible = Scaled::from(1e-32) / Scaled::from(self.big_n);
        let mut sums = Sums {
            total: Scaled::ZERO,
            first_moment: Scaled::ZERO,
            largest: Scaled::ZERO,
            largest_at: 1,
        };
        for weights in self.weights() {
            let (k, moment) = (weights.k, weights.moment());
            let weight = moment / Scaled::from(k);
            sums.first_moment = sums.first_moment + moment;
            sums.total = sums.total + weight;
            if self.space != SampleSpace::Simple && weight > sums.largest {
                (sums.largest, sums.largest_at) = (weight, k);
            }
            if weights.falls_for_good() && weight < sums.total * negligible {
                break;
            }
        }
        sums
    }

    /// **Eq. (9)**
    ///
    /// P(X = k) = Φ_{N,p}(k)/Γ_{N,p}; 0 where it is below the smallest double.
    pub fn probability(&self, k: usize) -> Result<f64, Error> {
        Ok((self.weight(k)? / self.sums().total).to_f64())
    }

    /// P(X = k) for k = 1..=N.
    pub fn probabilities(&self) -> Vec<f64> {
        let total = self.sums().total;
        self.all_weights().map(|weight| (weight / total).to_f64()).collect()
    }

    /// The weights of k = 1..=N, over p, in order.
    pub fn all_weights(&self) -> impl Iterator<Item = Scaled> {
        self.weights().map(|weights| weights.moment() / Scaled::from(weights.k))
    }

    /// The part of one of the five classes in P(X = k), k = 1..=N: the classes add up to
    /// [`Law::probabilities`]. For a sample space of five classes.
    pub fn contribution(&self, class: &higher_order::Class) -> Vec<f64> {
        let total = self.sums().total;
        let extra = (0..class.excess()).fold(Scaled::ONE, |w, _| w * self.p);
        let share = |weights: Weights| {
            let circuits = DoubleDouble::from(class.per_simple_circuit(self.space, weights.k));
            (weights.arranged * circuits * extra / (Scaled::from(weights.k) * total)).to_f64()
        };
        self.weights().map(share).collect()
    }

    /// k*, the most likely number of different impacts; the lowest of several.
    pub fn k_star(&self) -> usize {
        match self.space {
            SampleSpace::Simple => self.simple_k_star(),
            _ => self.sums().largest_at,
        }
    }

    /// k* of simple circuits: either 1 or the one local maximum, found from exact signs of f.
    fn simple_k_star(&self) -> usize {
        let top = jump::local_maximum(self.big_n, self.p);
        if top == 1 || jump::rises(self.big_n, self.p, 1) {
            return top;
        }
        let first = Scaled::from(self.big_n) * Scaled::from(top);
        let exceeds = self.weights().nth(top - 1).is_some_and(|own| own.moment() > first);
        if exceeds { top } else { 1 }
    }

    /// μ, the expected number of different impacts.
    pub fn mean(&self) -> f64 {
        let sums = self.sums();
        (sums.first_moment / sums.total).to_f64()
    }
}
