//! The numerical simulations of Sec. 2: ensembles over σ (Figs. 2, 3, 12 and 15).
//!
//! All cores share the realisations; what they show is collected in the order of the realisations
//! and reduced by one thread, so neither the number of threads nor that of machines changes a bit.

pub mod laws;
pub mod tables;

use super::rise::{Resampled, Rise};
use super::tally::{Tally, realisation};
use super::{Error, Progress, weights};
use crate::params::{COMPARABLE_REJECTED, Protocol, SweepParams};
use impact_chain::observe::{NEAR_DECADES, SLOW_DECADES};
use impact_numerics::statistics as stat;
use literate::experiments::cutting::{Cutting, Row, Unit};
use literate::experiments::progress::Stage;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// An ensemble over σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// What was run.
    pub parameters: SweepParams,
    /// One row for each σ, rising.
    pub rows: Vec<SweepRow>,
    /// Where the rise is, read from the comparable rows.
    pub rise: Rise,
}

/// The ensemble at one σ. Means, mode and quantiles are of the number of distinct gaps that
/// impact in the window; "kept" are the realisations with at least one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SweepRow {
    /// Standard deviation σ of the amplitudes.
    pub sigma: f64,
    /// Realisations drawn: kept, without impact in the window, rejected and failed.
    pub realisations: usize,
    /// With at least one impact in the window.
    pub kept: usize,
    /// With an overlapping start.
    pub rejected: usize,
    /// Ended by the engine before T + W.
    pub failed: usize,
    /// What the engine said of the first failed one.
    pub first_failure: Option<String>,
    /// Whether few enough were rejected for the row to be compared with others.
    pub comparable: bool,
    /// Mean of the kept.
    pub mean_distinct: Option<f64>,
    /// Standard error of that mean.
    pub standard_error: Option<f64>,
    /// Bootstrap interval of that mean.
    pub mean_interval: Option<[f64; 2]>,
    /// Mean of all that ran, those without impact included.
    pub mean_all: Option<f64>,
    /// Bootstrap interval of that mean.
    pub mean_all_interval: Option<[f64; 2]>,
    /// Mode of the kept; of several the lowest.
    pub mode_distinct: Option<usize>,
    /// Bootstrap interval of the mode.
    pub mode_interval: Option<[usize; 2]>,
    /// Impacts in the window: mean of the kept, and its standard error.
    pub impacts_in_window: Option<[f64; 2]>,
    /// Masses hit in the window: mean of the kept, and its standard error.
    pub masses_hit: Option<[f64; 2]>,
    /// Impacts per unit time and kept realisation, in the window.
    pub impacts_per_time: Option<f64>,
    /// All impacts simulated, transient and failed realisations included.
    pub impacts: u64,
    /// Of these, impacts within [`crate::params::NEAR_SIMULTANEOUS`] of one of an adjacent gap.
    pub near_simultaneous: u64,
    /// Of these, impacts with a closing speed below [`crate::params::SLOW`].
    pub slow: u64,
    /// Contact phases begun.
    pub contact_phases: u64,
    /// Impacts that follow one of an adjacent gap within each δ of [`NEAR_DECADES`].
    pub near_decades: Vec<u64>,
    /// Impacts with a closing speed below each v of [`SLOW_DECADES`].
    pub slow_decades: Vec<u64>,
    /// Realisations that ran, by their number of distinct gaps k = 0..=N.
    pub counts: Vec<u32>,
}

/// One σ: the row without its bootstrap intervals, and the count of each realisation (none if it
/// did not run to the end).
#[derive(Clone, Debug)]
pub struct Sample {
    /// The row.
    pub row: SweepRow,
    /// Distinct gaps of each realisation.
    pub distinct: Vec<Option<u32>>,
}

/// The ensemble in units of work.
pub const CUTTING: Cutting<SweepParams, Tally, Sweep> = Cutting { rows, part, fits, join };

/// Runs the ensemble over all σ.
pub fn run(parameters: &SweepParams, name: &str, progress: &Progress) -> Result<Sweep, Error> {
    CUTTING.run(parameters, name, progress)
}

/// A row for each σ.
pub fn rows(parameters: &SweepParams) -> Vec<Row> {
    let row = |&sigma: &f64| Row {
        covers: format!("sigma = {sigma}"),
        realisations: parameters.realisations_at(sigma),
        weight: weight(parameters, sigma),
    };
    parameters.sigmas.iter().map(row).collect()
}

/// Runs some realisations of one σ.
pub fn part(
    parameters: &SweepParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Tally, Error> {
    tally(parameters, parameters.sigmas[unit.row], unit.realisations.clone(), stage, progress)
}

/// Whether a tally can be that of a unit.
pub fn fits(parameters: &SweepParams, unit: &Unit, tally: &Tally) -> bool {
    tally.can_be(unit.realisations.len(), parameters.chain.gaps())
}

/// Reduces the tallies of each σ, and finds the rise.
pub fn join(
    parameters: &SweepParams,
    tallies: Vec<Vec<Tally>>,
    progress: &Progress,
) -> Result<Sweep, Error> {
    let mut rows = Vec::with_capacity(parameters.sigmas.len());
    let mut counts = Vec::with_capacity(parameters.sigmas.len());
    for (&sigma, tallies) in parameters.sigmas.iter().zip(tallies) {
        let Sample { row, distinct } = reduce(parameters, sigma, Tally::joined(tallies));
        // A row of which many starts overlapped is shown, but no place is read from it.
        counts.push(if row.comparable { distinct } else { vec![None; distinct.len()] });
        rows.push(row);
    }
    progress.check()?;
    let gaps = parameters.chain.gaps();
    let found = Resampled::of(&parameters.sigmas, &counts, gaps, parameters.seed);
    let (rise, intervals) = (found.rise(), found.intervals());
    for (row, interval) in rows.iter_mut().zip(intervals) {
        row.mean_interval = interval.mean_kept;
        row.mean_all_interval = interval.mean_all;
        row.mode_interval = interval.mode;
    }
    Ok(Sweep { parameters: parameters.clone(), rows, rise })
}

/// Work of one realisation.
fn weight(parameters: &SweepParams, sigma: f64) -> u64 {
    let Protocol { transient, window } = parameters.protocol;
    weights::run(&parameters.chain, sigma, transient + window)
}

/// Units of work of all σ, for the stage that [`at`] advances.
pub fn work(parameters: &SweepParams) -> u64 {
    rows(parameters).iter().map(Row::work).fold(0, u64::saturating_add)
}

/// Runs the ensemble at one σ, without bootstrap.
pub fn at(
    parameters: &SweepParams,
    sigma: f64,
    stage: &Stage,
    progress: &Progress,
) -> Result<Sample, Error> {
    let tally = tally(parameters, sigma, 0..parameters.realisations_at(sigma), stage, progress)?;
    Ok(reduce(parameters, sigma, tally))
}

/// Runs realisations at one σ.
fn tally(
    parameters: &SweepParams,
    sigma: f64,
    realisations: Range<usize>,
    stage: &Stage,
    progress: &Progress,
) -> Result<Tally, Error> {
    let weight = weight(parameters, sigma);
    let outcomes: Vec<_> = realisations
        .into_par_iter()
        .with_max_len(1)
        .map(|index| {
            let key = (parameters.stream.as_str(), parameters.seed, index as u64);
            let outcome = realisation(&parameters.chain, parameters.protocol, sigma, key, progress);
            stage.advance(weight);
            outcome
        })
        .collect::<Result<_, _>>()?;
    Ok(outcomes.iter().collect())
}

/// Reduces the tally of one σ.
pub(crate) fn reduce(parameters: &SweepParams, sigma: f64, tally: Tally) -> Sample {
    let Tally { distinct, kept_impacts, kept_masses, rejected, failed, first_failure, total } =
        tally;
    let mut counts = vec![0; parameters.chain.gaps() + 1];
    distinct.iter().flatten().for_each(|&k| counts[k as usize] += 1);
    let ran: Vec<f64> = distinct.iter().flatten().map(|&k| f64::from(k)).collect();
    let kept: Vec<f64> = ran.iter().copied().filter(|&k| k > 0.0).collect();
    let mut kept_counts = counts.clone();
    kept_counts[0] = 0;
    let time = kept.len() as f64 * parameters.protocol.window;
    let row = SweepRow {
        sigma,
        realisations: distinct.len(),
        kept: kept.len(),
        rejected,
        failed,
        first_failure,
        comparable: rejected as f64 <= COMPARABLE_REJECTED * distinct.len() as f64,
        mean_distinct: stat::mean(&kept),
        standard_error: stat::standard_error(&kept),
        mean_interval: None,
        mean_all: stat::mean(&ran),
        mean_all_interval: None,
        mode_distinct: stat::mode(&kept_counts),
        mode_interval: None,
        // Realisations without impact add nothing to either sum.
        impacts_in_window: stat::mean_of_sums(kept.len(), kept_impacts),
        masses_hit: stat::mean_of_sums(kept.len(), kept_masses),
        impacts_per_time: (time > 0.0).then(|| kept_impacts[0] as f64 / time),
        impacts: total.impacts,
        near_simultaneous: total.near[NEAR_DECADES.len() - 1],
        slow: total.slow[SLOW_DECADES.len() - 1],
        contact_phases: total.contact_phases,
        near_decades: total.near.to_vec(),
        slow_decades: total.slow.to_vec(),
        counts,
    };
    Sample { row, distinct }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::tally::Outcome;
    use crate::params::{NEAR_SIMULTANEOUS, Profile, SLOW};
    use impact_chain;
    use impact_chain::observe::Observed;

    fn counted(distinct: u32, window_impacts: u64) -> Outcome {
        let impacts = 2 * window_impacts;
        let masses = distinct.saturating_sub(1);
        Outcome::Counted(Observed {
            distinct,
            masses,
            window_impacts,
            impacts,
            ..Observed::default()
        })
    }

    #[test]
    fn nothing_is_dropped_silently() {
        let mut parameters = SweepParams::main(Profile::Quick);
        parameters.chain.masses = 9;
        let error = impact_chain::Error::Work { gap: 3, time: 1.5, bound: 7 };
        let outcomes = [
            counted(0, 0),
            counted(4, 40),
            counted(10, 120),
            counted(4, 80),
            Outcome::Rejected,
            Outcome::Failed(Observed { impacts: 5, ..Observed::default() }, error.clone()),
        ];
        let Sample { row, distinct } = reduce(&parameters, 0.1, outcomes.iter().collect());
        assert_eq!(distinct, [Some(0), Some(4), Some(10), Some(4), None, None]);
        assert_eq!((row.realisations, row.kept, row.rejected, row.failed), (6, 3, 1, 1));
        assert_eq!(row.first_failure, Some(error.to_string()));
        assert!(!row.comparable, "one of six was rejected");
        assert_eq!((row.mean_distinct, row.mean_all), (Some(6.0), Some(4.5)));
        assert_eq!(row.standard_error, Some(2.0)); // s = √12, over √3
        assert_eq!(row.mode_distinct, Some(4));
        assert_eq!(row.impacts_per_time, Some(240.0 / (3.0 * 200.0)));
        assert_eq!(row.impacts_in_window, Some([80.0, (3200.0_f64 / 2.0 / 3.0).sqrt()]));
        assert_eq!(row.masses_hit, Some([5.0, 2.0]));
        assert_eq!(row.impacts, 485);
        assert_eq!(row.counts, [1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 1]);
    }

    #[test]
    fn of_nothing_kept_there_is_no_mean() {
        let parameters = SweepParams::main(Profile::Quick);
        let row = reduce(&parameters, 0.1, [counted(0, 0)].iter().collect()).row;
        assert_eq!((row.mean_distinct, row.mean_all), (None, Some(0.0)));
        assert_eq!((row.mode_distinct, row.impacts_per_time), (None, None));
    }

    #[test]
    fn the_last_decades_are_the_declared_limits() {
        assert_eq!(NEAR_DECADES.last(), Some(&NEAR_SIMULTANEOUS));
        assert_eq!(SLOW_DECADES.last(), Some(&SLOW));
    }
}
