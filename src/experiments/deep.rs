//! The long end of the protocol map: runs of up to 10⁵ time units, too long for every report.
//!
//! It is run now and then as the profile `deep`, and its result is committed. The report carries it
//! over changes of the source as long as an audit allows: some of its realisations are run again
//! by the program as it is, and their counts compared with those that were saved.

use super::cutting::Cutting;
use super::protocol::{self, Counts, Part, ProtocolMap};
use super::store::{self, Identity, Reason, told};
use super::{Error, Progress, weights};
use crate::numerics::statistics::{mean, normal_quantile, standard_deviation};
use crate::params::{LEVEL, Profile, ProtocolParams};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::sync::LazyLock;

/// The committed result, as it was saved.
const COMMITTED: &str = include_str!("../../benches/deep/long_protocol-deep.json");

/// Where it lies, seen from the top of the project.
pub const FILE: &str = "benches/deep/long_protocol-deep.json";

/// What to do about one that is stale.
pub const REMEDY: &str = "run `make deep` and build again";

/// So many realisations of each σ are kept, for the audit to run again.
const SAMPLE: usize = 2;

/// The map with what an audit compares.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LongMap {
    /// The map itself.
    pub map: ProtocolMap,
    /// For each σ.
    pub rows: Vec<LongRow>,
}

/// What an audit compares at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LongRow {
    /// Standard deviation σ of the amplitudes.
    pub sigma: f64,
    /// The counts of its first realisations, cell by cell; none where the engine gave up.
    pub sample: Vec<Option<Counts>>,
    /// Number of realisations with an impact in each cell: the kept.
    pub kept: Vec<usize>,
    /// Mean of all realisations in each cell.
    pub means: Vec<Option<f64>>,
    /// Standard deviation of all realisations in each cell.
    pub deviations: Vec<Option<f64>>,
}

/// The map in units of work: realisations of one σ.
pub const CUTTING: Cutting<ProtocolParams, Part, LongMap> =
    Cutting { rows: protocol::rows, part: protocol::part, fits: protocol::fits, join };

fn join(
    parameters: &ProtocolParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<LongMap, Error> {
    let row = |(&sigma, runs): (&f64, &Vec<Part>)| {
        let runs: Part = runs.concat();
        let cell = |cell: usize| -> Vec<f64> {
            runs.iter().flatten().filter_map(|counts| counts[cell]).map(f64::from).collect()
        };
        let cells: Vec<Vec<f64>> = (0..protocol::cells(parameters)).map(cell).collect();
        LongRow {
            sigma,
            kept: cells.iter().map(|cell| cell.iter().filter(|&&k| k > 0.0).count()).collect(),
            means: cells.iter().map(|cell| mean(cell)).collect(),
            deviations: cells.iter().map(|cell| standard_deviation(cell)).collect(),
            sample: runs.into_iter().take(SAMPLE).collect(),
        }
    };
    let rows = parameters.sigmas.iter().zip(&parts).map(row).collect();
    let map = protocol::join(parameters, parts, progress)?;
    Ok(LongMap { map: ProtocolMap { means: Vec::new(), ..map }, rows })
}

/// What an audit found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every count is that which was saved.
    Identical,
    /// Counts differ, and their means by no more than chance lets expect.
    WithinError,
    /// Counts differ by more than that: the saved result is stale.
    Failed,
}

/// A sample of the committed result, run again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Audit {
    /// What follows from the rest.
    pub verdict: Verdict,
    /// Realisations that were run again.
    pub realisations: usize,
    /// Of these, realisations with the same counts in every cell.
    pub identical: usize,
    /// The largest distance of the sample's mean from that of all realisations, over all σ, in
    /// standard errors; of all cells.
    pub distance: f64,
    /// The distance that chance lets expect at most.
    pub allowed: f64,
}

/// What is audited: a change of it makes the saved audit stale.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AuditParams {
    /// SHA-256 of the committed file.
    pub committed: String,
    /// Realisations of each σ that are run again.
    pub sample: usize,
    /// Of the values of σ, only each of so many, from the first.
    pub every: usize,
}

impl AuditParams {
    /// Of the committed file, as much of it as a profile has time for.
    pub fn of_committed(profile: Profile) -> Self {
        let digest = Sha256::digest(COMMITTED.as_bytes());
        let committed = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        let (sample, every) = match profile {
            Profile::Quick => (1, 6),
            Profile::Ci => (1, 2),
            Profile::Full | Profile::Deep => (SAMPLE, 1),
        };
        AuditParams { committed, sample, every }
    }

    /// Its work in impacts, roughly.
    pub fn weight(&self) -> u64 {
        let Ok((_, long)) = &*SAVED else { return 1 };
        let parameters = &long.map.parameters;
        let run = |(row, _): &(&LongRow, u64)| {
            weights::run(&parameters.chain, row.sigma, protocol::until(parameters, row.sigma))
        };
        self.of(long).iter().map(run).sum()
    }

    /// The rows with the realisations that are run again.
    fn of<'a>(&self, long: &'a LongMap) -> Vec<(&'a LongRow, u64)> {
        let rows = long.rows.iter().step_by(self.every.max(1));
        rows.flat_map(|row| (0..row.sample.len().min(self.sample)).map(move |i| (row, i as u64)))
            .collect()
    }
}

/// The committed result with what it was made of, or why it cannot be read.
static SAVED: LazyLock<Result<(Identity, LongMap), String>> = LazyLock::new(|| {
    let (identity, body) = store::parsed(COMMITTED).map_err(|reasons| told(&reasons))?;
    let long = serde_json::from_str(body).map_err(|error| error.to_string())?;
    Ok((identity, long))
});

fn saved() -> Result<&'static (Identity, LongMap), Error> {
    SAVED.as_ref().map_err(|what| Error::input(FILE, what.clone(), REMEDY))
}

/// Runs the sample again.
///
/// # Errors
/// [`Error::Interrupted`]; [`Error::Input`] if the committed file cannot be read.
pub fn audit(parameters: &AuditParams, progress: &Progress) -> Result<Audit, Error> {
    let (_, long) = saved()?;
    let chain = &long.map.parameters;
    let stage = progress.stage("audit of the long map", parameters.weight());
    let runs = parameters.of(long);
    let again: Vec<Option<Counts>> = runs
        .par_iter()
        .with_max_len(1)
        .map(|&(row, index)| {
            let until = protocol::until(chain, row.sigma);
            let counts = protocol::realisation(chain, row.sigma, index, until, progress);
            stage.advance(weights::run(&chain.chain, row.sigma, until));
            counts
        })
        .collect::<Result<_, _>>()?;
    Ok(judged(&runs, &again))
}

/// Compares what was run again with what was saved.
fn judged(runs: &[(&LongRow, u64)], again: &[Option<Counts>]) -> Audit {
    let same = |((row, index), again): &(&(&LongRow, u64), &Option<Counts>)| {
        row.sample.get(*index as usize) == Some(again)
    };
    let identical = runs.iter().zip(again).filter(same).count();
    let cells = runs.first().map_or(0, |(row, _)| row.means.len());
    let distance = (0..cells).map(|cell| distance(runs, again, cell)).fold(0.0, f64::max);
    // Bonferroni's correction: one cell of so many may be far by chance.
    let allowed = normal_quantile(1.0 - (1.0 - LEVEL) / cells.max(1) as f64);
    let realisations = runs.len();
    let verdict = match () {
        () if identical == realisations && again.len() == realisations => Verdict::Identical,
        () if distance <= allowed => Verdict::WithinError,
        () => Verdict::Failed,
    };
    Audit { verdict, realisations, identical, distance, allowed }
}

/// How far the sum of the counts in one cell is from what the means of all realisations let
/// expect, in standard deviations of that sum.
fn distance(runs: &[(&LongRow, u64)], again: &[Option<Counts>], cell: usize) -> f64 {
    let (mut excess, mut variance) = (0.0, 0.0);
    for ((row, _), counts) in runs.iter().zip(again) {
        let count = counts.as_ref().and_then(|counts| counts.get(cell).copied().flatten());
        if let (Some(count), Some(mean), Some(deviation)) =
            (count, row.means[cell], row.deviations[cell])
        {
            excess += f64::from(count) - mean;
            variance += deviation * deviation;
        }
    }
    match () {
        () if variance > 0.0 => excess.abs() / variance.sqrt(),
        () if excess == 0.0 => 0.0,
        // No realisation departs from any other: nor may this one.
        () => f64::MAX,
    }
}

/// The committed result with its audit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Carried {
    /// The map.
    pub map: ProtocolMap,
    /// For each σ.
    pub rows: Vec<LongRow>,
    /// What became of a sample.
    pub audit: Audit,
}

/// The committed result, with an audit of it.
///
/// # Errors
/// [`Error::Input`] if the committed file cannot be read, or was run with other parameters than
/// those of this program.
pub fn carried(audit: Audit, now: &Identity) -> Result<Carried, Error> {
    let (made_of, long) = saved()?;
    let reasons = now.reasons(made_of);
    if reasons.iter().all(Reason::is_of_source) {
        return Ok(Carried { map: long.map.clone(), rows: long.rows.clone(), audit });
    }
    Err(Error::input(FILE, told(&reasons), REMEDY))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Grid;

    fn small() -> LongMap {
        let mut parameters = ProtocolParams::long(Profile::Quick);
        parameters.chain.masses = 12;
        parameters.transients = vec![50.0, 100.0];
        parameters.windows = vec![20.0, 50.0];
        parameters.sigmas = Grid::default().and(12, 20, 4, 100).values();
        parameters.realisations = 8;
        CUTTING.run(&parameters, "test", &Progress::silent()).unwrap()
    }

    #[test]
    fn an_audit_tells_the_same_from_the_likely_and_the_wrong() {
        let long = small();
        let runs = AuditParams::of_committed(Profile::Full).of(&long);
        let same: Vec<_> = long.rows.iter().flat_map(|row| row.sample.clone()).collect();
        let audit = judged(&runs, &same);
        assert_eq!((audit.verdict, audit.identical), (Verdict::Identical, 6));

        // Another realisation of the same ensemble is none that was saved, and not far.
        let mut likely = same.clone();
        let other = likely.iter().position(|counts| *counts != likely[5]).unwrap();
        likely.swap(other, 5);
        let audit = judged(&runs, &likely);
        assert_eq!((audit.verdict, audit.identical), (Verdict::WithinError, 4));

        // Every gap of every realisation: no chance does that.
        let gaps = long.map.parameters.chain.gaps() as u32;
        let all = |counts: &Counts| vec![Some(gaps); counts.len()];
        let wrong: Vec<_> = same.iter().map(|counts| counts.as_ref().map(all)).collect();
        assert_eq!(judged(&runs, &wrong).verdict, Verdict::Failed);
        assert_eq!(judged(&runs, &same[1..]).identical, 0);
        assert_ne!(judged(&runs, &same[..5]).verdict, Verdict::Identical);
    }

    #[test]
    fn realisations_are_run_again_as_they_were() {
        let long = small();
        let parameters = &long.map.parameters;
        for (profile, number) in [(Profile::Quick, 1), (Profile::Ci, 2), (Profile::Full, 6)] {
            let runs = AuditParams::of_committed(profile).of(&long);
            assert_eq!(runs.len(), number);
            for (row, index) in runs {
                let until = protocol::until(parameters, row.sigma);
                assert_eq!(until, 150.0);
                let again =
                    protocol::realisation(parameters, row.sigma, index, until, &Progress::silent());
                assert_eq!(again.unwrap(), row.sample[index as usize]);
            }
        }
    }
}
