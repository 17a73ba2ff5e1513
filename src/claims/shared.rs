//! Makes the rules that several sections have in common, and gives the others what they share.

use crate::experiments::ensembles::{Counted, find_ensemble};
pub use crate::experiments::rise::{Curve, Rise, RisePoint};
pub(super) use crate::experiments::theory::comparison::{self, LARGE_SIGMA, interpolate};
pub use crate::experiments::{LENGTHS, MODE_JUMP, PROTOCOL, SEGMENTS, sweep};
pub use crate::params::*;
pub use impact_numerics::estimates::{difference, with_error};
pub use impact_numerics::statistics::{Estimate, wilson};
pub use literate::claims::Basis::{FiniteCases, OurMeasure, PrintedDigit, Rounding};
pub use literate::claims::Error::{self, Undecided};
pub use literate::claims::{Check, Evidence, Judged, Kind, Rule, Text};
pub use literate::numbers;

pub fn ensemble<'a>(ensembles: &'a [Counted], name: &str) -> Result<&'a Counted, Error> {
    find_ensemble(ensembles, name).ok_or(Undecided)
}

/// A shorter transient counts the first impacts of a chain that has just been released (ours).
pub const RELEASED: f64 = 100.0;

/// Returns the curves of a map of protocols whose window begins late enough after the release.
pub fn late_curves<'a>(e: &Evidence<'a>, map: &str) -> Result<Vec<&'a Curve>, Error> {
    let curves = ensemble(e.results.of(&PROTOCOL)?, map)?.curves.iter();
    Ok(curves.filter(|curve| curve.protocol.transient >= RELEASED).collect())
}

pub fn extremes(numbers: impl Iterator<Item = f64> + Clone) -> Option<[f64; 2]> {
    Some([numbers.clone().reduce(f64::min)?, numbers.reduce(f64::max)?])
}

/// Judges by the protocols or values of σ that were run: of so many in all, how many surely agree
/// with what was printed and how many surely differ. `None` if they do not all agree or all differ:
/// then the protocol decides, which is not printed, or the sample is too small.
pub fn by_runs([agree, differ, all]: [usize; 3]) -> Option<bool> {
    (all > 0 && [agree, differ].contains(&all)).then_some(agree == all)
}

pub fn with_more(check: Check, sentence: Text) -> Check {
    let note = check.note.clone().then(" ").then(sentence);
    check.note(note)
}

/// Returns half a unit of the last digit in which the paper prints the threshold.
pub fn half_unit(e: &Evidence<'_>) -> Result<f64, Error> {
    Ok(e.published.statement("sec2_half_height")?.half_unit())
}

/// Counts the cases in which a statement about the theory was compared, and those where it fails.
pub fn compared_cases(e: &Evidence<'_>) -> Result<[usize; 2], Error> {
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
    Rule::new(id, |e| e.check(e.statement.kind == Kind::Definition, &[]))
}

/// Makes the rule of a statement about the theory that fails in none of the compared cases.
#[track_caller]
pub fn cases(id: &'static str) -> Rule {
    Rule::new(id, |e| {
        let [all, failed] = compared_cases(e)?;
        Ok(e.all_cases(all, failed).note(e.sentence("note", &[])?))
    })
    .on(FiniteCases)
}

/// Makes the rule of a statement about the theory that is an equality of real numbers.
#[track_caller]
pub fn equality(id: &'static str, allowed: f64) -> Rule {
    let judge = move |e: &Evidence<'_>| {
        Ok(e.rounding(largest_difference(e)?, allowed).note(e.sentence("note", &[])?))
    };
    Rule::new(id, judge).on(FiniteCases)
}
