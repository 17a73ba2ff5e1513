//! Defines an ensemble: random chains at several σ, and the windows in which they are counted.

use impact_chain::abreast::{Abreast, Counting, Realisation};
use impact_chain::counts::{Counts, Watch};
use impact_chain::{Chain, Engine, Error, Initial, NormalPairs, Protocol, Scenario, Seed};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow::{Break, Continue};
use std::ops::Range;

/// A stronger force before the count begins; then forces are lowered to σ without a jump.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Heating {
    pub sigma: f64,
    /// Duration, in units of 1/ω.
    pub time: f64,
}

/// Fewer or shorter runs beyond the rise, where chains have nearly the same count and cost most.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Beyond {
    /// The σ above which runs are fewer or shorter, in units of d ω².
    pub above: f64,
    pub realisations: Option<usize>,
    /// Time at which they end, in units of 1/ω; windows that end later have no counts.
    pub until: Option<f64>,
}

/// Random chains at several σ. Realisation i has the same standard normals at every σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ensemble {
    /// Name, as in the tables of results.
    pub name: String,
    pub chain: Chain,
    /// A stronger force at first, for chains that come from larger σ.
    pub heating: Option<Heating>,
    /// Standard deviations σ of the amplitudes, rising, in units of d ω².
    pub sigmas: Vec<f64>,
    /// The windows, all of which are read from one run.
    pub protocols: Vec<Protocol>,
    pub first: u64,
    pub realisations: usize,
    pub beyond: Option<Beyond>,
    /// Share of overlapping starts above which the row of a σ does not count for the rise.
    pub most_rejected: f64,
    /// Pieces of about equal length of a chain, of which each is counted like a realisation.
    pub pieces: usize,
    pub stream: String,
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

    /// Returns whether so few starts at a σ were rejected for overlap that its row counts for the
    /// rise.
    pub fn is_comparable(&self, sigma: f64, rejected: usize) -> bool {
        rejected as f64 <= self.most_rejected * self.realisations_at(sigma) as f64
    }

    /// Estimates the impacts of one realisation, plus one a mass: to cut work and show progress.
    pub fn work(&self, sigma: f64) -> u64 {
        // Impacts per unit of time and mass, of the paper's chain, roughly.
        let rate = |sigma: f64| (1.6 * (sigma - 0.085)).clamp(0.0, 0.3);
        let impacts = match self.heating {
            // Impacts go on at lower σ, roughly as those from rest at σ + 0.03.
            Some(hot) => hot.time * rate(hot.sigma) + self.until(sigma) * rate(sigma + 0.03),
            None => self.until(sigma) * rate(sigma),
        };
        (self.chain.masses as f64 * (1.0 + impacts)) as u64
    }

    /// Prepares the simulation of its realisations at a σ, which ends early when `stopped` returns
    /// true.
    pub fn prepare<'a>(&'a self, sigma: f64, stopped: Stopped<'a>) -> Realisations<'a> {
        let heating = self.heating.map(|heating| Abreast::new(&self.chain, &[], heating.time));
        let counting = Counting::new(&self.chain, &self.protocols, self.until(sigma));
        Realisations { ensemble: self, sigma, heating, counting, stopped }
    }

    /// Counts the gaps with an impact of each piece in each window, instead of those of the chain.
    fn count_pieces(&self, counts: &mut Counts, watch: &Watch) {
        for (distinct, window) in counts.distinct.iter_mut().zip(&self.protocols) {
            let hit = watch.gaps_hit(window).filter(|_| distinct[0].is_some());
            let count = |piece: usize| {
                let hit = hit.as_ref()?;
                let [from, to] = [piece, piece + 1].map(|end| end * hit.len() / self.pieces);
                Some(hit[from..to].iter().map(|&hit| u32::from(hit)).sum())
            };
            *distinct = (0..self.pieces).map(count).collect();
        }
    }

    fn draw(&self, sigma: f64, index: u64) -> Scenario {
        let mut normals = NormalPairs::new(&self.stream, Seed(self.seed), index);
        Scenario::draw(&self.chain, sigma, &mut normals)
    }
}

/// Returns whether a run is to end.
pub type Stopped<'a> = &'a (dyn Fn() -> bool + Sync);

/// Realisations at one σ, which are simulated side by side, or else one by one by the engine.
pub struct Realisations<'a> {
    ensemble: &'a Ensemble,
    sigma: f64,
    /// The run before the transient, if there is one.
    heating: Option<Option<Abreast>>,
    counting: Counting,
    stopped: Stopped<'a>,
}

impl Realisations<'_> {
    /// Counts the impacts of realisations, in their order; incomplete if it ended early.
    pub fn count(&self, indices: Range<u64>) -> Result<Vec<Counts>, Error> {
        let first = self.ensemble.first;
        let starts = self.starts(indices.start + first..indices.end + first);
        let runs = self.counting.run(starts, |index| self.start_engine(index), self.stopped)?;
        let cut = |(mut counts, watch): (Counts, Watch)| {
            self.ensemble.count_pieces(&mut counts, &watch);
            counts
        };
        Ok(runs.into_iter().map(cut).collect())
    }

    /// Returns an engine at the time from which transients are measured.
    fn start_engine(&self, index: u64) -> Result<Engine, Error> {
        let (ensemble, sigma) = (self.ensemble, self.sigma);
        let Some(Heating { sigma: hot, time }) = ensemble.heating else {
            return Engine::new(&ensemble.draw(sigma, index));
        };
        let scenario = ensemble.draw(hot, index);
        let mut engine = Engine::new(&scenario)?;
        engine.run(time, |_, _| if (self.stopped)() { Break(()) } else { Continue(()) })?;
        Engine::new(&lowered(&scenario, &engine.free_parts(), time, sigma / hot))
    }

    /// Lists the scenarios from which transients are measured, or `None` for those whose way there
    /// has to be simulated by the engine, each with its index.
    fn starts(&self, indices: Range<u64>) -> Vec<(u64, Option<Scenario>)> {
        let ensemble = self.ensemble;
        let Some((hot, heating)) = ensemble.heating.zip(self.heating.as_ref()) else {
            return indices.map(|index| (index, Some(ensemble.draw(self.sigma, index)))).collect();
        };
        let Some(heating) = heating else { return indices.map(|index| (index, None)).collect() };
        let scenarios: Vec<_> =
            indices.clone().map(|index| ensemble.draw(hot.sigma, index)).collect();
        let start = |(run, scenario): (Option<Realisation>, &Scenario)| {
            let free = run?.free_parts(&ensemble.chain);
            Some(lowered(scenario, &free, hot.time, self.sigma / hot.sigma))
        };
        let runs = heating.run(&scenarios, self.stopped).into_iter().zip(&scenarios);
        indices.zip(runs.map(start)).collect()
    }
}

/// Returns the scenario that continues a motion from `time` with all forces multiplied by `factor`:
/// the phases of the forces advance by `time`, and the free parts take up the change of the forced
/// response, so that positions and velocities are continuous.
pub fn lowered(scenario: &Scenario, free: &[[f64; 2]], time: f64, factor: f64) -> Scenario {
    let (omega, frequency) = (scenario.natural_frequency, scenario.forcing_frequency);
    let mut parts = advanced(free, omega * time);
    let mut forcing = advanced(&scenario.forcing, frequency * time);
    let lost = (1.0 - factor) / (omega * omega - frequency * frequency);
    for ([a, b], force) in parts.iter_mut().zip(&mut forcing) {
        *a += lost * force[0];
        *b += lost * frequency / omega * force[1];
        *force = force.map(|x| factor * x);
    }
    Scenario { initial: Initial::Free(parts), forcing, ..scenario.clone() }
}

/// Returns pairs of cosine and sine amplitudes with their phases advanced by an angle.
fn advanced(pairs: &[[f64; 2]], angle: f64) -> Vec<[f64; 2]> {
    let (sin, cos) = pxfm::f_sincos(angle);
    pairs.iter().map(|[a, b]| [a * cos + b * sin, b * cos - a * sin]).collect()
}
