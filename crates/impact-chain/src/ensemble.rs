//! Ensembles: chains of one kind, drawn at several σ, run, and counted in windows of time.

use crate::counts::{Counts, Watch};
use crate::{Chain, Engine, Error, Scenario};
use impact_numerics::random::NormalPairs;
use serde::{Deserialize, Serialize};

/// How impacts are counted (ours; Sec. 2 has only "a suitable transient time"): different gaps with an impact in
/// the window (T, T + W].
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
    /// The end of the window, T + W.
    pub fn end(&self) -> f64 {
        self.transient + self.window
    }
}

/// A stronger force before the count begins; then all forces are lowered to σ at unchanged positions and velocities.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Heating {
    /// Standard deviation of the amplitudes before.
    pub sigma: f64,
    /// Its duration, in units of 1/ω.
    pub time: f64,
}

/// Fewer or shorter runs beyond the rise, where all chains count nearly the same number of gaps and each costs most.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Beyond {
    /// The σ above which runs are fewer or shorter, in units of d ω².
    pub above: f64,
    /// Number of realisations there.
    pub realisations: Option<usize>,
    /// Time at which they end, in units of 1/ω; windows that end later have no counts.
    pub until: Option<f64>,
}

/// Random chains of one kind at several σ. Realisation i has the same standard normals at every σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ensemble {
    /// Name, as in the tables of results.
    pub name: String,
    /// The chain, with its start.
    pub chain: Chain,
    /// A stronger force before, for chains that come from above.
    pub heating: Option<Heating>,
    /// Standard deviations σ of the amplitudes, rising, in units of d ω².
    pub sigmas: Vec<f64>,
    /// The windows, all of which are read from one run.
    pub protocols: Vec<Protocol>,
    /// Realisations at each σ.
    pub realisations: usize,
    /// Fewer or shorter runs beyond the rise.
    pub beyond: Option<Beyond>,
    /// Share of overlapping starts above which a σ is left out when the places of the rise are found.
    pub most_rejected: f64,
    /// Pieces of about equal length in which a long chain is counted, each like a realisation.
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
            realisations: 100,
            beyond: None,
            most_rejected: 0.1,
            pieces: 1,
            stream: "ensemble".into(),
            seed: 2007,
        }
    }
}

/// Estimated impacts of a run up to `time`, plus one for the first search of each mass: to cut units and to show
/// progress. No result depends on it.
fn work(chain: &Chain, sigma: f64, time: f64) -> u64 {
    // Impacts per unit of time and mass, of the paper's chain, roughly.
    let rate = (1.6 * (sigma - 0.085)).clamp(0.0, 0.3);
    (chain.masses as f64 * (1.0 + time * rate)) as u64
}

impl Ensemble {
    /// Realisations at a σ.
    pub fn realisations_at(&self, sigma: f64) -> usize {
        self.beyond(sigma).and_then(|less| less.realisations).unwrap_or(self.realisations)
    }

    /// When runs at a σ end: with the last window, if they are not shortened.
    pub fn until(&self, sigma: f64) -> f64 {
        let last = self.protocols.iter().map(Protocol::end).fold(0.0, f64::max);
        self.beyond(sigma).and_then(|less| less.until).map_or(last, |until| last.min(until))
    }

    fn beyond(&self, sigma: f64) -> Option<Beyond> {
        self.beyond.filter(|less| sigma > less.above)
    }

    /// Impacts that one realisation is likely to have.
    pub fn work(&self, sigma: f64) -> u64 {
        let until = self.until(sigma);
        match self.heating {
            // From above, impacts go on at lower σ: roughly as those from rest at σ + 0.03.
            Some(Heating { sigma: hot, time }) => {
                work(&self.chain, hot, time) + work(&self.chain, sigma + 0.03, until)
            }
            None => work(&self.chain, sigma, until),
        }
    }

    /// Runs realisation `index` at a σ and counts its impacts; ends early, with incomplete counts, when `stopped` returns
    /// true. A start that overlaps, and a run that the engine ended early, are counted as such.
    ///
    /// # Errors
    /// [`Error::Input`] if the chain is not allowed.
    pub fn realisation(
        &self,
        sigma: f64,
        index: u64,
        stopped: impl Fn() -> bool,
    ) -> Result<Counts, Error> {
        let mut engine = match self.started(sigma, index, &stopped) {
            Ok(engine) => engine,
            Err(Error::Overlap { .. }) => return Ok(Counts::rejected(self)),
            Err(Error::Work { .. }) => return Ok(Counts::failed(self)),
            Err(error) => return Err(error),
        };
        let mut watch = Watch::new(self);
        let ended = watch.follow(&mut engine, self.until(sigma), &stopped);
        watch.counts(self, &engine, ended)
    }

    /// An engine at the time from which transients are measured.
    fn started(
        &self,
        sigma: f64,
        index: u64,
        stopped: &impl Fn() -> bool,
    ) -> Result<Engine, Error> {
        let mut normals = NormalPairs::new(&self.stream, self.seed, index);
        let Some(Heating { sigma: hot, time }) = self.heating else {
            return Engine::new(&Scenario::draw(&self.chain, sigma, &mut normals));
        };
        let scenario = Scenario::draw(&self.chain, hot, &mut normals);
        let mut engine = Engine::new(&scenario)?;
        engine.run(time, |_| !stopped())?;
        Engine::new(&scenario.lowered(&engine.free_parts(), time, sigma / hot))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn small() -> Ensemble {
        let times = [(20.0, 20.0), (20.0, 50.0), (50.0, 20.0), (100.0, 50.0)];
        Ensemble {
            chain: Chain { masses: 20, ..Chain::default() },
            sigmas: vec![0.16],
            protocols: times.map(|(transient, window)| Protocol { transient, window }).to_vec(),
            ..Ensemble::default()
        }
    }

    fn run(ensemble: &Ensemble, sigma: f64, realisations: u64) -> Counts {
        let one = |index| ensemble.realisation(sigma, index, || false).unwrap();
        (0..realisations).map(one).collect()
    }

    #[test]
    fn windows_by_a_list_of_impacts() {
        let scenario =
            Scenario::draw(&small().chain, 0.16, &mut NormalPairs::new("ensemble", 2007, 2));
        let impacts = Engine::new(&scenario).unwrap().impacts(150.0).unwrap();
        let found = run(&small(), 0.16, 3);
        for (at, window) in small().protocols.iter().enumerate() {
            let within = |time| time > window.transient && time <= window.end();
            let gaps: Vec<usize> =
                impacts.iter().filter(|hit| within(hit.time)).map(|hit| hit.gap).collect();
            let distinct = (0..21).filter(|gap| gaps.contains(gap)).count() as u32;
            assert_eq!(found.distinct[at][2], Some(distinct));
            assert_eq!(found.impacts[at][2], gaps.len() as u64);
        }
    }

    /// Of 40 masses with random free parts at σ = 0.3 nine chains of ten overlap at the start.
    #[test]
    fn starts_that_overlap_are_counted_as_rejected() {
        let chain = Chain { masses: 40, start: crate::Start::Random, ..Chain::default() };
        let found = run(&Ensemble { chain, ..small() }, 0.3, 4);
        let none = found.distinct[0].iter().filter(|count| count.is_none()).count();
        assert!(found.rejected > 0 && found.rejected == none && found.failed == 0, "{found:?}");
    }

    #[test]
    fn pieces_add_up_to_the_chain() {
        let whole = run(&small(), 0.16, 4);
        let pieces = run(&Ensemble { pieces: 2, ..small() }, 0.16, 4);
        for (whole, pieces) in whole.distinct.iter().zip(&pieces.distinct) {
            let sums = pieces.chunks(2).map(|pair| Some(pair[0]? + pair[1]?));
            assert!(sums.eq(whole.iter().copied()));
        }
    }

    #[test]
    fn beyond_the_rise_runs_are_fewer_and_shorter() {
        let beyond = Beyond { above: 0.15, realisations: Some(2), until: Some(60.0) };
        let short = Ensemble { beyond: Some(beyond), ..small() };
        assert_eq!([0.15, 0.16].map(|sigma| short.realisations_at(sigma)), [100, 2]);
        assert_eq!([0.15, 0.16].map(|sigma| short.until(sigma)), [150.0, 60.0]);
        let (cut, whole) = (run(&short, 0.16, 2), run(&small(), 0.16, 2));
        assert_eq!(cut.distinct[0], whole.distinct[0]);
        assert_eq!(cut.distinct[1..], vec![vec![None; 2]; 3]);
    }
}
