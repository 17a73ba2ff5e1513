//! Computes and gathers what several tables of the theory need.

pub(crate) use crate::experiments::prelude::*;
pub(crate) use impact_circuits::distribution::Law;
pub(crate) use impact_circuits::distribution::SampleSpace::{self, *};
pub(crate) use impact_circuits::jump::{self, Jump, p_crit, p_jump};
pub(crate) use impact_numerics::roots;
use literate::table::Building;
use literate::value::Origin;

/// Returns the value of a formula; panics if it has none for the numbers of the paper.
pub(crate) fn expect_known<T>(result: Result<T, impact_circuits::Error>) -> T {
    result.expect("the theory exists for the paper's N and p")
}

pub(crate) fn one_row(name: &'static str, item: Origin) -> Building<'static, ()> {
    Table::builder(name, &[()], |()| 0).table_computed_by(item)
}

/// Adds numbers from first to last, so that the sum has the same bits on every machine.
pub(crate) fn sum(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |sum, value| sum + value)
}

/// Returns the largest of some numbers; zero if none is above zero.
pub(crate) fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, f64::max)
}

/// Whole cases: how many were compared, and how many of these failed.
pub(crate) type Cases = [u64; 2];

/// Counts the cases in which two sides of a statement were compared, and those that do not agree.
pub(crate) fn cases(agree: impl IntoIterator<Item = bool>) -> Cases {
    agree.into_iter().fold([0, 0], |[all, failed], agrees| [all + 1, failed + u64::from(!agrees)])
}
