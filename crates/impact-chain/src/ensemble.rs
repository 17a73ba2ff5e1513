//! Describes an ensemble: random chains at several σ, and the windows in which they are counted.

use crate::Chain;
use serde::{Deserialize, Serialize};

/// The window (T, T + W] in which gaps with an impact are counted (ours; Sec. 2 has only "a
/// suitable transient time").
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Protocol {
    /// Transient T that is dropped, in units of 1/ω.
    pub transient: f64,
    /// Window W, in units of 1/ω.
    pub window: f64,
}

impl Default for Protocol {
    fn default() -> Self {
        Protocol { transient: 500.0, window: 200.0 }
    }
}

impl Protocol {
    /// Returns the end of the window, T + W.
    pub fn end(&self) -> f64 {
        self.transient + self.window
    }
}

/// A stronger force before the count begins; then all forces are lowered to σ at unchanged
/// positions and velocities.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Heating {
    /// Standard deviation of the stronger amplitudes.
    pub sigma: f64,
    /// Duration, in units of 1/ω.
    pub time: f64,
}

/// Fewer or shorter runs beyond the rise, where all chains have nearly the same count and each
/// costs most.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Beyond {
    /// The σ above which runs are fewer or shorter, in units of d ω².
    pub above: f64,
    pub realisations: Option<usize>,
    /// Time at which they end, in units of 1/ω; windows that end later have no counts.
    pub until: Option<f64>,
}

/// Random chains with the same parameters at several σ. Realisation i has the same standard
/// normals at every σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ensemble {
    /// Name, as in the tables of results.
    pub name: String,
    /// The chain, with its start.
    pub chain: Chain,
    /// A stronger force at first, for chains that come from larger σ.
    pub heating: Option<Heating>,
    /// Standard deviations σ of the amplitudes, rising, in units of d ω².
    pub sigmas: Vec<f64>,
    /// The windows, all of which are read from one run.
    pub protocols: Vec<Protocol>,
    /// Number of the first realisation.
    pub first: u64,
    /// Realisations at each σ.
    pub realisations: usize,
    /// Fewer or shorter runs beyond the rise.
    pub beyond: Option<Beyond>,
    /// Share of overlapping starts above which a σ is left out when the places of the rise are
    /// found.
    pub most_rejected: f64,
    /// Pieces of about equal length into which a long chain is cut; each is counted like a
    /// realisation.
    pub pieces: usize,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl Default for Ensemble {
    fn default() -> Self {
        Ensemble {
            name: String::new(),
            chain: Chain::default(),
            heating: None,
            sigmas: Vec::new(),
            protocols: vec![Protocol::default()],
            first: 0,
            realisations: 100,
            beyond: None,
            most_rejected: 0.1,
            pieces: 1,
            stream: "ensemble".into(),
            seed: 2007,
        }
    }
}

/// Estimates the impacts of a run up to `time`, plus one for the first search of each mass: to cut
/// work into units and to show progress. No result depends on it.
fn work(chain: &Chain, sigma: f64, time: f64) -> u64 {
    // Impacts per unit of time and mass, of the paper's chain, roughly.
    let rate = (1.6 * (sigma - 0.085)).clamp(0.0, 0.3);
    (chain.masses as f64 * (1.0 + time * rate)) as u64
}

impl Ensemble {
    /// Returns the number of realisations at a σ.
    pub fn realisations_at(&self, sigma: f64) -> usize {
        self.beyond(sigma).and_then(|less| less.realisations).unwrap_or(self.realisations)
    }

    /// Returns the time at which runs at a σ end: with the last window, if they are not shortened.
    pub fn until(&self, sigma: f64) -> f64 {
        let last = self.protocols.iter().map(Protocol::end).fold(0.0, f64::max);
        self.beyond(sigma).and_then(|less| less.until).map_or(last, |until| last.min(until))
    }

    fn beyond(&self, sigma: f64) -> Option<Beyond> {
        self.beyond.filter(|less| sigma > less.above)
    }

    /// Estimates the impacts of one realisation.
    pub fn work(&self, sigma: f64) -> u64 {
        let until = self.until(sigma);
        match self.heating {
            // After a stronger force impacts go on at lower σ, roughly as those from rest at
            // σ + 0.03.
            Some(Heating { sigma: hot, time }) => {
                work(&self.chain, hot, time) + work(&self.chain, sigma + 0.03, until)
            }
            None => work(&self.chain, sigma, until),
        }
    }
}
