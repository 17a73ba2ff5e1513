//! What a verdict rests on.

use super::{Check, Verdict};
use serde::Serialize;

/// What decides whether a finding agrees with a statement. Where several things do, the weakest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// Whole numbers, orders and inequalities, which agree or do not.
    Exact,
    /// Agreement within the rounding of double precision.
    Rounding,
    /// Half a unit of the last digit that the paper printed.
    PrintedDigit,
    /// Standard errors at the level of the table.
    Statistics,
    /// A measure of our own, for a statement in words.
    OurMeasure,
    /// Times of a clock; no statement of a paper rests on them.
    Clock,
}

impl Basis {
    /// Every basis of a statement, the strongest first.
    pub const ALL: [Basis; 5] =
        [Basis::Exact, Basis::Rounding, Basis::PrintedDigit, Basis::Statistics, Basis::OurMeasure];

    /// The basis in words.
    pub fn words(self) -> &'static str {
        match self {
            Basis::Exact => "exact",
            Basis::Rounding => "rounding",
            Basis::PrintedDigit => "printed digit",
            Basis::Statistics => "statistics",
            Basis::OurMeasure => "our measure",
            Basis::Clock => "clock",
        }
    }
}

/// How many claims of each basis have each verdict, in the orders of [`Basis::ALL`] and
/// [`Verdict::ALL`].
pub fn split(claims: &[Check]) -> [[usize; 4]; 5] {
    Basis::ALL.map(|basis| {
        let own = |verdict| move |c: &&Check| c.basis == basis && c.verdict == verdict;
        Verdict::ALL.map(|verdict| claims.iter().filter(own(verdict)).count())
    })
}
