//! Runs that can be repeated elsewhere: a digest of the impacts shows that they are the same to the last bit.

use crate::{Chain, Engine, Error, Impact, Scenario};
use impact_numerics::random::NormalPairs;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// The input of a run: all that determines its bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Asked {
    /// The chain.
    pub chain: Chain,
    /// Its forcing.
    pub forces: Forces,
    /// Transient T after which gaps with an impact are counted.
    pub transient: f64,
    /// Window W in which they are counted.
    pub window: f64,
}

/// Where the amplitudes of the forcing come from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Forces {
    /// A realisation of an ensemble.
    Drawn {
        /// Standard deviation σ.
        sigma: f64,
        /// Name of the random stream.
        stream: String,
        /// Its seed.
        seed: u64,
        /// Which of its realisations.
        realisation: u64,
    },
    /// Given as (α, β) for each mass; the start is not random.
    Given(Vec<[f64; 2]>),
}

impl Asked {
    /// The time at which it ends.
    pub fn until(&self) -> f64 {
        self.transient + self.window
    }

    /// The scenario, checked.
    pub fn scenario(&self) -> Result<Scenario, Error> {
        for (field, time) in [("transient", self.transient), ("window", self.window)] {
            if !(time >= 0.0 && time.is_finite()) {
                let problem = format!("{time:?} is no length of time");
                return Err(Error::input(field, problem, "give a finite number ≥ 0"));
            }
        }
        match &self.forces {
            Forces::Drawn { sigma, stream, seed, realisation } => {
                let mut normals = NormalPairs::new(stream, *seed, *realisation);
                Ok(Scenario::draw(&self.chain, *sigma, &mut normals))
            }
            Forces::Given(pairs) => Scenario::given(&self.chain, pairs.clone()),
        }
    }
}

/// A run that is advanced piece by piece.
#[derive(Clone, Debug)]
pub struct Replay {
    engine: Engine,
    transient: f64,
    until: f64,
    hit: Vec<bool>,
    seen: Sha256,
}

impl Replay {
    /// The run at t = 0.
    pub fn new(asked: &Asked) -> Result<Replay, Error> {
        let scenario = asked.scenario()?;
        Ok(Replay {
            engine: Engine::new(&scenario)?,
            transient: asked.transient,
            until: asked.until(),
            hit: vec![false; scenario.gaps()],
            seen: Sha256::new(),
        })
    }

    /// Advances by at most `most` impacts and calls `see` with time and gap of each, gaps counted from 0. False at the end.
    pub fn advance(&mut self, most: u64, mut see: impl FnMut(f64, usize)) -> Result<bool, Error> {
        let (mut left, gaps) = (most, self.hit.len());
        let Replay { engine, hit, seen, transient, .. } = self;
        engine.run(self.until, |Impact { time, gap, closing_speed }| {
            let bits = [time.to_bits(), gap as u64, closing_speed.to_bits()];
            bits.iter().for_each(|bits| seen.update(bits.to_le_bytes()));
            // Gaps of a ring are numbered from 1.
            let gap = gap % gaps;
            hit[gap] |= time > *transient;
            see(time, gap);
            left = left.saturating_sub(1);
            left > 0
        })?;
        Ok(left == 0)
    }

    /// Gaps of the chain.
    pub fn gaps(&self) -> usize {
        self.hit.len()
    }

    /// Different gaps with an impact in the window (T, T + W] so far.
    pub fn distinct(&self) -> usize {
        self.hit.iter().filter(|hit| **hit).count()
    }

    /// The engine, with its counted work.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }

    /// SHA-256 over the impacts so far, in hexadecimal: of each its time, its gap as the engine numbers it, and its
    /// closing speed; eight bytes each, the lowest first, with the bits of doubles as they are.
    pub fn digest(&self) -> String {
        self.seen.clone().finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Boundary;

    #[test]
    fn pieces_are_the_whole() {
        for boundary in [Boundary::Walls, Boundary::Ring] {
            let chain = Chain { masses: 20, boundary, ..Chain::default() };
            let stream = "replay".into();
            let forces = Forces::Drawn { sigma: 0.3, stream, seed: 1, realisation: 0 };
            let asked = Asked { chain, forces, transient: 50.0, window: 50.0 };
            let mut whole = Replay::new(&asked).unwrap();
            assert!(!whole.advance(u64::MAX, |_, _| ()).unwrap());
            assert!(whole.engine().counters().impacts > 300 && whole.distinct() > 10);
            let mut pieces = Replay::new(&asked).unwrap();
            let mut shown = Vec::new();
            while pieces.advance(7, |_, gap| shown.push(gap)).unwrap() {}
            assert_eq!(shown.len() as u64, whole.engine().counters().impacts);
            assert!(shown.iter().all(|gap| *gap < whole.gaps()));
            assert_eq!((pieces.digest(), pieces.distinct()), (whole.digest(), whole.distinct()));
        }
    }
}
