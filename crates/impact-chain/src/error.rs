//! Defines the errors of the dynamics, and the range checks that raise them.

use std::fmt::{self, Debug};

/// Why input is refused, or a run is ended.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A field has a value that the model does not allow: what is wrong, and what to write instead.
    Input {
        /// The name of the field, as in the JSON form of a scenario, or of an argument.
        field: String,
        /// What is wrong with its value.
        problem: String,
        /// What to write instead.
        remedy: String,
    },
    /// The start has masses in reversed order, first at this gap, overlapped by this length.
    Overlap {
        /// The field that gives the start: `initial` of a scenario, or `positions` of a state.
        field: String,
        /// The first gap that is below zero.
        gap: usize,
        /// How far it is below zero.
        depth: f64,
    },
    /// More events than the bound within one unit of time, the last at this gap and time.
    Work {
        /// The gap of the last event.
        gap: usize,
        /// The time of the last event.
        time: f64,
        /// The largest number of events within 1/ω.
        bound: u64,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Input { field, problem, remedy } => write!(f, "{field}: {problem}; {remedy}"),
            Error::Overlap { field, gap, depth } => write!(
                f,
                "{field}: gap {gap} starts overlapped by {depth:e}; give places, walls and displacements \
                 that leave all gaps ≥ 0"
            ),
            Error::Work { gap, time, bound } => write!(
                f,
                "the chain has more than {bound} events within one unit of time, the last at gap \
                 {gap}; the run was stopped at t = {time}; give an earlier end or weaker forces"
            ),
        }
    }
}

impl std::error::Error for Error {}

impl Error {
    /// Returns the name of the field or argument that is refused, or `None` if a run was ended.
    #[must_use]
    pub fn field(&self) -> Option<&str> {
        match self {
            Error::Input { field, .. } | Error::Overlap { field, .. } => Some(field),
            Error::Work { .. } => None,
        }
    }

    /// Creates the error of a value that is refused.
    pub fn input(
        field: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Error::Input { field: field.into(), problem: problem.into(), remedy: remedy.into() }
    }
}

/// Refuses a value of a field that is not from `low` to `high`.
pub fn check_range<T: PartialOrd + Debug>(field: &str, x: T, low: T, high: T) -> Result<(), Error> {
    if low <= x && x <= high {
        return Ok(());
    }
    let remedy = format!("give a number from {low:?} to {high:?}");
    Err(Error::input(field, format!("{x:?} is out of range"), remedy))
}

/// Refuses a list that is not one pair of numbers for each mass.
pub fn check_pairs(field: &str, pairs: &[[f64; 2]], masses: usize) -> Result<(), Error> {
    if pairs.len() != masses || masses == 0 {
        let problem = format!("it has {} pairs for {masses} masses", pairs.len());
        return Err(Error::input(field, problem, "give one pair for each mass, at least one"));
    }
    for (j, pair) in pairs.iter().enumerate() {
        for &x in pair {
            // The name is formatted for a number that is refused, not for each.
            if !(-1e9..=1e9).contains(&x) {
                check_range(&format!("{field}[{j}]"), x, -1e9, 1e9)?;
            }
        }
    }
    Ok(())
}
