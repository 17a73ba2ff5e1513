//! Experiments that are ensembles: rows of realisations, each of which is run by its number alone.

use super::{Error, Progress};
use impact_chain::observe::FirstPassages;
use impact_chain::{self, Engine, Impact, Scenario};
use literate::experiments::cutting::{Cutting, Join, Row, Unit};
use literate::experiments::progress::Stage;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// What runs a realisation by its number, unless the chain is not allowed.
pub type Begun<'a, R> = Result<Box<dyn Fn(u64) -> Result<R, Error> + Sync + 'a>, Error>;

/// Parameters that say which realisations there are, and how they run.
pub trait Ensembles: Clone + Sync {
    /// What one realisation gives.
    type One: Clone + Send;

    /// The rows, in their order.
    fn rows(&self) -> Vec<Row>;

    /// What runs the realisations of a row.
    fn row<'a>(&'a self, row: usize, progress: &'a Progress) -> Begun<'a, Self::One>;

    /// Whether what was read from a file can be a realisation of a row.
    fn fits(&self, row: usize, one: &Self::One) -> bool;
}

/// What all realisations gave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ran<P, R> {
    /// What was run.
    pub parameters: P,
    /// For each row its realisations.
    pub rows: Vec<Vec<R>>,
}

/// Ensembles in units of work; they are kept as they are.
pub const fn cutting<P: Ensembles>() -> Cutting<P, Vec<P::One>, Ran<P, P::One>> {
    joined_by(ran)
}

/// Ensembles in units of work, of which a result is made.
pub const fn joined_by<P: Ensembles, T>(
    join: Join<P, Vec<P::One>, T>,
) -> Cutting<P, Vec<P::One>, T> {
    Cutting { rows: P::rows, part, fits: |own, unit, all| fits(own, unit, all), join }
}

fn part<P: Ensembles>(
    parameters: &P,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Vec<P::One>, Error> {
    let run = parameters.row(unit.row, progress)?;
    unit.each(stage, |index| {
        progress.check()?;
        run(index)
    })
}

fn fits<P: Ensembles>(parameters: &P, unit: &Unit, all: &[P::One]) -> bool {
    all.len() == unit.realisations.len() && all.iter().all(|one| parameters.fits(unit.row, one))
}

fn ran<P: Ensembles>(
    parameters: &P,
    parts: Vec<Vec<Vec<P::One>>>,
    _: &Progress,
) -> Result<Ran<P, P::One>, Error> {
    let rows = parts.into_iter().map(|parts| parts.concat()).collect();
    Ok(Ran { parameters: parameters.clone(), rows })
}

/// What each of several things gives, on all threads and told by the stage.
pub fn each<A: Send, R: Send>(
    stage: &Stage,
    progress: &Progress,
    all: impl IntoIterator<Item = A>,
    one: impl Fn(A) -> Result<R, Error> + Sync,
) -> Result<Vec<R>, Error> {
    let all: Vec<A> = all.into_iter().collect();
    let told = |own| {
        progress.check()?;
        let found = one(own)?;
        stage.advance(1);
        Ok(found)
    };
    all.into_par_iter().with_max_len(1).map(told).collect()
}

/// A chain on its way.
pub struct Running<'a> {
    /// Its engine.
    pub engine: Engine,
    gaps: usize,
    name: &'static str,
    progress: &'a Progress,
}

impl<'a> Running<'a> {
    /// A chain at its start, in an experiment of a name; none for a start that overlaps.
    pub fn new(
        scenario: &Scenario,
        name: &'static str,
        progress: &'a Progress,
    ) -> Result<Option<Self>, Error> {
        match Engine::new(scenario) {
            Ok(engine) => Ok(Some(Running { engine, gaps: scenario.gaps(), name, progress })),
            Err(impact_chain::Error::Overlap { .. }) => Ok(None),
            Err(source) => Err(Error::failed(name, source)),
        }
    }

    /// Goes on until a time, and notes the first impact of each gap after each transient; none where the engine gave up.
    pub fn passages<'b>(
        &mut self,
        transients: &'b [f64],
        until: f64,
    ) -> Result<Option<FirstPassages<'b>>, Error> {
        let mut passages = FirstPassages::new(transients, self.gaps);
        let ended = passages.follow(&mut self.engine, until, || self.progress.stopped());
        Ok(self.ended(ended)?.then_some(passages))
    }

    /// Goes on until a time; false where the engine gave up.
    pub fn go(&mut self, until: f64, mut see: impl FnMut(Impact)) -> Result<bool, Error> {
        let ended = self.engine.run(until, |impact| {
            see(impact);
            !self.progress.stopped()
        });
        self.ended(ended)
    }

    fn ended(&self, ended: Result<(), impact_chain::Error>) -> Result<bool, Error> {
        self.progress.check()?;
        match ended {
            Ok(()) => Ok(true),
            Err(impact_chain::Error::Work { .. }) => Ok(false),
            Err(source) => Err(Error::failed(self.name, source)),
        }
    }
}

/// How many there are.
pub fn count(hit: &[bool]) -> u64 {
    hit.iter().map(|&hit| u64::from(hit)).sum()
}
