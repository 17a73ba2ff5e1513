//! Creates random streams keyed by (experiment, master seed, realisation), with portable normals.

use rand_distr::{Distribution, UnitDisc};
use rand_pcg::Pcg64Dxsm;
use sha2::{Digest, Sha256};

/// A stream of pairs of independent standard normals: the same bits for the same key everywhere.
///
/// The generator is PCG64-DXSM, whose stream is documented as portable; pairs come from Marsaglia's
/// polar method on [`UnitDisc`], with the logarithm of `pxfm`.
#[derive(Clone, Debug)]
pub struct NormalPairs(Pcg64Dxsm);

/// The number from which all random choices of an experiment follow, with its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seed(pub u64);

/// Creates the generator behind every random choice: stream `index` of `experiment` under a seed.
pub fn generator(experiment: &str, Seed(seed): Seed, index: u64) -> Pcg64Dxsm {
    let mut hash = Sha256::new();
    hash.update(seed.to_le_bytes());
    hash.update(experiment.as_bytes());
    let digest = hash.finalize();
    let mut state = [0; 16];
    state.copy_from_slice(&digest[..16]);
    Pcg64Dxsm::new(u128::from_le_bytes(state), u128::from(index))
}

impl NormalPairs {
    /// Creates the stream of one realisation of an experiment under a master seed.
    pub fn new(experiment: &str, seed: Seed, realisation: u64) -> Self {
        NormalPairs(generator(experiment, seed, realisation))
    }

    pub fn pair(&mut self) -> [f64; 2] {
        loop {
            let [x, y]: [f64; 2] = UnitDisc.sample(&mut self.0);
            let s = x * x + y * y;
            if s > 0.0 && s < 1.0 {
                let scale = (-2.0 * pxfm::f_log(s) / s).sqrt();
                return [scale * x, scale * y];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moments of 100 000 pairs within four of their standard deviations, and other streams for
    /// other keys.
    #[test]
    fn pairs_are_independent_standard_normals() {
        let mut normals = NormalPairs::new("moments", Seed(1), 0);
        let mut sums = [0.0; 4];
        for _ in 0..100_000 {
            let [x, y] = normals.pair();
            for (sum, term) in sums.iter_mut().zip([x + y, x * x, y * y * y * y, x * y]) {
                *sum += term / 1e5;
            }
        }
        // Variances of the terms: 2, 2, 105 − 9 and 1.
        for (sum, (wanted, variance)) in
            sums.iter().zip([(0.0, 2.0_f64), (1.0, 2.0), (3.0, 96.0), (0.0, 1.0)])
        {
            assert!((sum - wanted).abs() < 4.0 * (variance / 1e5).sqrt(), "{sums:?}");
        }
        let keys = [("a", 1, 0), ("a", 2, 0), ("a", 1, 1), ("b", 1, 0)];
        let firsts =
            keys.map(|(name, seed, index)| NormalPairs::new(name, Seed(seed), index).pair());
        for i in 1..4 {
            assert!(firsts[..i].iter().all(|first| *first != firsts[i]), "{firsts:?}");
        }
    }
}
