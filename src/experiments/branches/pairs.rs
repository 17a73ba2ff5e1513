//! Compares half heights and shares on both branches chain by chain.
//!
//! Chains are independent of each other, and nothing else is: the same chain at another σ, after
//! another transient or on the other branch has the same forces. So every error is by leaving out
//! whole chains in turn (the jackknife), and a difference is taken before its error is.

use crate::experiments::prelude::*;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chains {
    pub ensemble: Ensemble,
    /// For each σ and each window, the active gaps of each chain, or `None` if its run was not
    /// complete.
    pub counts: Vec<Vec<Vec<Option<u32>>>>,
}

/// Shares of active gaps on one branch after one transient.
#[derive(Clone, Debug, Default)]
pub(super) struct Branch {
    /// The σ that were run so long, rising.
    pub sigmas: Vec<f64>,
    /// For each of them the share in each chain, or `None` if its run was not complete.
    shares: Vec<Vec<Option<f64>>>,
}

impl Branch {
    /// Collects the shares of chains of one length, with or without heating.
    fn new(chains: &[Chains], masses: usize, heated: bool, transient: f64) -> Branch {
        let mut rows = Vec::new();
        for Chains { ensemble, counts } in chains {
            if ensemble.chain.masses != masses || ensemble.heating.is_some() != heated {
                continue;
            }
            let mut windows = ensemble.protocols.iter();
            let Some(window) = windows.position(|one| one.transient == transient) else { continue };
            let gaps = ensemble.chain.gaps() as f64;
            for (sigma, counts) in ensemble.sigmas.iter().zip(counts) {
                let share = |count: &Option<u32>| count.map(|count| f64::from(count) / gaps);
                rows.push((*sigma, counts[window].iter().map(share).collect()));
            }
        }
        rows.sort_by(|a: &(f64, Vec<_>), b| a.0.total_cmp(&b.0));
        let (sigmas, shares) = rows.into_iter().unzip();
        Branch { sigmas, shares }
    }

    fn chains(&self) -> usize {
        self.shares.iter().map(Vec::len).min().unwrap_or(0)
    }

    /// Returns the mean share at a σ over all chains but one, or `None` where no chain was run.
    pub fn share(&self, sigma: f64, without: Option<usize>) -> Option<f64> {
        let place = self.sigmas.iter().position(|other| *other == sigma)?;
        let chains = self.shares[place].iter().enumerate();
        let others = chains.filter(|(chain, _)| Some(*chain) != without);
        mean(&others.filter_map(|(_, share)| *share).collect::<Vec<_>>())
    }

    /// Returns the half height of the mean over all chains but one, or `None` if it is not passed.
    pub fn half_height(&self, without: Option<usize>) -> Option<f64> {
        let shares = self.sigmas.iter().map(|sigma| self.share(*sigma, without));
        last_rise(&self.sigmas, &shares.collect::<Vec<_>>(), 0.5)
    }

    /// Returns the σ next to the half height of all chains, below and above.
    pub fn neighbours(&self) -> Option<[f64; 2]> {
        let half = self.half_height(None)?;
        let place = self.sigmas.iter().rposition(|sigma| *sigma < half)?;
        Some([self.sigmas[place], *self.sigmas.get(place + 1)?])
    }

    /// Returns by how much the half height changes without the σ nearest to it.
    pub fn coarser(&self, without: Option<usize>) -> Option<f64> {
        let ([low, high], half) = (self.neighbours()?, self.half_height(None)?);
        let nearest = if half - low < high - half { low } else { high };
        let others = self.sigmas.iter().zip(&self.shares).filter(|(sigma, _)| **sigma != nearest);
        let (sigmas, shares) = others.map(|(sigma, shares)| (*sigma, shares.clone())).unzip();
        Some(Branch { sigmas, shares }.half_height(without)? - self.half_height(without)?)
    }
}

pub(super) struct Pair {
    pub masses: usize,
    pub transient: f64,
    pub rest: Branch,
    pub above: Branch,
}

/// A quantity of both branches, over all chains but one.
type Quantity<'a> = &'a dyn Fn(&Pair, Option<usize>) -> Option<f64>;

pub(super) const FROM_REST: Quantity = &|pair, without| pair.rest.half_height(without);
pub(super) const FROM_ABOVE: Quantity = &|pair, without| pair.above.half_height(without);

/// Returns the half height from rest less that from above.
pub(super) fn distance(pair: &Pair, without: Option<usize>) -> Option<f64> {
    Some(pair.rest.half_height(without)? - pair.above.half_height(without)?)
}

impl Pair {
    /// Lists the pairs of branches by length and transient.
    pub fn collect(chains: &[Chains]) -> Vec<Pair> {
        let mut keys: Vec<(usize, f64)> = Vec::new();
        for Chains { ensemble, .. } in chains {
            let masses = ensemble.chain.masses;
            keys.extend(ensemble.protocols.iter().map(|window| (masses, window.transient)));
        }
        keys.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        keys.dedup();
        let branch = |(masses, transient), heated| Branch::new(chains, masses, heated, transient);
        let pair = |key: (usize, f64)| Pair {
            masses: key.0,
            transient: key.1,
            rest: branch(key, false),
            above: branch(key, true),
        };
        keys.into_iter().map(pair).collect()
    }

    pub fn chains(&self) -> usize {
        self.rest.chains().min(self.above.chains())
    }

    /// Estimates a quantity with its jackknife error over chains.
    pub fn estimate(&self, quantity: Quantity) -> Option<Estimate> {
        jackknife(self.chains(), |without| quantity(self, without))
    }

    /// Estimates by how much a quantity exceeds that of another pair of the same chains.
    pub fn estimate_less(&self, other: &Pair, quantity: Quantity) -> Option<Estimate> {
        jackknife(self.chains().min(other.chains()), |without| {
            Some(quantity(self, without)? - quantity(other, without)?)
        })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    const CHAINS: usize = 12;

    /// Chains whose share rises from 0 to 1 over an interval of σ around a place of each chain.
    fn made_up(places: &[f64]) -> Branch {
        let sigmas = vec![0.0, 1.0];
        let shares = |sigma: f64| places.iter().map(|place| Some(0.5 + sigma - place)).collect();
        Branch { shares: sigmas.iter().map(|sigma| shares(*sigma)).collect(), sigmas }
    }

    pub fn pair(transient: f64, rest: &[f64], above: &[f64]) -> Pair {
        Pair { masses: 1, transient, rest: made_up(rest), above: made_up(above) }
    }

    /// Places on both branches: a shared part, with a standard deviation of 0.06, and parts with
    /// 0.03 and 0.04. The distance of the half heights then has the error 0.05/√12.
    fn drawn(index: u64) -> [Vec<f64>; 2] {
        let mut normals = NormalPairs::new("test of branches", Seed(1), index);
        let mut places = [Vec::new(), Vec::new()];
        for _ in 0..CHAINS {
            let ([both, _], [rest, above]) = (normals.pair(), normals.pair());
            places[0].push(0.6 + 0.06 * both + 0.03 * rest);
            places[1].push(0.4 + 0.06 * both + 0.04 * above);
        }
        places
    }

    #[test]
    fn the_error_of_a_distance_is_the_known_one() {
        let mut squares = 0.0;
        const SAMPLES: u64 = 4000;
        for index in 0..SAMPLES {
            let [rest, above] = drawn(index);
            let error = pair(500.0, &rest, &above).estimate(&distance).unwrap().error;
            squares += error * error / SAMPLES as f64;
        }
        // 4000 mean squares with 11 degrees of freedom: known to √(2/11/4000) = 0.7 %.
        // Resampling would give 11/12 of it, independent branches nearly four times as much.
        let known = 0.05 * 0.05 / CHAINS as f64;
        assert!((squares / known - 1.0).abs() < 0.03, "{}", squares / known);
    }

    #[test]
    fn what_a_missing_sigma_changes_by_hand() {
        // The curve is σ²/4 at 0, 1, 2: the half height is 4/3 by the last two, 1 by both ends.
        let (sigmas, shares) = (vec![0.0, 1.0, 2.0], [0.0, 0.25, 1.0].map(|y| vec![Some(y); 3]));
        let branch = Branch { sigmas, shares: shares.into() };
        assert_eq!(branch.neighbours(), Some([1.0, 2.0]));
        assert!((branch.coarser(Some(0)).unwrap() + 1.0 / 3.0).abs() < 1e-15);
    }

    #[test]
    fn changes_are_taken_chain_by_chain() {
        // Chains differ much, and all change by the same.
        let (first, later) = ([0.1, 0.5, 0.9], [0.2, 0.6, 1.0]);
        let (first, later) = (pair(1.0, &first, &first), pair(2.0, &later, &first));
        let change = later.estimate_less(&first, FROM_REST).unwrap();
        assert!((change.value - 0.1).abs() < 1e-12 && change.error < 1e-12, "{change:?}");
    }
}
