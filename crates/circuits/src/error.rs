//! Checks arguments and refuses them.

pub use impact_chain::Error;
use std::fmt::Debug;

/// Creates the error of a wrong argument.
pub(crate) fn refused(field: &str, problem: String, remedy: String) -> Error {
    Error::Input { field: field.into(), problem, remedy }
}

/// Refuses an argument outside [low, high].
pub(crate) fn check_range<T: PartialOrd + Debug>(
    field: &str,
    x: T,
    low: T,
    high: T,
) -> Result<(), Error> {
    let remedy = || format!("give a number from {low:?} to {high:?}");
    let refused = || refused(field, format!("{x:?} is out of range"), remedy());
    (low <= x && x <= high).then_some(()).ok_or_else(refused)
}
