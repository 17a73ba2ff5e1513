//! Statements judged each by one line of their author.
//!
//! ```
//! # use literate::claims::{Case, Check};
//! # let _: [fn(&Case<'_>) -> Check; 3] = [
//! |s| s.cell("cascade.limit.delta"), // rounds to what was printed
//! |s| s.cell("walk.fit.slope").within_errors(), // lies within its standard errors of it
//! |s| s.cell("walk.fit.onset").near(0.01, "ours: a hundredth").explained("too few steps", true),
//! # ];
//! ```

use super::{Basis, Check, Published, PublishedError, Statement, Text};
use super::{chosen, decimals, significant};
use crate::experiments::{self, Results};
use crate::table::{self, Missing};
use crate::value::{Number, Value};
use impact_numerics::statistics::normal_quantile;
use std::cell::Cell;

/// Why a check could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file of statements and the checks do not fit together.
    #[error(transparent)]
    Published(#[from] PublishedError),
    /// A result is missing.
    #[error(transparent)]
    Experiment(#[from] experiments::Error),
    /// The samples are too small for what is asked.
    #[error("the results at hand do not decide it")]
    Undecided,
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
        match check.held.missing.clone() {
            Some(missing) => Err(missing.into()),
            None => Ok(check),
        }
    }
}

/// A statement with what its check may look at.
#[derive(Debug)]
pub struct Case<'a> {
    pub statement: &'a Statement,
    pub results: &'a Results,
    pub published: &'a Published,
    level: Level,
    /// Whether the level was asked for.
    statistical: Cell<bool>,
}

/// What a cell is held against; not saved.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Held {
    missing: Option<Missing>,
    found: f64,
    error: f64,
    printed: Option<f64>,
    /// Standard errors that are allowed.
    quantile: f64,
}

impl Case<'_> {
    /// The level of the statistical checks; a rule that reads it is one of them.
    pub fn level(&self) -> Level {
        self.statistical.set(true);
        self.level
    }

    /// The number with an address.
    #[track_caller]
    pub fn number(&self, address: &str) -> Result<f64, Error> {
        Ok(self.results.number(address)?)
    }

    /// Holds a cell against the printed number. Unless it is said otherwise it has to round to that, with room for its
    /// standard error if it has one.
    #[track_caller]
    pub fn cell(&self, address: &str) -> Check {
        let own = self.statement;
        let (found, missing) = match table::cell(self.results.tables(), address) {
            Ok(cell) => (Some(cell), None),
            Err(missing) => (None, Some(missing)),
        };
        let error = found.map_or(0.0, Value::standard_error);
        let value = found.and_then(table::number).unwrap_or(f64::NAN);
        let shown = match found.map(|cell| cell.number.clone()) {
            Some(Number::Real { value, .. }) if error == 0.0 && own.value.is_some() => {
                decimals(value, usize::from(own.decimals) + 2).into()
            }
            Some(number) => Text::from(number),
            None => "–".into(),
        };
        let half_unit = own.half_unit();
        let quantile = if error > 0.0 { self.level().quantile } else { 0.0 };
        let held = Held { missing, found: value, error, printed: own.value, quantile };
        let reason = match error > 0.0 {
            true => "half a unit of the last printed digit, and the statistical error",
            false => "half a unit of the last printed digit",
        };
        let room = half_unit + quantile * error;
        Check { held, ..own.open(shown) }.allowed(half_unit, room, reason).on(Basis::PrintedDigit)
    }
}

impl Statement {
    /// What was found of it; open where the results at hand do not decide it.
    pub fn decided(&self, found: Judged) -> Judged {
        match found {
            Err(Error::Undecided) => {
                Ok(self.open("–").note("The results at hand do not decide it."))
            }
            found => found,
        }
    }
}

impl Check {
    /// Judged by the distance from the printed number.
    fn allowed(self, shown: f64, room: f64, reason: &str) -> Check {
        let off = self.held.printed.map(|printed| (self.held.found - printed).abs());
        let check = self.within(Text::of("± {}", [significant(shown, 1)]), reason);
        // A last bit is nobody's digit.
        off.map_or(check.clone(), |off| check.judged(off <= room * (1.0 + 1e-9)))
    }

    /// Of a [cell](Case::cell): within so many standard errors of the printed number as the level of the table allows.
    pub fn within_errors(self) -> Check {
        let room = self.held.quantile * self.held.error;
        self.allowed(room, room, "standard errors at the level of the table").on(Basis::Statistics)
    }

    /// Of a [cell](Case::cell): no further from the printed number than this.
    pub fn near(self, tolerance: f64, reason: &str) -> Check {
        let check = self.allowed(tolerance, tolerance, reason).on(Basis::OurMeasure);
        Check { tolerance: Text::of("± {}", [chosen(tolerance)]), ..check }
    }
}

/// How a statement is judged.
pub type Rule<'a> = dyn Fn(&Case<'_>) -> Judged + Send + Sync + 'a;

/// Judges all statements, in their order, each by the rule with its id; the statistical ones at the level that is
/// returned. A statement without a rule stays open, without a reason, so that it [fails](Check::fails).
///
/// # Errors
/// If there is no statement for a rule, or if a rule needs a number that is missing.
pub fn judge_all(
    published: &Published,
    rules: &[(&str, Box<Rule<'_>>)],
    results: &Results,
) -> Result<(Vec<Check>, Level), Error> {
    rules.iter().try_for_each(|(id, _)| published.statement(id).map(drop))?;
    let judge = |statement: &Statement, level| {
        let statistical = Cell::new(false);
        let case = Case { statement, results, published, level, statistical };
        let rule = rules.iter().find(|(id, _)| *id == statement.id);
        let found = rule.map_or_else(|| Ok(statement.open("–")), |(_, rule)| rule(&case));
        Ok((statement.decided(found)?, case.statistical.get()))
    };
    let first = published.statements.iter().map(|statement| judge(statement, Level::of(1)));
    let first = first.collect::<Result<Vec<(Check, bool)>, Error>>()?;
    let level = Level::of(first.iter().filter(|(_, statistical)| *statistical).count());
    let again = |((check, statistical), statement): ((Check, bool), &Statement)| match statistical {
        true => Ok(judge(statement, level)?.0),
        false => Ok(check),
    };
    let checks = first.into_iter().zip(&published.statements).map(again);
    Ok((checks.collect::<Result<_, Error>>()?, level))
}

/// Probability with which at least one statistical check fails although all of them hold (ours).
pub const FAMILY_LEVEL: f64 = 0.01;

/// The level of each of several statistical checks, by Šidák's correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// How many statistical checks there are.
    pub claims: usize,
    /// The level of each one, 1 − (1 − [`FAMILY_LEVEL`])^(1/claims).
    pub each: f64,
    /// Two-sided normal quantile of that level, in standard errors.
    ///
    /// Rounded up to a hundredth.
    pub quantile: f64,
}

impl Level {
    /// The level for so many checks (at least one).
    pub fn of(claims: usize) -> Level {
        let each = -pxfm::f_expm1(pxfm::f_log1p(-FAMILY_LEVEL) / claims.max(1) as f64);
        let quantile = (100.0 * normal_quantile(1.0 - each)).ceil() / 100.0;
        Level { claims, each, quantile }
    }

    /// The quantile when one check compares `rows` numbers, which then share its level.
    pub fn among(self, rows: usize) -> f64 {
        Level::of(self.claims.max(1) * rows.max(1)).quantile
    }
}

#[cfg(test)]
mod tests {
    use super::super::Verdict;
    use super::*;
    use crate::table::Table;
    use impact_numerics::statistics::Estimate;

    const PUBLISHED: &str = "statement = [
        { id = \"rise\", place = \"a\", statement = \"b\", printed = \"0.12\", value = 0.12, decimals = 2 },
        { id = \"mean\", place = \"a\", statement = \"b\", printed = \"0.11\", value = 0.11, decimals = 2 },
        { id = \"words\", place = \"a\", statement = \"b\", printed = \"steep\" },
        { id = \"nobody\", place = \"a\", statement = \"b\", printed = \"c\" }]";

    fn judged(rules: &[(&str, Box<Rule<'_>>)]) -> Result<(Vec<Check>, Level), Error> {
        let mean = |x: &f64| Some(Estimate { value: *x, error: 0.002, interval: [0.0; 2] });
        let table = Table::of("toy.all", &[0.1152], |_| 9).real("rise", "1", 6, "A.", |x| *x);
        let table = table.estimate("mean", "1", "A mean.", mean).done();
        judge_all(&Published::parse(PUBLISHED).unwrap(), rules, &Results::made_up(vec![table]))
    }

    #[test]
    fn a_cell_is_held_against_what_was_printed() {
        let judge = |rule: fn(&Case<'_>) -> Check| {
            let rule = |id| -> (&str, Box<Rule<'_>>) { (id, Box::new(move |s| rule(s).into())) };
            let (checks, level) = judged(&["rise", "mean", "words"].map(rule)).unwrap();
            (checks.iter().map(|check| check.verdict).collect::<Vec<_>>(), level.claims, checks)
        };
        use Verdict::{
            CannotBeJudged as Open, Differs as No, DiffersAndExplained as Why, Reproduced as Yes,
        };
        // Printed are 0.12, 0.11 and a word; found is 0.1152, once with an error of 0.002.
        let (verdicts, statistical, checks) = judge(|s| s.cell("toy.all.rise"));
        assert_eq!((verdicts, statistical), (vec![Yes, No, Open, Open], 0));
        assert_eq!(checks[0].found.to_string(), "0.1152");
        assert_eq!(checks[0].tolerance.to_string(), "± 0.005");
        let (verdicts, statistical, checks) = judge(|s| s.cell("toy.all.mean"));
        assert_eq!((verdicts, statistical), (vec![Yes, Yes, Open, Open], 3));
        assert_eq!(checks[1].found.to_string(), "0.115(2)");
        let (verdicts, _, checks) = judge(|s| s.cell("toy.all.mean").within_errors());
        assert_eq!(checks[0].tolerance.to_string(), "± 0.006", "2.94 standard errors");
        assert_eq!(verdicts, [Yes, Yes, Open, Open]);
        let (verdicts, _, checks) = judge(|s| s.cell("toy.all.rise").near(1e-3, "ours"));
        assert_eq!(checks[0].tolerance.to_string(), "± 0.001");
        assert_eq!(verdicts, [No, No, Open, Open]);
        let (verdicts, ..) = judge(|s| s.cell("toy.all.rise").explained("why", true));
        assert_eq!(verdicts, [Yes, Why, Open, Open]);
        let (verdicts, _, checks) = judge(|s| s.cell("toy.all.rise").explained("why", false));
        assert_eq!(verdicts, [No, No, No, Open]);
        assert!(checks.iter().all(Check::fails), "what nobody judges fails too");
        assert!(!checks[3].clone().note("It is a likeness in words.").fails());
    }

    /// Printed tables of the normal distribution have z(0.995) = 2.5758 and z(0.99975) = 3.4808;
    /// Šidák's level for 20 checks is 5.024e-4, a little above 5e-4, and z a little below.
    #[test]
    fn the_quantile_is_that_of_the_table() {
        assert_eq!(Level::of(1).quantile, 2.58);
        let twenty = Level::of(20);
        assert!((twenty.each - 5.024e-4).abs() < 1e-7, "{}", twenty.each);
        assert_eq!((twenty.quantile, Level::of(4).among(5)), (3.48, 3.48));
    }
}
