//! Runs a chain so that the run can be repeated elsewhere: a digest of the impacts shows that they
//! are the same to the last bit.

use crate::error::{Error, within};
use crate::search::clock::LATEST;
use crate::{Chain, Engine, Impact, Scenario};
use impact_numerics::random::NormalPairs;
use sha2::{Digest, Sha256};

/// The input of a run: all that determines its bits.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "ensembles", derive(serde::Deserialize, serde::Serialize))]
pub struct Request {
    pub chain: Chain,
    pub forces: Forces,
    /// Transient T after which gaps with an impact are counted.
    pub transient: f64,
    /// Window W in which they are counted.
    pub window: f64,
}

/// The source of the amplitudes of the forcing.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "ensembles",
    derive(serde::Deserialize, serde::Serialize),
    serde(rename_all = "lowercase")
)]
pub enum Forces {
    /// A realisation of an ensemble.
    Drawn {
        /// Standard deviation σ.
        sigma: f64,
        /// Name of the random stream.
        stream: String,
        /// Seed of the stream.
        seed: u64,
        /// Number of the realisation.
        realisation: u64,
    },
    /// Given as (α, β) for each mass; the start is not random.
    Given(Vec<[f64; 2]>),
}

impl Request {
    /// Returns the time at which the run ends.
    pub fn until(&self) -> f64 {
        self.transient + self.window
    }

    /// Returns the scenario.
    ///
    /// # Errors
    /// [`Error::Input`] for times out of range, or amplitudes that are not one pair for each mass.
    pub fn scenario(&self) -> Result<Scenario, Error> {
        within("transient", self.transient, 0.0, LATEST)?;
        within("window", self.window, 0.0, LATEST)?;
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
    /// Whether each gap has an impact in the window.
    hit: Vec<bool>,
    hash: Sha256,
}

impl Replay {
    /// Sets the run at t = 0.
    ///
    /// # Errors
    /// [`Error::Input`] for values outside the model, [`Error::Overlap`] for an overlapping start.
    pub fn new(request: &Request) -> Result<Replay, Error> {
        let scenario = request.scenario()?;
        Ok(Replay {
            engine: Engine::new(&scenario)?,
            transient: request.transient,
            until: request.until(),
            hit: vec![false; scenario.gaps()],
            hash: Sha256::new(),
        })
    }

    /// Advances by at most `most` impacts and calls `visit` with time and gap of each, gaps counted
    /// from 0. Returns false at the end of the run.
    ///
    /// # Errors
    /// [`Error::Work`] when the bound on work is exceeded.
    pub fn advance(&mut self, most: u64, mut visit: impl FnMut(f64, usize)) -> Result<bool, Error> {
        let (mut left, gaps) = (most, self.hit.len());
        let Replay { engine, hit, hash, transient, .. } = self;
        engine.run(self.until, |Impact { time, gap, closing_speed }| {
            for bits in [time.to_bits(), gap as u64, closing_speed.to_bits()] {
                hash.update(bits.to_le_bytes());
            }
            // Gaps of a ring are numbered from 1.
            let gap = gap % gaps;
            hit[gap] |= time > *transient;
            visit(time, gap);
            left = left.saturating_sub(1);
            left > 0
        })?;
        Ok(left == 0)
    }

    pub fn gaps(&self) -> usize {
        self.hit.len()
    }

    /// Counts the different gaps with an impact in the window (T, T + W] so far.
    pub fn distinct(&self) -> usize {
        self.hit.iter().filter(|hit| **hit).count()
    }

    /// Returns the engine, for its counted work.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }

    /// Returns SHA-256 over the impacts so far, in hexadecimal: of each impact the time, the gap as
    /// the engine numbers it, and the closing speed; eight bytes each, the lowest first, with the
    /// bits of doubles as they are.
    pub fn digest(&self) -> String {
        self.hash.clone().finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}
