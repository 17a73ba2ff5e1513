//! Gives a rule what it may look at, and starts its check.
//!
//! ```
//! # use literate::claims::{Check, Evidence};
//! # let _: [fn(&Evidence<'_>) -> Check; 3] = [
//! |e| e.cell("cascade.limit.delta"), // rounds to what was printed
//! |e| e.cell("walk.fit.slope").within_errors(), // differs by some standard errors at most
//! |e| e.cell("walk.fit.onset").near(0.01, "ours: a hundredth").explained("too few steps", true),
//! # ];
//! ```

use super::check::{Basis, Check, Compared};
use super::level::Level;
use super::published::{Published, PublishedError, Statement};
use super::text::{Text, decimals, integer, significant};
use crate::experiments::{self, Results};
use crate::table::{self, Missing};
use crate::value::{Number, Value};
use impact_numerics::statistics::Estimate;

/// Why a check could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file of statements and the rules do not fit together.
    #[error(transparent)]
    Published(#[from] PublishedError),
    /// A result is missing.
    #[error(transparent)]
    Experiment(#[from] experiments::Error),
    /// The samples are too small for what is asked: the statement cannot be judged.
    #[error("the results do not decide it")]
    Undecided,
    #[error("check {id}: {error}")]
    Check { id: String, error: Box<Error> },
    #[error("a number of it is {0}; correct it, or return `Undecided` where there is none")]
    NotFinite(Text),
    /// A rule that needs the number of statistical checks does not count as one of them.
    #[error("the rule of {0} allows for standard errors; add `.statistical()` to it")]
    NotStatistical(String),
}

impl Error {
    /// Returns what went wrong in a check.
    pub(crate) fn cause(&self) -> &Error {
        match self {
            Error::Check { error, .. } => error,
            error => error,
        }
    }
}

impl From<Missing> for Error {
    fn from(missing: Missing) -> Error {
        experiments::Error::from(missing).into()
    }
}

/// A check, or why there is none.
pub type Judged = Result<Check, Error>;

impl From<Check> for Judged {
    fn from(check: Check) -> Judged {
        Ok(check)
    }
}

/// What a rule may look at: its statement, the results, and all that was printed.
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a> {
    pub statement: &'a Statement,
    pub results: &'a Results,
    pub published: &'a Published,
    /// None for a rule that is not statistical.
    pub(super) level: Option<Level>,
}

impl Evidence<'_> {
    /// Returns the level of each statistical check.
    ///
    /// # Errors
    /// [`Error::NotStatistical`] if the rule is not a statistical one.
    pub fn level(&self) -> Result<Level, Error> {
        self.level.ok_or_else(|| Error::NotStatistical(self.statement.id.clone()))
    }

    /// Returns the number with an address.
    ///
    /// # Errors
    /// [`Error::Undecided`] if the sample is too small for this number.
    #[track_caller]
    pub fn number(&self, address: &str) -> Result<f64, Error> {
        let cell = table::cell(self.results.tables()?, address)?;
        table::number(cell).ok_or(Error::Undecided)
    }

    /// Returns several numbers of one row of a table, `theory.jump` or `theory.gap[sigma=0.2]`.
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

    /// Returns the [number](Self::number) with an address and its standard error; the interval is
    /// one error to each side.
    #[track_caller]
    pub fn estimate(&self, address: &str) -> Result<Estimate, Error> {
        let value = self.number(address)?;
        let error = table::cell(self.results.tables()?, address)?.standard_error();
        Ok(Estimate { value, error, interval: [value - error, value + error] })
    }

    /// Compares a cell with the printed number, to which it has to round, with room for its
    /// standard error if it has one; [`Check::within_errors`] and [`Check::near`] ask for something
    /// else.
    #[track_caller]
    pub fn cell(&self, address: &str) -> Check {
        let statement = self.statement;
        let (mut cell, mut missing) = (None, None);
        // `judge_all` has refused the others.
        if let Ok(tables) = self.results.tables() {
            match table::cell(tables, address) {
                Ok(found) => cell = Some(found),
                Err(error) => missing = Some(error),
            }
        }
        let standard_error = cell.map_or(0.0, Value::standard_error);
        let found = match cell.map(|cell| cell.number.clone()) {
            Some(Number::Real { value, .. })
                if standard_error == 0.0 && statement.value.is_some() =>
            {
                let places = statement.decimals.unwrap_or(0) + 2;
                decimals(value, places.max(0) as usize).into()
            }
            Some(number) => Text::from(number),
            None => "–".into(),
        };
        let reason = if standard_error > 0.0 {
            "half a unit of the last printed digit, and the statistical error"
        } else {
            "half a unit of the last printed digit"
        };
        let compared = Compared {
            missing,
            value: cell.and_then(table::number),
            standard_error,
            printed: statement.value,
            quantile: self.level.map(|level| level.quantile),
            lacks_quantile: false,
        };
        let check = Check {
            reason: reason.into(),
            basis: Basis::PrintedDigit,
            compared: Some(compared),
            ..self.open(found)
        };
        check.allowed(statement.half_unit(), true, Some(statement.half_unit()))
    }

    /// Starts a check that the results do not decide; without a note it [fails](Check::fails).
    pub fn open(&self, found: impl Into<Text>) -> Check {
        let Statement { kind, why, id, place, statement, printed, .. } = self.statement;
        Check {
            why: why.clone(),
            place: place.clone(),
            expected: printed.clone(),
            ..Check::new(*kind, id, statement, found)
        }
    }

    /// Starts a check with what was found, and whether it agrees with what was printed.
    pub fn found(&self, found: impl Into<Text>, agrees: bool) -> Check {
        self.open(found).judged(agrees)
    }

    /// Starts a check of whole cases, which must all agree.
    pub fn all_cases(&self, cases: usize, failures: usize) -> Check {
        let found = Text::of("{} of {} cases agree", [integer(cases - failures), integer(cases)]);
        self.found(found, failures == 0 && cases > 0).within("none", "integers are exact")
    }

    /// Starts a check of a largest relative deviation, which rounding must explain.
    pub fn rounding(&self, largest: f64, allowed: f64) -> Check {
        let found = Text::of("largest relative deviation {}", [significant(largest, 1)]);
        let reason = "rounding in double precision, with room for the length of the sums";
        self.found(found, largest <= allowed).within(significant(allowed, 1), reason)
    }
}
