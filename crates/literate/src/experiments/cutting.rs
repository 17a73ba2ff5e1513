//! Experiments that are cut into units of work, which may run anywhere and in any order.
//!
//! Such an experiment has rows (each σ of an ensemble, say), and each row has realisations. A unit
//! is a row's realisations from one number to another; where the cuts are follows from the
//! parameters alone, never from the number of machines. One machine runs all units and joins what
//! they give, several machines do the same: that is why they give the same bytes.

use super::progress::Stage;
use super::{Error, Progress};
use rayon::prelude::*;
use std::ops::Range;

/// No unit is meant to weigh more than this many impacts: half a second of one core ...
const HEAVY: u64 = 1_000_000;

/// ... unless an experiment had then more units than about this many: each has a file.
const MANY: u64 = 2000;

/// One row of an experiment.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What it is about: `sigma = 0.12`.
    pub covers: String,
    /// Number of realisations.
    pub realisations: usize,
    /// Work of one realisation, in impacts.
    pub weight: u64,
}

impl Row {
    /// Work of all its realisations, in impacts.
    pub fn work(&self) -> u64 {
        self.weight.saturating_mul(self.realisations as u64)
    }
}

/// Some realisations of one row: what is run, saved and joined as a whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// Place of its row.
    pub row: usize,
    /// Its realisations.
    pub realisations: Range<usize>,
    /// What its row is about.
    pub covers: String,
    /// Its work, in impacts.
    pub weight: u64,
}

impl Unit {
    /// Where rows are those of several lists of these lengths, one list after another: the place of
    /// the list that has its row, and the unit as one of that list.
    pub fn within(&self, lengths: impl IntoIterator<Item = usize>) -> Option<(usize, Unit)> {
        let mut row = self.row;
        for (place, length) in lengths.into_iter().enumerate() {
            match row.checked_sub(length) {
                Some(rest) => row = rest,
                None => return Some((place, Unit { row, ..self.clone() })),
            }
        }
        None
    }

    /// Runs its realisations, in any order and on any thread, and advances the stage after each.
    pub fn each<R: Send>(
        &self,
        stage: &Stage,
        run: impl Fn(u64) -> Result<R, Error> + Sync,
    ) -> Result<Vec<R>, Error> {
        let weight = self.weight / self.realisations.len().max(1) as u64;
        let one = |index| {
            let found = run(index as u64);
            stage.advance(weight);
            found
        };
        self.realisations.clone().into_par_iter().with_max_len(1).map(one).collect()
    }
}

/// Makes a result T of parts U, for each row those of its units in order.
pub type Join<P, U, T> = fn(&P, Vec<Vec<U>>, &Progress) -> Result<T, Error>;

/// How an experiment with parameters P is cut into parts U and joined to a result T.
pub struct Cutting<P, U, T> {
    /// The rows, in their order.
    pub rows: fn(&P) -> Vec<Row>,
    /// Runs realisations of a row, and advances the stage by the row's weight for each.
    pub part: fn(&P, &Unit, &Stage, &Progress) -> Result<U, Error>,
    /// Whether what was read from a file can be the part of a unit.
    pub fits: fn(&P, &Unit, &U) -> bool,
    /// Makes the result.
    pub join: Join<P, U, T>,
}

impl<P: Sync, U: Send, T> Cutting<P, U, T> {
    /// All units: row by row, realisation by realisation.
    pub fn units(&self, parameters: &P) -> Vec<Unit> {
        let rows = (self.rows)(parameters);
        let all = rows.iter().map(Row::work).fold(0, u64::saturating_add);
        let heavy = HEAVY.max(all / MANY);
        rows.iter().enumerate().flat_map(|(place, row)| cut(place, row, heavy)).collect()
    }

    /// Runs all units and joins them.
    pub fn run(&self, parameters: &P, name: &str, progress: &Progress) -> Result<T, Error> {
        let units = self.units(parameters);
        let stage = progress.stage(name, units.iter().map(|unit| unit.weight).sum());
        // Units share the cores with the realisations inside them.
        let part = |unit: &Unit| (self.part)(parameters, unit, &stage, progress);
        let parts: Vec<U> =
            units.par_iter().with_max_len(1).map(part).collect::<Result<_, Error>>()?;
        self.joined(parameters, parts, progress)
    }

    /// The result of the parts of all units, in order.
    pub fn joined(&self, parameters: &P, parts: Vec<U>, progress: &Progress) -> Result<T, Error> {
        progress.check()?;
        let mut rows: Vec<Vec<U>> = (self.rows)(parameters).iter().map(|_| Vec::new()).collect();
        for (unit, part) in self.units(parameters).into_iter().zip(parts) {
            rows[unit.row].push(part);
        }
        (self.join)(parameters, rows, progress)
    }
}

/// Cuts a row into the fewest pieces of about equal size of which none is heavy.
fn cut(place: usize, row: &Row, heavy: u64) -> Vec<Unit> {
    let all = row.realisations;
    let pieces = row.work().div_ceil(heavy).clamp(1, all.max(1) as u64);
    let at = |piece: u64| (all as u128 * u128::from(piece) / u128::from(pieces)) as usize;
    (0..pieces)
        .map(|piece| {
            let realisations = at(piece)..at(piece + 1);
            let weight = row.weight.saturating_mul(realisations.len() as u64);
            Unit { row: place, realisations, covers: row.covers.clone(), weight }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_realisation_is_in_one_unit() {
        for (realisations, weight) in
            [(1, 1), (1000, 19_000), (7, 400_000), (3, 5_000_000), (10, 0)]
        {
            let row = Row { covers: "sigma = 0.1".into(), realisations, weight };
            let units = cut(4, &row, HEAVY);
            let all: Vec<usize> = units.iter().flat_map(|unit| unit.realisations.clone()).collect();
            assert_eq!(all, (0..realisations).collect::<Vec<_>>());
            assert!(units.iter().all(|unit| !unit.realisations.is_empty() && unit.row == 4));
            let light = |unit: &Unit| unit.realisations.len() == 1 || unit.weight <= HEAVY + weight;
            assert!(units.iter().all(light), "{units:?}");
        }
        let row = Row { covers: String::new(), realisations: 100, weight: 1 };
        assert_eq!(cut(0, &row, HEAVY).len(), 1);
    }

    #[test]
    fn rows_of_lists_one_after_another() {
        let unit = |row| Unit { row, realisations: 3..5, covers: "here".into(), weight: 7 };
        let found = |row| unit(row).within([2, 0, 3]);
        assert_eq!(found(1), Some((0, unit(1))));
        assert_eq!(found(2), Some((2, unit(0))));
        assert_eq!(found(4), Some((2, unit(2))));
        assert_eq!(found(5), None);
    }

    #[test]
    fn a_billion_realisations_are_thousands_of_units() {
        let cutting: Cutting<u64, (), ()> = Cutting {
            rows: |&realisations| {
                let row = |weight| Row {
                    covers: String::new(),
                    realisations: realisations as usize,
                    weight,
                };
                [100, 7000, 20_000].map(row).to_vec()
            },
            part: |_, _, _, _| Ok(()),
            fits: |_, _, ()| true,
            join: |_, _, _| Ok(()),
        };
        assert_eq!(cutting.units(&300).len(), 1 + 3 + 6);
        let many = cutting.units(&300_000_000);
        assert!((1900..2100).contains(&many.len()), "{}", many.len());
        assert_eq!(many.iter().map(|unit| unit.realisations.len()).sum::<usize>(), 900_000_000);
    }
}
