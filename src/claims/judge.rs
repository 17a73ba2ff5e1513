//! Judges of statements: each computes from the results the check that is a row of the ledger.

pub(super) use super::Basis::{Exact, OurMeasure, PrintedDigit, Rounding};
use super::{Basis, Kind, Level, Published};
pub(super) use super::{Error, Judged, Statement, Text, chosen, integer, significant};
use crate::experiments::{Results, sweep};
use impact_chain::rise::Counted;
use impact_numerics::statistics::Estimate;
use literate::value::Number;

/// What a check may look at.
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a> {
    /// Results of the experiments.
    pub results: &'a Results,
    /// What the paper printed.
    pub published: &'a Published,
    /// The level of a statistical check.
    pub level: Level,
}

/// A result that small samples may not have: without it the verdict is undecided.
pub fn some<T>(found: Option<T>) -> Result<T, Error> {
    found.ok_or(Error::Undecided)
}

/// A number with its standard error.
pub fn estimate(found: &Estimate) -> Number {
    super::with_error(found.value, found.error)
}

impl<'a> Evidence<'a> {
    /// The number with this address.
    #[track_caller]
    pub fn number(&self, address: &str) -> Result<f64, Error> {
        Ok(self.results.number(address)?)
    }

    /// Several numbers of one row of a table.
    #[track_caller]
    pub fn numbers<const N: usize>(
        &self,
        row: &str,
        columns: [&str; N],
    ) -> Result<[f64; N], Error> {
        let mut found = [0.0; N];
        for (number, column) in found.iter_mut().zip(columns) {
            *number = self.number(&format!("{row}.{column}"))?;
        }
        Ok(found)
    }

    /// How many cases of a statement were compared, and in how many the paper is wrong.
    pub fn cases(&self, s: &Statement) -> Result<[usize; 2], Error> {
        let found =
            self.numbers(&format!("theory.cases[statement={}]", s.id), ["compared", "failed"]);
        Ok(found?.map(|count| count as usize))
    }

    /// The largest difference between the two sides of a statement.
    pub fn difference(&self, s: &Statement) -> Result<f64, Error> {
        self.number(&format!("theory.differences[statement={}].largest", s.id))
    }

    /// The main sweep.
    pub fn sweep(&self) -> Result<&'a Counted, Error> {
        Ok(sweep::main(self.results)?)
    }

    /// Number of gaps N of the swept chain.
    pub fn gaps(&self) -> Result<f64, Error> {
        Ok(self.sweep()?.ensemble.chain.gaps() as f64)
    }

    /// Half a unit of the last digit in which the paper prints the threshold.
    pub fn half_unit(&self) -> Result<f64, Error> {
        Ok(self.published.statement("sec2_half_height")?.half_unit())
    }
}

/// A tolerance to both sides.
pub fn plus_minus(half: f64) -> Text {
    Text::of("± {}", [significant(half, 1)])
}

/// A check of a statement before it is computed.
pub struct Judge {
    /// Id of the statement that it judges.
    pub id: &'static str,
    /// What its verdict rests on.
    pub basis: Basis,
    /// The printed words or formula that it judges, where a number alone is not enough: other words are refused. `{}`
    /// stands for the number.
    pub reads: Option<&'static str>,
    /// Whether it compares random numbers within their standard errors.
    pub statistical: bool,
    /// Its note, where that does not depend on results.
    note: &'static str,
    find: fn(&Evidence, &Statement) -> Judged,
}

/// A statement that is judged by this function; its tolerance has no room for standard errors.
pub const fn by(
    id: &'static str,
    basis: Basis,
    find: fn(&Evidence, &Statement) -> Judged,
) -> Judge {
    Judge { id, basis, reads: None, statistical: false, note: "", find }
}

/// A definition, which this edition uses as it stands: nothing is computed.
pub const fn defined(id: &'static str) -> Judge {
    by(id, Exact, |_, s| Ok(s.found("used as it stands", s.kind == Kind::Definition)))
}

/// A statement whose tolerance has room for standard errors.
pub const fn statistical(
    id: &'static str,
    basis: Basis,
    find: fn(&Evidence, &Statement) -> Judged,
) -> Judge {
    Judge { statistical: true, ..by(id, basis, find) }
}

/// A statement about the theory that is judged by the number of cases in which it fails.
pub const fn cases(id: &'static str, note: &'static str) -> Judge {
    let find = |e: &Evidence, s: &Statement| {
        let [all, failed] = e.cases(s)?;
        Ok(s.all_cases(all, failed))
    };
    Judge { note, ..by(id, Exact, find) }
}

/// A statement about the theory that is an equality of real numbers, to 1e−13.
pub const fn difference(id: &'static str, note: &'static str) -> Judge {
    Judge { note, ..by(id, Rounding, |e, s| Ok(s.rounding(e.difference(s)?, 1e-13))) }
}

impl Judge {
    /// Sets the words or formula that it judges.
    pub const fn of(self, reads: &'static str) -> Self {
        Judge { reads: Some(reads), ..self }
    }

    /// Computes the check.
    ///
    /// # Errors
    /// If the printed statement is not the one that it judges, or a result was not run.
    pub fn check(&self, e: &Evidence) -> Judged {
        let s = e.published.statement(self.id)?;
        let number = s.value.map(|x| format!("{x:.*}", usize::from(s.decimals)));
        let number = number.unwrap_or_default();
        let reads = self.reads.map(|reads| reads.replace("{}", &number));
        if let Some(reads) = reads.filter(|reads| *reads != s.printed) {
            return Err(e.published.unread(self.id, &reads).into());
        }
        let found = (self.find)(e, s);
        let found =
            found.map(|found| if self.note.is_empty() { found } else { found.note(self.note) });
        Ok(s.decided(found)?.on(self.basis))
    }
}
