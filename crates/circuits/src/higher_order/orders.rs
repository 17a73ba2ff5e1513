//! All circuits with K different vertices, by how many edges more than K they have (ours, beyond the
//! paper): whole orders of Sec. 9 in place of single classes.
//!
//! Words of length L over K letters that use all of them number K! S(L, K), with Stirling's numbers of
//! the second kind, and a circuit is a primitive word read as a cycle. With e = L − K edges more, the
//! circuits over the simple ones are K S(K + e, K)/(K + e), but for words that are periodic. The sum over all
//! e with weights p^e converges for p K < 1 and for no other p.

use super::classes::moebius;
use crate::distribution::{Law, SampleSpace};
use crate::{Error, check_vertices, jump};
use impact_numerics::bisection;
use pxfm::f_log1p;

/// Stirling's numbers S(K + e, K) for K = 1..=N and e up to a largest one, over K^e.
#[derive(Clone, Debug)]
pub struct Orders {
    big_n: usize,
    /// S(K + e, K)/K^e at index K − 1, then e: rises with e from 1 to K^K/K!.
    stirling: Vec<Vec<f64>>,
}

/// Largest N: a table for more would fill the memory.
pub const LARGEST_N: usize = 150;

/// Draws per letter after which all letters have come, but for a chance of K e^−45.
const DRAWS: usize = 45;

impl Orders {
    /// A table that is long enough for all orders, see [`Orders::all`], and for `most`.
    ///
    /// # Errors
    /// [`Error::Input`] for N outside 1..=[`LARGEST_N`].
    pub fn new(big_n: usize, most: usize) -> Result<Self, Error> {
        check_vertices(big_n)?;
        if big_n > LARGEST_N {
            let problem = format!("{big_n} vertices are too many for circuits of all orders");
            return Err(Error::input("vertices", problem, format!("give N ≤ {LARGEST_N}")));
        }
        let length = most.max(DRAWS * big_n) + 1;
        let mut stirling = vec![vec![1.0; length]];
        for k in 2..=big_n {
            // S(n, K) = K S(n − 1, K) + S(n − 1, K − 1), each over its power.
            let fewer: &Vec<f64> = &stirling[k - 2];
            let ratio = (k - 1) as f64 / k as f64;
            let (mut own, mut power) = (vec![1.0], 1.0);
            for (e, fewer) in fewer.iter().enumerate().skip(1) {
                power *= ratio;
                own.push(own[e - 1] + fewer * power);
            }
            stirling.push(own);
        }
        Ok(Orders { big_n, stirling })
    }

    /// Circuits with `k` different vertices and at most `most` edges more, with weight p for each of these,
    /// over the simple ones.
    pub fn up_to(&self, most: usize, k: usize, p: f64) -> f64 {
        self.primitive(k, p, Some(most))
    }

    /// The same over all orders; nothing for p ≥ 1/k, where the sum diverges.
    pub fn all(&self, k: usize, p: f64) -> Option<f64> {
        // One vertex has a single primitive circuit, its loop.
        (k == 1 || p * (k as f64) < 1.0).then(|| self.primitive(k, p, None))
    }

    /// Möbius inversion: a word that is another one d times over has d times its length.
    fn primitive(&self, k: usize, p: f64, most: Option<usize>) -> f64 {
        if k == 1 {
            return 1.0;
        }
        let (mut sum, mut power, mut repeats) = (0.0, p, 1.0);
        for d in 1.. {
            // L = d m and m ≥ K, so that m has (K + e)/d − K letters more than K.
            let longest = most.map(|e| ((e + k) / d).checked_sub(k));
            if repeats < 1e-20 || longest == Some(None) {
                break;
            }
            let sequences = self.sequences(k, power, longest.flatten());
            sum += f64::from(moebius(d)) / d as f64 * repeats * sequences;
            power *= p;
            repeats *= (0..k).fold(1.0, |w, _| w * p);
        }
        sum
    }

    /// Σ_e K/(K + e) S(K + e, K) p^e: cyclic sequences counted as sequences over length.
    fn sequences(&self, k: usize, p: f64, most: Option<usize>) -> f64 {
        let (real, table) = (k as f64, &self.stirling[k - 1]);
        let end = most.unwrap_or(usize::MAX).min(table.len() - 1);
        let (ratio, mut power, mut sum) = (p * real, 1.0, 0.0);
        for (e, stirling) in table.iter().take(end + 1).enumerate() {
            let term = real / (real + e as f64) * stirling * power;
            sum += term;
            power *= ratio;
            // S(K + e, K) is logarithmically concave in e (a complete symmetric polynomial), so that
            // from here on all ratios of terms are smaller than this one.
            let fall = ratio * stirling / table[e.saturating_sub(1)];
            if most.is_none() && e > 0 && fall < 1.0 && term * fall < 1e-18 * (1.0 - fall) * sum {
                return sum;
            }
        }
        if most.is_some() { sum } else { sum + self.rest(k, ratio) }
    }

    /// What follows after the table, where all words use all letters: Σ_{L > end} (p K)^L/L in units
    /// of a simple circuit, the logarithm less its first terms.
    fn rest(&self, k: usize, ratio: f64) -> f64 {
        let table = &self.stirling[k - 1];
        let (mut power, mut logarithm, mut start) = (1.0, -f_log1p(-ratio), 1.0);
        for length in 1..k + table.len() {
            power *= ratio;
            logarithm -= power / length as f64;
            if length == k {
                start = power;
            }
        }
        table[table.len() - 1] * k as f64 * logarithm.max(0.0) / start
    }

    /// Weights over p of k = 1..=N: Eq. (10) with circuits of all orders up to `most`, or of all
    /// orders at all (nothing for p ≥ 1/N).
    ///
    /// # Errors
    /// [`Error::Input`] for p outside [0, 1].
    pub fn weights(&self, p: f64, most: Option<usize>) -> Result<Option<Vec<f64>>, Error> {
        let simple = Law::new(SampleSpace::Simple, self.big_n, p)?;
        let factor = |k: usize| match most {
            Some(most) => Some(self.up_to(most, k, p)),
            None => self.all(k, p),
        };
        let weights = simple.all_weights().zip(1..);
        Ok(weights.map(|(weight, k)| Some(weight.to_f64() * factor(k)?)).collect())
    }

    /// Where k* leaves 1 with all orders up to `most`, or with all: p, and k* just after.
    ///
    /// # Errors
    /// [`Error::NoJump`] for N ≤ 3.
    pub fn jump(&self, most: Option<usize>) -> Result<(f64, usize), Error> {
        let peak = |p: f64| {
            let weights = self.weights(p, most).ok().flatten()?;
            let after =
                (2..=self.big_n).max_by(|a, b| weights[a - 1].total_cmp(&weights[b - 1]))?;
            Some((weights[after - 1] > weights[0], after))
        };
        // More circuits only add weight beyond k = 1, so that simple circuits jump last. All orders
        // together: beyond the pole nothing is left to compare.
        let last = 1.01 * jump::p_jump(SampleSpace::Simple, self.big_n)?.p;
        let highest = if most.is_some() { last } else { 1.0 / self.big_n as f64 };
        let [_, p] = bisection::bracket(0.0, highest, |p| peak(p).is_none_or(|(jumped, _)| jumped));
        match peak(p) {
            Some((true, after)) => Ok((p, after)),
            _ => Err(Error::NoJump { vertices: self.big_n, least: 4 }),
        }
    }
}

/// The sum of the weights p^L of all primitive circuits on N vertices, Σ_d μ(d)/d ln 1/(1 − N p^d); nothing
/// for N p ≥ 1, where it diverges. It is the logarithm, Möbius inverted, of the product
/// ∏ 1/(1 − p^L) over all these circuits, which is 1/(1 − N p).
pub fn total_of_all(big_n: usize, p: f64) -> Option<f64> {
    let big_n = big_n as f64;
    if big_n * p >= 1.0 {
        return None;
    }
    let (mut sum, mut power) = (0.0, p);
    for d in 1.. {
        if power * big_n < 1e-20 * sum || power == 0.0 {
            break;
        }
        sum -= f64::from(moebius(d)) / d as f64 * f_log1p(-big_n * power);
        power *= p;
    }
    Some(sum)
}

/// The smallest number of different vertices whose circuits have no finite weight at p: ⌈1/p⌉.
pub fn diverges_from(p: f64) -> usize {
    let from = (1.0 / p) as usize;
    // p K < 1 decides, as the sum does.
    (from.saturating_sub(1).max(1)..).find(|k| p * *k as f64 >= 1.0).unwrap_or(usize::MAX)
}

/// How many primitive circuits of a length N vertices have: Σ_{d|L} μ(d) N^{L/d}/L. Nothing beyond
/// 128 bits.
pub fn primitive_of_length(big_n: usize, length: usize) -> Option<u128> {
    let mut balance = 0_i128;
    for d in (1..=length).filter(|d| length.is_multiple_of(*d)) {
        let power = i128::try_from(big_n).ok()?.checked_pow(u32::try_from(length / d).ok()?)?;
        balance = balance.checked_add(i128::from(moebius(d)) * power)?;
    }
    u128::try_from(balance).ok().map(|words| words / length as u128)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Graph;
    use crate::higher_order::{Class, SHARED, multiplicity};
    use impact_numerics::double_double::DoubleDouble;

    /// All primitive circuits of small graphs, listed: by length and number of different vertices.
    fn listed(big_n: usize, longest: usize) -> Vec<Vec<u128>> {
        let mut counts = vec![vec![0; big_n + 1]; longest + 1];
        for circuit in Graph::of_chain(big_n - 1).circuits(longest) {
            counts[circuit.length()][circuit.different_vertices()] += 1;
        }
        counts
    }

    #[test]
    fn necklaces_by_moebius_are_those_that_are_listed() {
        for (big_n, longest) in [(1, 8), (2, 12), (3, 8), (4, 7)] {
            for (length, counts) in listed(big_n, longest).iter().enumerate().skip(1) {
                let found = counts.iter().sum();
                assert_eq!(primitive_of_length(big_n, length), Some(found), "{big_n} {length}");
            }
        }
        assert_eq!(primitive_of_length(100, 64), None);
    }

    /// ∏ (1 − z^L)^{−1} over all circuits, as a series to z^8: its coefficients are N^L.
    #[test]
    fn the_euler_product_is_geometric() {
        for big_n in 1..=4 {
            let mut series = [0_u128; 9];
            series[0] = 1;
            for circuit in Graph::of_chain(big_n - 1).circuits(8) {
                let length = circuit.length();
                for power in length..=8 {
                    series[power] += series[power - length];
                }
            }
            for (length, coefficient) in (0_u32..).zip(series) {
                assert_eq!(coefficient, (big_n as u128).pow(length), "{big_n} {length}");
            }
        }
    }

    #[test]
    fn orders_are_those_that_are_listed() {
        let p = 0.3;
        let power = |e: usize| (0..e).fold(1.0, |w, _| w * p);
        for (big_n, longest) in [(2, 12), (3, 9), (4, 8)] {
            let counts = listed(big_n, longest);
            let orders = Orders::new(big_n, 12).unwrap();
            for k in 1..=big_n {
                let mut sum = 0.0;
                for most in 0..=longest - k {
                    sum += counts[k + most][k] as f64 * power(most) / counts[k][k] as f64;
                    let found = orders.up_to(most, k, p);
                    assert!((found / sum - 1.0).abs() < 1e-14, "{big_n} {k} {most}: {found} {sum}");
                }
            }
        }
    }

    /// Order 3 by its classes, of which the paper has one: ways to visit vertices so often.
    #[test]
    fn five_classes_are_the_first_orders_and_a_part_of_the_next() {
        let (big_n, p) = (12, 0.02);
        let orders = Orders::new(big_n, 3).unwrap();
        for k in 1..=big_n {
            let five = multiplicity(SampleSpace::FiveClasses, DoubleDouble::from(p), k).to_f64();
            let five = five / SHARED as f64;
            let count = |repeats: &[usize]| {
                let class = Class::new(repeats);
                let simple = Class::new(&[]).primitive(big_n, k).unwrap() as f64;
                class.primitive(big_n, k + 3).unwrap() as f64 / simple
            };
            let (four, others) = (count(&[0, 0, 1]), count(&[1, 1]) + count(&[3]));
            let cubed = p * p * p;
            let up_to_two = five - cubed * four;
            assert!((orders.up_to(2, k, p) / up_to_two - 1.0).abs() < 1e-14, "k = {k}");
            assert!((orders.up_to(3, k, p) / (five + cubed * others) - 1.0).abs() < 1e-14);
            if k > 3 {
                let share = four / (four + others) * (k * (k + 1)) as f64;
                assert!((share - 2.0).abs() < 1e-12, "k = {k}: {share}");
            }
        }
    }

    /// Second route for all orders: the sum over k is that of the product over circuits, and the
    /// share of each k for L draws from N letters follows from draw to draw.
    #[test]
    fn all_orders_add_up_to_the_product() {
        for (big_n, share) in
            [(1, 0.5), (4, 0.9), (30, 0.5), (30, 0.999), (100, 0.99), (100, 0.999_999)]
        {
            let p = share / big_n as f64;
            let orders = Orders::new(big_n, 0).unwrap();
            let weights = orders.weights(p, None).unwrap().unwrap();
            let total = total_of_all(big_n, p).unwrap();
            let sum: f64 = weights.iter().map(|weight| weight * p).sum();
            assert!((sum / total - 1.0).abs() < 1e-12, "N = {big_n} {share}: {sum} {total}");
        }
        let (big_n, p) = (30, 0.97 / 30.0);
        let orders = Orders::new(big_n, 0).unwrap();
        let weights = orders.weights(p, None).unwrap().unwrap();
        let (mut seen, mut power) = (vec![0.0; big_n + 1], 1.0);
        let mut sums = vec![0.0; big_n + 1];
        seen[0] = 1.0;
        for length in 1..5000 {
            power *= p * big_n as f64;
            for k in (1..=big_n).rev() {
                let new = (big_n + 1 - k) as f64 * seen[k - 1];
                seen[k] = (k as f64 * seen[k] + new) / big_n as f64;
                sums[k] += seen[k] * power / length as f64;
            }
            seen[0] = 0.0;
        }
        // From three different vertices on, periodic words weigh p³ or less.
        for k in 3..=big_n {
            assert!((weights[k - 1] * p / sums[k] - 1.0).abs() < 2.0 * p * p * p, "k = {k}");
        }
    }

    #[test]
    fn sums_diverge_at_their_poles() {
        let orders = Orders::new(10, 0).unwrap();
        for k in 2..=10 {
            let pole = 1.0 / k as f64;
            assert!(orders.all(k, pole).is_none());
            let [far, near] = [1e-4, 1e-8].map(|d| orders.all(k, pole * (1.0 - d)).unwrap());
            // Like K K^K/K! ln 1/(1 − p K): four decades nearer, four times ln 10 more.
            let unit = (1..=k).fold(k as f64, |w, i| w * k as f64 / i as f64);
            assert!(((near - far) / unit / (1e4_f64).ln() - 1.0).abs() < 2e-3, "k = {k}");
            assert_eq!(diverges_from(pole), k);
        }
        assert_eq!([1.0, 0.3, 0.0131].map(diverges_from), [1, 4, 77]);
        assert!(total_of_all(10, 0.1).is_none() && Orders::new(151, 0).is_err());
        assert_eq!(orders.weights(0.1, None), Ok(None));
    }

    #[test]
    fn the_jump_comes_earlier_with_each_order_and_before_the_pole_with_all() {
        let big_n = 30;
        let orders = Orders::new(big_n, 500).unwrap();
        let simple = jump::p_jump(SampleSpace::Simple, big_n).unwrap();
        let (p, k) = orders.jump(Some(0)).unwrap();
        assert!((p / simple.p - 1.0).abs() < 1e-14 && k == simple.k_after);
        let mut last = p;
        for most in [1, 2, 5, 20, 100, 500] {
            let (p, _) = orders.jump(Some(most)).unwrap();
            assert!(p < last, "{most}");
            last = p;
        }
        let (p, k) = orders.jump(None).unwrap();
        assert!(p < 1.0 / big_n as f64 && p < last && k == big_n, "{p} {k}");
        assert!(Orders::new(3, 0).unwrap().jump(None).is_err());
    }
}
