//! Gives a rule what it may look at, and starts its check.

use super::check::{Basis, Check};
use super::level::CheckLevel;
use super::published::{Published, PublishedError, Statement};
use super::texts::{KEYS, Numbers, Text};
use crate::claims::text;
use crate::experiments::{self, Results};
use crate::sample::Sampled;
use crate::table::Missing;
use crate::value::{Digits, Number, Provenance, Value};
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::Estimate;

/// Why a rule makes no check.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file of statements and the rules do not fit together.
    #[error(transparent)]
    Published(#[from] PublishedError),
    /// A result, table or cell is not there.
    #[error(transparent)]
    Experiment(#[from] experiments::Error),
    /// The samples are too small for what is asked: the statement cannot be judged.
    #[error("the results do not decide it")]
    Undecided,
    /// Why the rule with this id makes none.
    #[error("check {0}: {1}")]
    Check(String, Box<Error>),
    /// What is wrong with the rule.
    #[error("{0}")]
    Rule(String),
}

impl Error {
    pub(crate) fn cause(&self) -> &Error {
        match self {
            Error::Check(_, error) => error,
            error => error,
        }
    }
}

impl From<Missing> for Error {
    fn from(missing: Missing) -> Error {
        experiments::Error::from(missing).into()
    }
}

/// The check that a rule makes, or the reason why it makes none.
pub type Judged = Result<Check, Error>;

/// What a rule may look at.
#[derive(Clone, Copy)]
pub struct Evidence<'a> {
    /// What the rule judges.
    pub statement: &'a Statement,
    /// What the experiments found.
    pub results: &'a Results,
    /// All that was printed.
    pub published: &'a Published,
    /// The level of a statistical check; `None` if the rule is not statistical.
    pub(super) level: Option<CheckLevel>,
    /// Whether a tolerance as large as the printed number is refused.
    pub(super) is_strict: bool,
}

impl Evidence<'_> {
    /// Returns the level of each statistical check, for a rule that is one.
    pub fn level(&self) -> Result<CheckLevel, Error> {
        let (id, remedy) = (&self.statement.id, "add `.statistical()` to it");
        let problem = || format!("the rule of {id} allows for standard errors; {remedy}");
        self.level.ok_or_else(|| Error::Rule(problem()))
    }

    /// Returns the number with an address; without one the statement is undecided.
    #[track_caller]
    pub fn number(&self, address: &str) -> Result<f64, Error> {
        self.results.cell(address)?.as_f64().ok_or(Error::Undecided)
    }

    /// Returns several numbers of one row of a table, `theory.jump` or `theory.gap[sigma=0.2]`.
    #[track_caller]
    pub fn numbers<const N: usize>(&self, row: &str, names: [&str; N]) -> Result<[f64; N], Error> {
        let mut numbers = [0.0; N];
        for (number, name) in numbers.iter_mut().zip(names) {
            *number = self.number(&format!("{row}.{name}"))?;
        }
        Ok(numbers)
    }

    /// Returns the number with an address and its standard error, which is half of the interval.
    #[track_caller]
    pub fn estimate(&self, address: &str) -> Result<Estimate, Error> {
        self.results.cell(address)?.estimate().ok_or(Error::Undecided)
    }

    /// Judges the number of a cell: it has to round to the printed one, with room for its error.
    #[track_caller]
    pub fn cell(&self, address: &str) -> Judged {
        let (cell, half) = (self.results.cell(address)?, self.statement.half_unit());
        let chance = self.chance(cell)?;
        let reason = match chance {
            None | Some([0.0, 0.0]) => "half a unit of the last printed digit",
            _ => "half a unit of the last printed digit, and the statistical error",
        };
        let check = self.compared(cell, half, chance)?;
        let check = check.with_tolerance(text!("± {:1}", half), reason);
        Ok(Check { basis: Basis::PrintedDigit, ..check })
    }

    /// Judges the number of a cell by its standard error alone: the printed one lies within what
    /// chance allows at the level of the statistical checks, by Student's distribution for few
    /// values and exactly for a share. Equal values, without an error, leave others undecided.
    #[track_caller]
    pub fn within_errors(&self, address: &str) -> Judged {
        let cell = self.results.cell(address)?;
        let chance = self.chance(cell)?;
        let value = cell.as_f64().ok_or(Error::Undecided)? * scale(cell);
        let [below, above] = chance.unwrap_or_default();
        let tolerance = if below == above {
            text!("± {:1}", above)
        } else {
            text!("{:2} to {:2}", value - below, value + above)
        };
        let reason = "standard errors at the level of the table";
        let check = self.compared(cell, 0.0, chance)?.with_tolerance(tolerance, reason);
        Ok(Check { basis: Basis::Statistics, ..check })
    }

    /// Judges the number of a cell by a measure of ours: it lies no further from the printed one.
    #[track_caller]
    pub fn near(&self, address: &str, tolerance: f64, reason: &str) -> Judged {
        let check = self.compared(self.results.cell(address)?, tolerance, Some([0.0; 2]))?;
        let check = check.with_tolerance(text!("± {}", tolerance), reason);
        Ok(Check { basis: Basis::OurMeasure, ..check })
    }

    /// Returns how far below and above a number the true one may lie, or `None` if that is unknown.
    fn chance(&self, cell: &Value) -> Result<Option<[f64; 2]>, Error> {
        let Provenance::Ensemble { sample, .. } = cell.kind else { return Ok(Some([0.0; 2])) };
        let sampled = Sampled { estimate: cell.estimate().ok_or(Error::Undecided)?, sample };
        if sample.is_unknown() && sampled.estimate.error == 0.0 {
            return Ok(None);
        }
        let room = self.level()?.room(sampled);
        Ok(room.map(|room| room.map(|distance| distance * scale(cell))))
    }

    /// Starts the check of a cell: the printed number lies within `room` and chance of it, or the
    /// check is undecided if chance is unknown.
    fn compared(&self, cell: &Value, room: f64, chance: Option<[f64; 2]>) -> Judged {
        let estimate = cell.estimate().ok_or(Error::Undecided)?;
        let (printed, scale) = (self.statement.number()?, scale(cell));
        let shown_number = match cell.number {
            _ if scale < 1.0 => with_error(estimate.value * scale, estimate.error * scale).into(),
            Number::Real { value, .. } if estimate.error == 0.0 => {
                let places = self.statement.decimals.unwrap_or(0) + 2;
                Number::Real { value, digits: Digits::Decimals(places.max(0) as usize) }
            }
            ref number => number.clone(),
        };
        if self.is_strict && room >= printed.abs() && printed != 0.0 {
            let problem = format!("its tolerance {room} is as large as the printed number");
            let remedy = "narrow it, or add `.may_stay_open()` to the rule";
            return Err(Error::Rule(format!("{problem}; {remedy}")));
        }
        // The last bit may be rounded.
        let [below, above] = chance.unwrap_or_default();
        let value = estimate.value * scale;
        let room = room + if printed < value { below } else { above };
        let agrees = (value - printed).abs() <= room * (1.0 + 1e-9);
        if !agrees && chance.is_none() {
            return Err(Error::Undecided);
        }
        Ok(self.found(shown_number, agrees))
    }

    /// Makes the check of all its texts with the numbers in them; `None` leaves it open.
    pub fn check(&self, agrees: impl Into<Option<bool>>, numbers: Numbers<'_>) -> Judged {
        let [found, tolerance, reason, note] = self.fill(KEYS, numbers)?;
        let check = self.open(found).note(note);
        Ok(match agrees.into() {
            Some(agrees) => check.judged(agrees).with_tolerance(tolerance, &reason.to_string()),
            None => check,
        })
    }

    /// Makes one text of the check, for one that some results alone have or that has other numbers.
    pub fn sentence(&self, key: &str, numbers: Numbers<'_>) -> Result<Text, Error> {
        let [text] = self.fill([key], numbers)?;
        Ok(text)
    }

    fn fill<const N: usize>(&self, keys: [&str; N], numbers: Numbers) -> Result<[Text; N], Error> {
        let texts = self.published.words.fill(&self.statement.id, keys, numbers);
        Ok(texts.map_err(PublishedError)?)
    }

    /// Starts a check that the results do not decide; without a note it [fails](Check::fails).
    pub fn open(&self, found: impl Into<Text>) -> Check {
        self.statement.open(found)
    }

    pub(crate) fn found(&self, found: impl Into<Text>, agrees: bool) -> Check {
        self.open(found).judged(agrees)
    }

    /// Starts a check of whole cases, which must all agree.
    pub fn all_cases(&self, cases: usize, failures: usize) -> Check {
        let result = text!("{} of {} cases agree", cases - failures, cases);
        self.found(result, failures == 0 && cases > 0).with_tolerance("none", "integers are exact")
    }

    /// Starts a check of a largest relative deviation, which rounding must explain.
    pub fn rounding(&self, largest: f64, allowed: f64) -> Check {
        let result = text!("largest relative deviation {:1}", largest);
        let reason = "rounding in double precision, with room for the length of the sums";
        self.found(result, largest <= allowed).with_tolerance(text!("{:1}", allowed), reason)
    }
}

/// Returns the factor that converts the unit of a cell to 1, in which printed percentages are kept.
fn scale(cell: &Value) -> f64 {
    match cell.unit.trim_matches('$') {
        "%" => 0.01,
        "‰" => 0.001,
        _ => 1.0,
    }
}
