//! Experiments that are cut into units of work, which may run anywhere and in any order.
//!
//! Such an experiment has rows (each σ of an ensemble, say), and each row has realisations. A unit
//! is a row's realisations from one number to another; where the cuts are follows from the
//! parameters alone, never from the number of machines. A result is joined of all units, whoever
//! ran them: that is why several machines give the same bytes as one.

use super::progress::Stage;
use super::{Error, Progress};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Work that a core does in about a second.
pub const WORK_PER_SECOND: u64 = 4_800_000;

/// The most work of a unit, a fifth of a second of one core, where [`MOST_UNITS`] allows it.
const HEAVIEST_UNIT: u64 = 1_000_000;

/// About the most units of an experiment, each of which has a file.
const MOST_UNITS: u64 = 2000;

/// The realisations of one row, and their work.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitRow {
    /// How many realisations it has.
    pub realisations: usize,
    /// Work of one realisation: a core does [`WORK_PER_SECOND`] in about a second.
    pub work_of_one: u64,
    /// How many realisations are best run together: no unit has fewer, if there are as many.
    pub group_size: usize,
}

impl UnitRow {
    /// Work of all its realisations.
    pub fn work(&self) -> u64 {
        self.work_of_one.saturating_mul(self.realisations as u64)
    }
}

/// Some realisations of one row: what is run, saved and joined as a whole.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unit {
    /// Its place among all units.
    pub number: usize,
    /// Place of its row.
    pub row: usize,
    /// Which realisations of its row these are.
    pub realisations: Range<usize>,
    /// Work of these realisations.
    pub work: u64,
}

impl Unit {
    /// Returns the only unit of an experiment that is not cut.
    pub fn whole(work: u64) -> Unit {
        Unit { number: 0, row: 0, realisations: 0..0, work }
    }

    /// Runs its realisations in groups of `group_size`, in any order and on any thread, and
    /// advances the stage after each group.
    pub fn run_in_groups<R: Send>(
        &self,
        group_size: usize,
        stage: &Stage,
        run: impl Fn(Range<u64>) -> Result<R, Error> + Sync,
    ) -> Result<Vec<R>, Error> {
        let Range { start, end } = self.realisations;
        let work_of_one = self.work / self.realisations.len().max(1) as u64;
        let group = |first| {
            let group = first as u64..end.min(first + group_size) as u64;
            let number = group.end - group.start;
            let found = run(group);
            stage.advance(number * work_of_one);
            found
        };
        let firsts: Vec<usize> = (start..end).step_by(group_size.max(1)).collect();
        firsts.into_par_iter().with_max_len(1).map(group).collect()
    }
}

/// Joins the parts U of each row, in the order of its units, to a result T.
pub type Join<P, U, T> = fn(&P, Vec<Vec<U>>, &Progress) -> Result<T, Error>;

/// How an experiment with parameters P is cut into parts U and joined to a result T.
pub struct Cutting<P, U, T> {
    /// The rows, in their order.
    pub rows: fn(&P) -> Vec<UnitRow>,
    /// Runs realisations of a row, and advances the stage by the work of each.
    pub run_unit: fn(&P, &Unit, &Stage, &Progress) -> Result<U, Error>,
    /// Joins the parts to the result.
    pub join: Join<P, U, T>,
}

impl<P, U, T> Cutting<P, U, T> {
    /// All units: row by row, realisation by realisation.
    pub fn units(&self, parameters: &P) -> Vec<Unit> {
        let rows = (self.rows)(parameters);
        let all = rows.iter().map(UnitRow::work).fold(0, u64::saturating_add);
        let heaviest = HEAVIEST_UNIT.max(all / MOST_UNITS);
        let units = rows.iter().enumerate().flat_map(|(place, row)| cut(place, row, heaviest));
        units.enumerate().map(|(number, unit)| Unit { number, ..unit }).collect()
    }

    /// Runs all units and joins them; nothing is saved.
    pub fn run(&self, parameters: &P, name: &str, progress: &Progress) -> Result<T, Error>
    where
        P: Sync,
        U: Send,
    {
        let units = self.units(parameters);
        let stage = progress.stage(name, units.iter().map(|unit| unit.work).sum());
        let run_unit = |unit: &Unit| (self.run_unit)(parameters, unit, &stage, progress);
        let parts: Result<Vec<U>, Error> = units.par_iter().with_max_len(1).map(run_unit).collect();
        self.join_parts(parameters, &units, parts?, progress)
    }

    /// Joins the parts of all units, in their order, to a result.
    pub fn join_parts(
        &self,
        parameters: &P,
        units: &[Unit],
        parts: Vec<U>,
        progress: &Progress,
    ) -> Result<T, Error> {
        progress.check()?;
        let mut rows: Vec<Vec<U>> = (self.rows)(parameters).iter().map(|_| Vec::new()).collect();
        for (unit, part) in units.iter().zip(parts) {
            rows[unit.row].push(part);
        }
        (self.join)(parameters, rows, progress)
    }
}

/// Cuts a row into the fewest pieces of about equal size of which none has more work than `most`.
fn cut(place: usize, row: &UnitRow, most: u64) -> Vec<Unit> {
    let all = row.realisations;
    let groups = (all / row.group_size.max(1)).max(1) as u64;
    let pieces = row.work().div_ceil(most).clamp(1, groups);
    let at = |piece: u64| (all as u128 * u128::from(piece) / u128::from(pieces)) as usize;
    (0..pieces)
        .map(|piece| {
            let realisations = at(piece)..at(piece + 1);
            let work = row.work_of_one.saturating_mul(realisations.len() as u64);
            Unit { number: 0, row: place, realisations, work }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_realisation_is_in_one_unit() {
        for (realisations, work_of_one) in
            [(1, 1), (1000, 19_000), (7, 400_000), (3, 5_000_000), (10, 0)]
        {
            let row = UnitRow { realisations, work_of_one, group_size: 1 };
            let units = cut(4, &row, HEAVIEST_UNIT);
            let all: Vec<usize> = units.iter().flat_map(|unit| unit.realisations.clone()).collect();
            assert_eq!(all, (0..realisations).collect::<Vec<_>>());
            assert!(units.iter().all(|unit| !unit.realisations.is_empty() && unit.row == 4));
            let most = HEAVIEST_UNIT + work_of_one;
            let light = |unit: &Unit| unit.realisations.len() == 1 || unit.work <= most;
            assert!(units.iter().all(light), "{units:?}");
        }
        let row = UnitRow { realisations: 100, work_of_one: 1, group_size: 1 };
        assert_eq!(cut(0, &row, HEAVIEST_UNIT).len(), 1);
    }

    #[test]
    fn a_billion_realisations_are_thousands_of_units() {
        let cutting: Cutting<u64, (), ()> = Cutting {
            rows: |&number| {
                let realisations = number as usize;
                let row = |work_of_one| UnitRow { realisations, work_of_one, group_size: 1 };
                [100, 7000, 20_000].map(row).to_vec()
            },
            run_unit: |_, _, _, _| Ok(()),
            join: |_, _, _| Ok(()),
        };
        assert_eq!(cutting.units(&300).len(), 1 + 3 + 6);
        let many = cutting.units(&300_000_000);
        assert!((1900..2100).contains(&many.len()), "{}", many.len());
        assert_eq!(many.iter().map(|unit| unit.realisations.len()).sum::<usize>(), 900_000_000);
    }
}
