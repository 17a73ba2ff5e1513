//! Makes the rules that several sections have in common, and gives the others what they share.

use crate::experiments::ensembles::Counted;
use crate::experiments::ensembles::named;
use impact_numerics::statistics::Estimate;
pub use literate::claims::Basis::{OurMeasure, PrintedDigit, Rounding};
pub use literate::claims::Error::{self, Undecided};
pub use literate::claims::{
    Evidence, Judged, Kind, Rule, Text, chosen, integer, significant, with_error,
};
use literate::value::Number;

/// Returns a number with its standard error.
pub fn estimate(found: &Estimate) -> Number {
    with_error(found.value, found.error)
}

/// Finds the chains of this name among those of an experiment.
pub fn ensemble<'a>(found: &'a [Counted], name: &str) -> Result<&'a Counted, Error> {
    named(found, name).ok_or(Undecided)
}

/// Returns a tolerance to both sides.
pub fn plus_minus(half: f64) -> Text {
    Text::of("± {}", [significant(half, 1)])
}

/// Returns half a unit of the last digit in which the paper prints the threshold.
pub fn half_unit(e: &Evidence<'_>) -> Result<f64, Error> {
    Ok(e.published.statement("sec2_half_height")?.half_unit())
}

/// Counts the cases in which a statement about the theory was compared, and those in which the
/// paper is wrong.
pub fn compared(e: &Evidence<'_>) -> Result<[usize; 2], Error> {
    let row = format!("theory.cases[statement={}]", e.statement.id);
    Ok(e.numbers(&row, ["compared", "failed"])?.map(|count| count as usize))
}

/// Returns the largest difference between the two sides of a statement about the theory.
pub fn largest_difference(e: &Evidence<'_>) -> Result<f64, Error> {
    e.number(&format!("theory.differences[statement={}].largest", e.statement.id))
}

/// Makes the rule of a definition, which this edition uses as it stands: nothing is computed.
#[track_caller]
pub fn defined(id: &'static str) -> Rule {
    Rule::new(id, |e| e.found("used as it stands", e.statement.kind == Kind::Definition))
}

/// Makes the rule of a statement about the theory that fails in none of the compared cases.
#[track_caller]
pub fn cases(id: &'static str, note: &'static str) -> Rule {
    Rule::new(id, move |e| {
        let [all, failed] = compared(e)?;
        Judged::Ok(e.all_cases(all, failed).note(note))
    })
}

/// Makes the rule of a statement about the theory that is an equality of real numbers.
#[track_caller]
pub fn equality(id: &'static str, allowed: f64, note: &'static str) -> Rule {
    let judge =
        move |e: &Evidence<'_>| Judged::Ok(e.rounding(largest_difference(e)?, allowed).note(note));
    Rule::new(id, judge).on(Rounding)
}
