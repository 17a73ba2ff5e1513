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

/// Creates the generator behind every random choice: stream `index` of `experiment` under `seed`.
pub fn generator(experiment: &str, seed: u64, index: u64) -> Pcg64Dxsm {
    let mut hash = Sha256::new();
    hash.update(seed.to_le_bytes());
    hash.update(experiment.as_bytes());
    let digest = hash.finalize();
    let mut state = [0; 16];
    state.copy_from_slice(&digest[..16]);
    Pcg64Dxsm::new(u128::from_le_bytes(state), u128::from(index))
}

impl NormalPairs {
    pub fn new(experiment: &str, seed: u64, realisation: u64) -> Self {
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
