//! The influence of the counting protocol: half height against transient T and window W.

use super::ensembles::{Begun, Ensembles, Running, joined_by};
use super::{Error, Progress, rise, weights};
use crate::params::{
    COMPARABLE_REJECTED, PRINTED_THRESHOLD, PRINTED_THRESHOLD_UNIT, ProtocolParams,
};
use impact_chain::Scenario;
use impact_numerics::random::NormalPairs;
use impact_numerics::statistics::{Estimate, mean};
use literate::experiments::cutting::{Cutting, Row};
use serde::{Deserialize, Serialize};

/// Half height for every pair of a transient and a window.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProtocolMap {
    /// What was run.
    pub parameters: ProtocolParams,
    /// One cell for each pair, transients outer, windows inner.
    pub cells: Vec<ProtocolCell>,
    /// For each cell the mean count of all realisations at each σ; none where no run reached the window, and where too
    /// many starts overlap for the row to be comparable.
    pub curves: Vec<Vec<Option<f64>>>,
    /// Realisations whose random start overlaps, or that the engine ended early; they are counted in no
    /// window.
    pub failed: usize,
}

/// The rise under one protocol.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProtocolCell {
    /// Transient T.
    pub transient: f64,
    /// Window W.
    pub window: f64,
    /// Half height of the mean of the kept.
    pub half_height: Option<Estimate>,
    /// Half height of the mean of all.
    pub half_height_all: Option<Estimate>,
    /// Onset: the mean of all reaches N/20.
    pub onset: Option<Estimate>,
    /// Half of the realisations are kept: they have an impact in the window.
    pub kept_half: Option<Estimate>,
    /// Whether `half_height` rounds to the printed threshold, σ ≈ 0.12.
    pub prints_as_published: bool,
}

impl ProtocolMap {
    /// The cell of a transient and a window.
    pub fn cell(&self, transient: f64, window: f64) -> Option<&ProtocolCell> {
        self.cells.get(self.place(transient, window)?)
    }

    /// (σ, mean count of all) for a transient and a window.
    pub fn curve(&self, transient: f64, window: f64) -> Option<Vec<(f64, f64)>> {
        let means = self.curves.get(self.place(transient, window)?)?;
        let points = self.parameters.sigmas.iter().zip(means);
        Some(points.filter_map(|(&sigma, mean)| Some((sigma, (*mean)?))).collect())
    }

    fn place(&self, transient: f64, window: f64) -> Option<usize> {
        let own = |cell: &ProtocolCell| cell.transient == transient && cell.window == window;
        self.cells.iter().position(own)
    }
}

/// Distinct gaps that one run has in every window; none for windows that it did not reach.
pub type Counts = Vec<Option<u32>>;

/// Some realisations of one σ; none where there was no run to the end.
pub type Part = Vec<Option<Counts>>;

/// The map in units of work: realisations of one σ.
pub const CUTTING: Cutting<ProtocolParams, Part, ProtocolMap> = joined_by(join);

/// When runs end at a σ.
pub(super) fn until(parameters: &ProtocolParams, sigma: f64) -> f64 {
    let longest = |times: &[f64]| times.last().copied().unwrap_or(0.0);
    let full = longest(&parameters.transients) + longest(&parameters.windows);
    if sigma > parameters.short_above { full.min(parameters.short_until) } else { full }
}

/// Number of pairs of a transient and a window.
pub(super) fn cells(parameters: &ProtocolParams) -> usize {
    parameters.transients.len() * parameters.windows.len()
}

impl Ensembles for ProtocolParams {
    type One = Option<Counts>;

    fn rows(&self) -> Vec<Row> {
        let row = |&sigma: &f64| Row {
            covers: format!("sigma = {sigma}"),
            realisations: self.realisations,
            weight: weights::run(&self.chain, sigma, until(self, sigma)),
        };
        self.sigmas.iter().map(row).collect()
    }

    fn row<'a>(&'a self, row: usize, progress: &'a Progress) -> Begun<'a, Option<Counts>> {
        let sigma = self.sigmas[row];
        Ok(Box::new(move |index| realisation(self, sigma, index, until(self, sigma), progress)))
    }

    fn fits(&self, _: usize, counts: &Option<Counts>) -> bool {
        let (cells, gaps) = (cells(self), self.chain.gaps());
        let fits = |counts: &Counts| {
            counts.len() == cells && counts.iter().flatten().all(|&k| k as usize <= gaps)
        };
        counts.as_ref().is_none_or(fits)
    }
}

pub(crate) fn join(
    parameters: &ProtocolParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<ProtocolMap, Error> {
    let mut failed = 0;
    // by_cell[cell][σ][realisation]
    let cells = cells(parameters);
    let mut by_cell = vec![Vec::with_capacity(parameters.sigmas.len()); cells];
    for runs in parts {
        let runs = runs.concat();
        let none = runs.iter().filter(|run| run.is_none()).count();
        failed += none;
        // As in the sweep, no place is read from a row of which many starts overlapped.
        let comparable = none as f64 <= COMPARABLE_REJECTED * runs.len() as f64;
        let read = |run: &Option<Counts>, cell: usize| {
            run.as_ref().filter(|_| comparable).and_then(|counts| counts[cell])
        };
        for (cell, rows) in by_cell.iter_mut().enumerate() {
            rows.push(runs.iter().map(|run| read(run, cell)).collect::<Counts>());
        }
    }
    let protocols = parameters
        .transients
        .iter()
        .flat_map(|&transient| parameters.windows.iter().map(move |&window| (transient, window)));
    let mean =
        |counts: &Counts| mean(&counts.iter().flatten().map(|&k| f64::from(k)).collect::<Vec<_>>());
    let curves = by_cell.iter().map(|rows: &Vec<Counts>| rows.iter().map(mean).collect()).collect();
    let mut map = Vec::with_capacity(cells);
    for ((transient, window), counts) in protocols.zip(by_cell) {
        progress.check()?;
        let gaps = parameters.chain.gaps();
        let rise = rise::find(&parameters.sigmas, &counts, gaps, parameters.seed);
        let half_height = rise.half_height;
        map.push(ProtocolCell {
            transient,
            window,
            half_height,
            half_height_all: rise.half_height_all,
            onset: rise.onset,
            kept_half: rise.kept_half,
            prints_as_published: half_height.is_some_and(|half| prints_as_published(half.value)),
        });
    }
    Ok(ProtocolMap { parameters: parameters.clone(), cells: map, curves, failed })
}

/// Whether a number rounds to the printed threshold with the printed digits.
fn prints_as_published(sigma: f64) -> bool {
    let half = 0.5 * PRINTED_THRESHOLD_UNIT;
    (PRINTED_THRESHOLD - half..PRINTED_THRESHOLD + half).contains(&sigma)
}

/// One long run; none if its start overlaps, or the engine gave up.
pub(super) fn realisation(
    parameters: &ProtocolParams,
    sigma: f64,
    index: u64,
    until: f64,
    progress: &Progress,
) -> Result<Option<Counts>, Error> {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(&parameters.chain, sigma, &mut normals);
    let Some(mut motion) = Running::new(&scenario, "protocol map", progress)? else {
        return Ok(None);
    };
    let passages = motion.passages(&parameters.transients, until)?;
    Ok(passages.map(|passages| passages.counts(&parameters.windows, until)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::tally::{self, Outcome};
    use crate::params::{Profile, Protocol};

    #[test]
    fn one_run_reads_every_window_as_its_own_run_would() {
        let mut parameters = ProtocolParams::new(Profile::Quick);
        parameters.chain.masses = 20;
        parameters.transients = vec![20.0, 50.0, 100.0];
        parameters.windows = vec![20.0, 50.0];
        let quiet = Progress::silent();
        let mut most = 0;
        for index in 0..6 {
            let counts = realisation(&parameters, 0.16, index, 150.0, &quiet).unwrap().unwrap();
            let mut cell = counts.iter();
            for &transient in &parameters.transients {
                for &window in &parameters.windows {
                    let protocol = Protocol { transient, window };
                    let key = (parameters.stream.as_str(), parameters.seed, index);
                    let chain = &parameters.chain;
                    let alone = tally::realisation(chain, protocol, 0.16, key, &quiet).unwrap();
                    let Outcome::Counted(alone) = alone else { panic!("{alone:?}") };
                    assert_eq!(cell.next(), Some(&Some(alone.distinct)));
                    most = most.max(alone.distinct);
                }
            }
        }
        assert!(most > 3, "a sample without impacts tests nothing");
    }

    #[test]
    fn rounding_to_the_printed_digits() {
        assert!(prints_as_published(0.115) && prints_as_published(0.1249));
        assert!(!prints_as_published(0.1149) && !prints_as_published(0.1251));
    }
}
